"""Cases of cases.py: the bell in equilibrium, against independent mixed solutions."""

from cases import LONG, QUICK, Number, case, relative
from scene_run import read_reference

SOURCE = "dolfinx, mixed Q3-Q2 elements"
RADIUS = 0.015  # of the bell, m

TRACTION = "Elasticity/Side theta2_0/Radial traction = "
ELLIPSE = TRACTION + "y > -0.012 ? -2.5 : 0"
RADIAL_PART = (TRACTION
               + "y > -0.012 ? -2.5*r/sqrt(r^2 + (0.948/0.46)^4*(y + 0.012)^2) : -2.5")
UNIT_DIRECTORS = ("Elasticity/Active strain/Form = unit directors",
                  "Elasticity/Active strain/Coronal amplitude = 0.6")
FINE = ("Body/Degree = 4, 4", "Body/Elements = 60, 12")


def surfaces(run, name, outer, inner, volume):
    """Both surfaces at 61 points each, over the radius, and the volume.

    The tolerance of the volume is relative."""
    rows = read_reference(f"elasticity/bell_{name}.csv")
    for k, (line, tolerance) in enumerate((("outer", outer), ("inner", inner))):
        worst, margin = 0, []
        for c, which in enumerate(("radial", "axial")):
            table = run.table(f"profiles/{line}_{which}_displacement")
            values = [column[-1] for where, column in table.items() if where != "time [s]"]
            column = 1 + 2 * k + c
            worst = max(worst, *(abs(value - row[column]) / RADIUS
                                 for value, row in zip(values, rows, strict=True)))
            margin.append((values[-1] / RADIUS, rows[-1][column] / RADIUS))
        for what, (value, reference) in zip(("u_r", "u_y"), margin):
            yield Number(f"{what} of the {line} margin over a_ex", value, reference, tolerance,
                         SOURCE)
        yield Number(f"{line} surface, largest difference over a_ex", worst, 0, tolerance, SOURCE)
    yield relative("change of the volume", run.result["volume change [-]"], *volume, SOURCE)


# The tractions of the first two do not vanish on the axis, where the solution is
# singular and the mesh of the paper differs most.
@case(QUICK, "bell_radial_load")
def bell_radial_load(run):
    yield from surfaces(run, "load_whole", 1e-3, 1.5e-3, (-3.275e-5, 1e-3))


@case(QUICK, "bell_radial_load", ELLIPSE)
def bell_radial_load_on_ellipse(run):
    yield from surfaces(run, "load_ellipse", 1e-3, 1.5e-3, (-2.673e-5, 1e-3))


@case(QUICK, "bell_radial_load", RADIAL_PART)
def bell_radial_part_of_load(run):
    yield from surfaces(run, "load_radial_part", 5e-4, 5e-4, (-2.384e-5, 1e-3))


@case(LONG, "bell_radial_load", *FINE)
def bell_radial_load_fine(run):
    yield from surfaces(run, "load_whole", 2e-4, 5e-4, (-3.275e-5, 5e-4))


@case(LONG, "bell_radial_load", ELLIPSE, *FINE)
def bell_radial_load_on_ellipse_fine(run):
    yield from surfaces(run, "load_ellipse", 4e-4, 6e-4, (-2.673e-5, 5e-4))


@case(QUICK, "bell_contraction", "Body/Elements = 40, 12")
def bell_contraction_paper_metric(run):
    yield from surfaces(run, "active_paper_metric", 5e-4, 5e-4, (-1.597e-5, 0.01))


@case(QUICK, "bell_contraction", "Body/Elements = 40, 12", *UNIT_DIRECTORS)
def bell_contraction_unit_directors(run):
    yield from surfaces(run, "active_unit_directors", 3e-4, 3e-4, (-7.30e-6, 0.015))


@case(LONG, "bell_contraction", *FINE)
def bell_contraction_paper_metric_fine(run):
    yield from surfaces(run, "active_paper_metric", 4e-4, 4e-4, (-1.597e-5, 0.01))


@case(LONG, "bell_contraction", *UNIT_DIRECTORS, *FINE)
def bell_contraction_unit_directors_fine(run):
    yield from surfaces(run, "active_unit_directors", 2e-4, 2e-4, (-7.30e-6, 0.01))
