"""What the shipped scenes have to show: numbers beside independent references.

Each case is a function that runs a scene and yields Numbers. `long` marks what
takes more than some seconds."""

import dataclasses
import math

from scene_run import SceneRun, crossing, interpolated, order, read_reference

QUICK, LONG = "quick", "long"
CASES = []  # (name, label, command, function)

PAPER = "10.1016/j.apm.2023.08.003"
INDEPENDENT = "independent program"
FORMULA = "exact"


@dataclasses.dataclass
class Number:
    """A computed number, what it should be, and by how much it may differ."""
    what: str
    value: float
    reference: float
    tolerance: float  # absolute
    source: str

    def difference(self):
        """In words: relative, where that has a meaning."""
        if self.reference == 0 or self.source == "theory":
            return ""
        percent = 100 * (self.value / self.reference - 1)
        return f"{percent:+.2g} %" if abs(percent) >= 1e-4 else "< 0.0001 %"

    def passes(self):
        return abs(self.value - self.reference) <= self.tolerance


def relative(what, value, reference, tolerance, source):
    return Number(what, value, reference, tolerance * abs(reference), source)


def observed_order(what, coarse, fine, expected):
    """Convergence at least as fast as expected, less 0.15."""
    found = order(coarse, fine)
    return Number(what, found, expected, max(0.15, found - expected), "theory")


def case(label, scene, *overrides):
    def add(function):
        CASES.append((function.__name__, label, scene, overrides, function))
        return function
    return add


# --- electrophysiology --------------------------------------------------------

@case(QUICK, "single_neuron")
def single_neuron(run):
    table = run.table("statistics")
    time, v = table["time [s]"], [1e3 * x for x in table["largest potential [V]"]]
    source = f"{INDEPENDENT}, {PAPER} section A.1"
    yield Number("rest, mV", v[0], -70.762, 1e-3, source)
    yield Number("peak, mV", max(v), 45.87, 0.02, source)
    yield Number("time of the peak, ms", 1e3 * time[v.index(max(v))], 2.44, 0.02, source)
    at = {round(1e6 * t): potential for t, potential in zip(time, v)}
    yield Number("largest difference to the trace, mV",
                 max(abs(at[round(1e3 * row[0])] - row[1])
                     for row in read_reference("single_neuron_epsc_at_0.csv")
                     if row[0] <= 60), 0, 0.05, source)


@case(QUICK, "disk_heat", "Scene/Refinement = 2")
def disk_heat(run):
    def field(table, r, time):
        row = [round(t, 9) for t in table["time [s]"]].index(time)
        return table[f"{r / 40:g}"][row]

    fine, errors = run.table("profiles/potential"), {}
    for time, column in ((1, 3), (2, 5)):
        exact = {r[0]: r[column] for r in read_reference("A1_disk_heat.csv")}
        for r in (0, 20, 30):
            errors[r, time] = field(fine, r, time) - exact[r]
            yield Number(f"field at r = {r} m, t = {time} s", field(fine, r, time), exact[r],
                         5e-6, "Bessel series (A.1)")
    with SceneRun("disk_heat") as run_with_longer_steps:
        coarse = field(run_with_longer_steps.table("profiles/potential"), 30, 1)
    yield observed_order("order in time", coarse - field(fine, 30, 1) + errors[30, 1],
                         errors[30, 1], 2)


@case(QUICK, "cable")
def cable(run):
    yield relative("speed, m/s", run.result["conduction velocity [m/s]"], 0.4748, 0.005,
                   INDEPENDENT)


@case(QUICK, "nagumo_wave")
def nagumo_wave(run):
    yield relative("speed, m/s", run.result["conduction velocity [m/s]"],
                   math.sqrt(1e-3 * 10 / 2) * (1 - 2 * 0.1), 1e-3, FORMULA)


# --- flow ---------------------------------------------------------------------

@case(QUICK, "stokes_eigenmode", "Scene/Refinement = 4")
def stokes_eigenmode(run):
    k, b, viscosity, end = math.pi, 4.8055067166, 0.1, 0.3
    rate = viscosity * (k * k + b * b)
    centre = 1.9828668285
    yield relative("v_y on the axis at t = 0.3", run.result["centre axial velocity [m/s]"],
                   centre, 2e-4, FORMULA)
    energy = run.table("statistics")["kinetic energy [J]"]
    yield relative("decay rate of the velocity, 1/s",
                   math.log(energy[0] / energy[-1]) / (2 * end), rate, 1e-3, FORMULA)
    errors = [run.result["centre axial velocity [m/s]"] - centre]
    for refinement in (2, 1):
        with SceneRun("stokes_eigenmode", f"Scene/Refinement = {refinement}") as coarse:
            errors.append(coarse.result["centre axial velocity [m/s]"] - centre)
    yield observed_order("order, 32 to 64 cells on the radius", errors[1], errors[0], 2)
    yield observed_order("order, 16 to 32 cells on the radius", errors[2], errors[1], 2)


