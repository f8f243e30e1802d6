"""Cases of cases.py: exact solutions and references of elasticity."""

from cases import (FORMULA, INDEPENDENT, LONG, PAPER, QUICK, Number, case,
                   observed_order, relative)
from scene_run import SceneRun, read_reference


def displacements(run, inner, outer, inner_reference, outer_reference, tolerance, source):
    """Displacements of the inner and outer surface from the radii at the end."""
    yield relative("u_r inside, m", run.result["inner margin radius [m]"] - inner,
                   inner_reference, tolerance, source)
    yield relative("u_r outside, m", run.result["margin radius [m]"] - outer,
                   outer_reference, tolerance, source)


@case(QUICK, "thick_tube")
def thick_tube(run):
    yield from displacements(run, 0.5, 1, 9.53333e-4, 6.06667e-4, 1e-4, f"{PAPER} (A.2)")
    with SceneRun("thick_tube", "Scene/Refinement = 2") as refined:
        for component in ("rr", "hoop", "yy"):
            coarse, fine = (wall_stress_error(which, component) for which in (run, refined))
            yield observed_order(f"order of the stress {component} in the wall", coarse, fine, 3)


def wall_stress_error(run, component):
    """Largest difference to Lame's solution, plane strain, through the wall, Pa."""
    p, a, b, nu = 1e5, 0.5, 1, 0.3
    mean, share = p * a ** 2 / (b ** 2 - a ** 2), p * a ** 2 * b ** 2 / (b ** 2 - a ** 2)
    exact = {"rr": lambda r: mean - share / r ** 2, "hoop": lambda r: mean + share / r ** 2,
             "yy": lambda r: 2 * nu * mean}[component]
    return max(abs(values[-1] - exact(a + (b - a) * float(name)))
               for name, values in run.table(f"profiles/wall_stress_{component}").items()
               if name != "time [s]")


@case(QUICK, "hollow_sphere")
def hollow_sphere(run):
    yield from displacements(run, 0.5, 1, -6.0e-4, -5.5e-4, 1e-4, f"{PAPER} (A.3)")


@case(QUICK, "inflated_tube")
def inflated_tube_follower_load(run):
    yield from displacements(run, 0.5, 0.8, 0.113615663, 0.075533786, 1e-6, INDEPENDENT)


@case(QUICK, "inflated_tube",
      "Elasticity/Side theta2_0/Pressure acts on = reference surface")
def inflated_tube_dead_load(run):
    yield from displacements(run, 0.5, 0.8, 0.090508816, 0.059493237, 1e-6, INDEPENDENT)


@case(QUICK, "active_tube")
def active_tube(run):
    for where, column, reference in (("inner", "inner margin radius [m]", 0.422546728),
                                     ("outer", "margin radius [m]", 0.754018360)):
        yield relative(f"{where} radius, m", run.result[column], reference, 1e-6, INDEPENDENT)


@case(QUICK, "uniaxial_rod")
def uniaxial_rod(run):
    stretch = run.result["margin radius [m]"] / 0.3
    yield relative("stretch across", stretch, 0.8182035373, 1e-9, INDEPENDENT)
    for which in ("smallest", "largest"):
        yield relative(f"{which} J", run.result[f"{which} J [-]"],
                       1.5 * 0.8182035373 ** 2, 1e-9, INDEPENDENT)
    inside = {name: values[-1] for name, values in run.table("probes/inside").items()}
    for name, reference in (("Cauchy stress yy [Pa]", 1255.66278),
                            ("pressure [Pa]", -1255.66278 / 3)):
        yield relative(f"{name} inside", inside[name], reference, 1e-8, INDEPENDENT)
    for name, reference in (("stretch along theta1 [-]", 1.5),
                            ("stretch along theta2 [-]", 0.8182035373),
                            ("hoop stretch [-]", 0.8182035373)):
        yield relative(f"{name} inside", inside[name], reference, 1e-9, INDEPENDENT)
    for name in ("rr", "hoop", "ry"):
        column = f"Cauchy stress {name} [Pa]"
        yield Number(f"{column} inside", inside[column], 0, 1e-5, FORMULA)


TAYLOR_HOOD = "dolfinx, mixed Taylor-Hood elements"


def cantilever(run, load, outer, inner):
    """Both surfaces beyond z = 0.25 m from the clamp, and the free end, m.

    The body hangs from its clamped end: z points to -y.
    """
    rows = read_reference("elasticity/cantilever_tube.csv")
    first = {"follower": 0, "dead": 6}[load]
    for line, column, tolerance in (("outer", 1, outer), ("inner", 3, inner)):
        column += first
        lines = [list(run.table(f"profiles/{line}_{which}_displacement").items())[1:]
                 for which in ("radial", "axial")]
        worst = 0
        for row, (_, u_r), (_, u_y) in zip(rows, *lines, strict=True):
            if row[0] > 0.25:
                worst = max(worst, abs(u_r[-1] - row[column]), abs(-u_y[-1] - row[column + 1]))
        if line == "outer":
            for k, what in enumerate(("u_r", "u_z")):
                yield Number(f"{what} of the free end, m", (1, -1)[k] * lines[k][-1][1][-1],
                             rows[-1][column + k], tolerance, TAYLOR_HOOD)
        yield Number(f"{line} surface beyond 0.25 m, largest difference, m", worst, 0,
                     tolerance, TAYLOR_HOOD)


@case(QUICK, "cantilever_tube")
def cantilever_tube_follower_load(run):
    yield from cantilever(run, "follower", 7e-4, 9e-4)


@case(QUICK, "cantilever_tube",
      "Elasticity/Side theta2_0/Pressure acts on = reference surface")
def cantilever_tube_dead_load(run):
    yield from cantilever(run, "dead", 6e-4, 7e-4)


@case(LONG, "cantilever_tube", "Scene/Refinement = 3")
def cantilever_tube_refined(run):
    # less than half of the error of the 200 elements
    yield from cantilever(run, "follower", 3.2e-4, 4.2e-4)


@case(QUICK, "oscillating_tube")
def oscillating_tube(run):
    table = run.table("statistics")
    radius = table["inner margin radius [m]"]
    yield relative("largest inner radius, m", max(radius), 0.626466860, 1e-5,
                   f"{INDEPENDENT}, incompressible")
    yield relative("time of it, s", table["time [s]"][radius.index(max(radius))], 1.353253,
                   0.004, f"{INDEPENDENT}, incompressible")