@case(QUICK, "poiseuille", "Scene/Refinement = 4")
def poiseuille(run):
    exact = math.pi / 12
    yield relative("v_y on the axis", run.result["axis axial velocity [m/s]"], 1, 1e-5, FORMULA)
    yield relative("kinetic energy, J", run.result["kinetic energy [J]"], exact, 2e-3, FORMULA)
    with SceneRun("poiseuille", "Scene/Refinement = 2", ranks=2) as coarse:
        yield observed_order("order of the kinetic energy, 16 to 32 cells",
                             coarse.result["kinetic energy [J]"] - exact,
                             run.result["kinetic energy [J]"] - exact, 2)


# --- rigid bodies -------------------------------------------------------------

BODY_FITTED = "body-fitted P2-P1 program (FreeFem++)"


def along(run, profile, start=0):
    """Positions and values of a line at the end of the run."""
    table = run.table(f"profiles/{profile}")
    names = [name for name in table if name != "time [s]"]
    return [start + float(name) for name in names], [table[name][-1] for name in names]


def largest_difference(what, rows, column, position, value, begin, end):
    """Of a computed line to the rows of a reference between two places.

    Within two cells of a wall the velocity is smeared: leave these out."""
    worst = max(abs(interpolated(position, value, row[0]) - row[column]) for row in rows
                if begin <= row[0] <= end)
    return Number(what, worst, 0, 0.02, BODY_FITTED)


def drag(run, body, reference, by_forcing, by_probes, source=BODY_FITTED):
    for how, tolerance in (("forcing", by_forcing), ("probes", by_probes)):
        yield relative(f"drag coefficient by {how}",
                       run.result[f"{body} drag coefficient by {how} [-]"], reference,
                       tolerance, source)


SEPARATION = 126.8  # degrees from the front, Re = 100, body-fitted program


def wake_at_re100(run, length, cell):
    yield Number("length of the wake, D", run.result["sphere wake end [m]"], 0.869, length,
                 BODY_FITTED)
    rows = read_reference("sphere_drag/axis_Re100.csv")
    for line, start, begin, end in (("front", -3, -3, -0.5 - 2 * cell),
                                    ("wake", 0.5, 0.5 + 2 * cell, 5.5)):
        yield largest_difference(f"axis, {line}: largest difference over U", rows, 1,
                                 *along(run, f"{line}_axial_velocity", start), begin, end)


@case(QUICK, "sphere_drag")
def sphere_drag_re100(run):
    yield from drag(run, "sphere", 1.089, 0.01, 0.03)
    yield from wake_at_re100(run, 0.03, 1 / 20)


@case(LONG, "sphere_drag", "Scene/Refinement = 2")
def sphere_drag_re100_refined(run):
    yield from drag(run, "sphere", 1.089, 0.01, 0.02)
    yield from wake_at_re100(run, 0.02, 1 / 40)
    fine = run.result["sphere separation angle [deg]"]
    yield Number("separation from the front, degrees", fine, SEPARATION, 3, BODY_FITTED)
    with SceneRun("sphere_drag") as coarse:
        yield observed_order("order of the separation angle, D/20 to D/40",
                             coarse.result["sphere separation angle [deg]"] - SEPARATION,
                             fine - SEPARATION, 1)


@case(LONG, "sphere_drag", "Fluid/Viscosity = 0.05", "Time/Time step = 0.007",
      "Scene/Refinement = 2")
def sphere_drag_re20(run):
    yield from drag(run, "sphere", 2.722, 0.01, 0.03)


@case(QUICK, "sphere_in_tube")
def sphere_in_tube(run):
    yield relative("drag coefficient by forcing",
                   run.result["sphere drag coefficient by forcing [-]"], 24 * 1.680, 0.005,
                   "Stokes, wall factor of Haberman & Sayre 1958")


def measured_drag(reynolds):
    """Roos & Willmarth 1971, along a straight line through the logarithms of the
    measurements within a factor 1.6 of the Reynolds number."""
    points = [(math.log(row[0] / reynolds), math.log(row[1]))
              for row in read_reference("sphere_drag/roos_willmarth_1971.csv")
              if abs(math.log(row[0] / reynolds)) < math.log(1.6)]
    x = sum(p[0] for p in points) / len(points)
    y = sum(p[1] for p in points) / len(points)
    slope = (sum((p[0] - x) * (p[1] - y) for p in points) /
             sum((p[0] - x) ** 2 for p in points))
    return math.exp(y - slope * x)


def beside_the_measured_drag(run, reynolds):
    yield relative("drag coefficient by forcing",
                   run.result["sphere drag coefficient by forcing [-]"],
                   measured_drag(reynolds), 0.05, "measured, Roos & Willmarth 1971")


@case(LONG, "sphere_drag", "Fluid/Viscosity = 0.02", "Time/Time step = 0.018")
def sphere_drag_re50(run):
    yield from beside_the_measured_drag(run, 50)


@case(LONG, "sphere_drag", "Fluid/Viscosity = 0.00666667")
def sphere_drag_re150(run):
    yield from beside_the_measured_drag(run, 150)


@case(LONG, "sphere_drag", "Fluid/Viscosity = 0.005")
def sphere_drag_re200(run):
    yield from beside_the_measured_drag(run, 200)


def torus(run, ratio, reference, on_axis):
    wall = 2 / 32
    yield from drag(run, "torus", reference, 0.02, 0.03)
    x, v = along(run, "axis_axial_velocity", -1)
    yield Number("velocity on the axis in the plane of the torus", interpolated(x, v, 0),
                 on_axis, 0.02, BODY_FITTED)
    for line, start, begin, end, columns in (
            ("axis", -1, -1, 6, ("axial",)),
            ("core", 0.5, 0.5 + wall, 5, ("axial", "radial")),
            ("hole", 0, 0, float(ratio) / 2 - 0.5 - wall, ("axial", "radial"))):
        rows = read_reference(f"torus/{line}_{ratio}.csv")
        for column, component in enumerate(columns, 1):
            yield largest_difference(
                f"{line}, {component} velocity: largest difference over U", rows, column,
                *along(run, f"{line}_{component}_velocity", start), begin, end)


@case(LONG, "torus_drag")
def torus_drag(run):
    yield from torus(run, "2", 1.0503, 1.064)


@case(LONG, "torus_drag", "Rigid body torus/Ring radius = 0.65",
      "Rigid body torus/Reference area = 4.08407",
      "Fluid/Grid/Radial breakpoints = 0, 1.4, 20.65",
      "Flow line core/Start = 0.65, 0.5", "Flow line core/End = 0.65, 5",
      "Flow line hole/End = 0.15, 0")
def torus_drag_ratio_1_3(run):
    yield from torus(run, "1.3", 0.9278, 0.537)
    for end, reference in (("begin", 0.62), ("end", 4.63)):
        yield relative(f"{end} of the reversed flow on the axis, D_s",
                       0.5 + run.result[f"torus wake {end} [m]"], reference, 0.02, BODY_FITTED)


def settling(run, reynolds, measured_peak, tolerance):
    """Largest speed, histories down to the gap 0.2 D, and the way to the floor.

    The speed is compared at the same times, over the largest speed; the gap too,
    over the 8 D of the fall. The largest speed stands beside the measured one."""
    diameter = 0.015
    table = run.table("statistics")
    time = table["time [s]"]
    gap = [y / diameter - 0.5 for y in table["sphere y [m]"]]
    velocity = table["sphere velocity y [m/s]"]
    rows = read_reference(f"sphere_settling/Re{reynolds}.csv")
    peak = max(-row[2] for row in rows)
    above = [row for row in rows if row[1] > 0.2]
    speed = -run.result["smallest sphere velocity y [m/s]"]
    yield relative("largest speed, m/s", speed, peak, tolerance, BODY_FITTED)
    yield relative("largest speed, m/s", speed, measured_peak, 0.04,
                   "measured, ten Cate et al. 2002")
    yield Number("speed over time, h > 0.2 D: largest difference over the peak",
                 max(abs(interpolated(time, velocity, row[0]) - row[2]) for row in above) / peak,
                 0, tolerance, BODY_FITTED)
    yield Number("gap over time, h > 0.2 D: largest difference over 8 D",
                 max(abs(interpolated(time, gap, row[0]) - row[1]) for row in above) / 8,
                 0, tolerance, BODY_FITTED)
    for level in (6, 4, 2, 1, 0.1):
        yield relative(f"time at the gap {level} D, s", crossing(time, gap, level),
                       crossing([row[0] for row in rows], [row[1] for row in rows], level),
                       tolerance, BODY_FITTED)


@case(QUICK, "settling_sphere")
def settling_sphere_re32(run):
    yield from settling(run, "31.9", 0.955 * 0.128, 0.015)


@case(LONG, "settling_sphere", "Scene/Refinement = 2")
def settling_sphere_re32_refined(run):
    yield from settling(run, "31.9", 0.955 * 0.128, 0.01)


@case(LONG, "settling_sphere", "Fluid/Density = 962 kg/m^3", "Fluid/Viscosity = 0.113 Pa s",
      "Time/Time step = 0.9 ms")
def settling_sphere_re12(run):
    yield from settling(run, "11.6", 0.959 * 0.091, 0.015)


@case(LONG, "settling_sphere", "Fluid/Density = 965 kg/m^3", "Fluid/Viscosity = 0.212 Pa s",
      "Time/Time step = 0.5 ms")
def settling_sphere_re4(run):
    yield from settling(run, "4.1", 0.953 * 0.060, 0.015)


@case(QUICK, "moving_window", "Scene/Refinement = 0.5")
def moving_window(run):
    # The same cells in a tube so long that its ends do not matter. A window of
    # 8 D with walls as ends would be 1.8 % off.
    source = "long tube at rest"
    with SceneRun("moving_window", "Scene/Refinement = 0.5", "Fluid/Moving window/Follow = ",
                  "Fluid/Upper boundary/Type = free-slip",
                  "Fluid/Grid/Axial breakpoints = -480 mm, 240 mm") as long_tube:
        reference = long_tube.result
    yield Number("window moved, cells", run.result["window shift [cells]"],
                 reference["sphere y [m]"] / 1.875e-3, 4.5, source)  # Cells, and a step
    for what, column, tolerance in (("way in 3 s, m", "sphere y [m]", 1e-3),
                                    ("speed after 23 D, m/s", "sphere velocity y [m/s]", 2e-3)):
        yield relative(what, run.result[column], reference[column], tolerance, source)


# --- coupled ------------------------------------------------------------------

@case(QUICK, "rod_in_annulus")
def rod_in_annulus(run):
    for probe, where, reference in (("axis", "on the axis", 0.167620),
                                    ("interface", "at the interface", 0.057523),
                                    ("fluid", "at r = 0.75", 0.155971)):
        table = run.table(f"probes/{probe}")
        last_period = [abs(v) for t, v in zip(table["time [s]"],
                                              table["axial velocity [m/s]"])
                       if t >= table["time [s]"][-1] - 1]
        yield relative(f"amplitude of v_y {where}", max(last_period), reference, 0.015, FORMULA)


def damped_frequency(t, u, start, lag):
    """omega of u ~ exp(-i omega t): the best a, b of u(t + lag) = a u(t) - b u(t - lag)."""
    shift = round(lag / (t[1] - t[0]))
    lag = shift * (t[1] - t[0])
    first = next(k for k, time in enumerate(t) if time >= start)
    rows = [(u[k], u[k - shift], u[k + shift]) for k in range(first + shift, len(t) - shift)]
    xx, xy, yy, xz, yz = (sum(row[i] * row[j] for row in rows)
                          for i, j in ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2)))
    determinant = xx * yy - xy * xy
    a, minus_b = (xz * yy - yz * xy) / determinant, (yz * xx - xz * xy) / determinant
    return (math.acos(a / (2 * math.sqrt(-minus_b))) / lag, math.log(-minus_b) / (2 * lag))


def tube_wave(run, outer_radius, density, damping):
    # The first half period holds the transient of the Stokes layers.
    exact = next(row for row in read_reference("fsi/tube_wave.csv")
                 if row[:2] == [outer_radius, density])
    table = run.table("probes/antinode")
    omega = damped_frequency(table["time [s]"], table["radial displacement [m]"], 11, 3)
    yield relative("speed of the wave, omega L / (2 pi), m/s", omega[0] * 20 / (2 * math.pi),
                   exact[2] * 20 / (2 * math.pi), 0.05, FORMULA)
    if damping:
        yield relative("decay of the wave, 1/s", -omega[1], -exact[3], damping, FORMULA)


@case(QUICK, "tube_wave")
def tube_wave_as_heavy_as_the_fluid(run):
    yield from tube_wave(run, 1.1, 1.0, 0.1)


@case(QUICK, "tube_wave", "Elasticity/Density = 0.1 kg/m^3", "Body/Outer radius = 1.05 m")
def tube_wave_light_and_thin(run):
    yield from tube_wave(run, 1.05, 0.1, None)


def crest(table):
    """Time and height of the largest radial displacement, by a parabola."""
    t, u = table["time [s]"], table["radial displacement [m]"]
    k = max(range(1, len(u) - 1), key=u.__getitem__)
    slope, curvature = (u[k + 1] - u[k - 1]) / 2, u[k + 1] - 2 * u[k] + u[k - 1]
    return t[k] - slope / curvature * (t[k + 1] - t[k]), u[k] - slope**2 / (2 * curvature)


@case(LONG, "tube_pulse")
def tube_pulse(run):
    near, far = read_reference("fsi/tube_pulse.csv")
    (t, u), (later, lower) = crest(run.table("probes/near")), crest(run.table("probes/far"))
    way = far[0] - near[0]
    yield relative("speed of the pulse between the stations, m/s", way / (later - t),
                   way / (far[1] - near[1]), 0.05, FORMULA)
    yield relative("height at the second station over that at the first", lower / u, far[2], 0.05,
                   FORMULA)
