"""Exact flows, what inviscid flow keeps, vortex rings, spheres in Stokes flow.

The numbers join those of cases.py."""

import math

from cases import (FORMULA, INDEPENDENT, LONG, QUICK, Number, case, observed_order,
                   relative)
from scene_run import SceneRun, read_reference


@case(QUICK, "stokes_eigenmode_slip", "Scene/Refinement = 4")
def stokes_eigenmode_slip(run):
    k, b = math.pi, 3.8317059702075125
    exact = -b / k * math.exp(-0.1 * (k * k + b * b) * 0.3)
    column = "centre axial velocity [m/s]"
    yield relative("v_y on the axis at t = 0.3", run.result[column], exact, 2e-3, FORMULA)
    with SceneRun("stokes_eigenmode_slip", "Scene/Refinement = 2", ranks=2) as coarse:
        yield observed_order("order, 25 to 50 cells a length, stretched",
                             coarse.result[column] - exact, run.result[column] - exact, 2)


@case(QUICK, "bessel_mode", "Scene/Refinement = 4", "Time/Time step = 0.002")
def bessel_mode(run):
    exact = math.exp(-5.783185962946785 * 0.2 * 0.5)
    column = "axis axial velocity [m/s]"
    yield relative("v_y on the axis at t = 0.5", run.result[column], exact, 5e-4, FORMULA)
    with SceneRun("bessel_mode", "Scene/Refinement = 2", "Time/Time step = 0.004") as coarse:
        yield observed_order("order, explicit viscosity, stretched",
                             coarse.result[column] - exact, run.result[column] - exact, 2)


def womersley(run, exact, tolerance, cells):
    """v i omega/K on the axis from the last period."""
    table = run.table("probes/axis")
    samples = [(t, v) for t, v in zip(table["time [s]"], table["axial velocity [m/s]"])
               if t > table["time [s]"][-1] - 1 + 1e-9]
    mean = sum(v * complex(math.cos(2 * math.pi * t), -math.sin(2 * math.pi * t))
               for t, v in samples) * 2 / len(samples)
    found = mean * 2j * math.pi
    where = f"v i omega/K on the axis, {cells} cells"
    yield Number(f"real part of {where}", found.real, exact.real, tolerance, FORMULA)
    yield Number(f"imaginary part of {where}", found.imag, exact.imag, tolerance, FORMULA)
    return found - exact


@case(QUICK, "womersley", "Scene/Refinement = 2")
def womersley_5(run):
    error = yield from womersley(run, 1.160456 + 0.002988j, 8e-4, 32)
    with SceneRun("womersley") as coarse_run:
        coarse = yield from womersley(coarse_run, 1.160456 + 0.002988j, 3e-3, 16)
    yield observed_order("order", abs(coarse), abs(error), 2)


@case(QUICK, "womersley", "Fluid/Viscosity = 0.06283185307179587", "Time/End time = 30",
      "Scene/Refinement = 2")
def womersley_10(run):
    yield from womersley(run, 0.993817 + 0.002510j, 4e-4, 32)


@case(QUICK, "diffusing_ring", "Scene/Refinement = 2")
def diffusing_ring(run):
    exact = 1 - math.exp(-1 / (4 * 0.08))
    yield relative("circulation", run.result["circulation [m^2/s]"], exact, 1e-3, FORMULA)
    yield relative("impulse", run.result["all vortex impulse [kg m/s]"], math.pi, 2e-3, FORMULA)
    with SceneRun("diffusing_ring") as coarse:
        for column, reference in (("circulation [m^2/s]", exact),
                                  ("all vortex impulse [kg m/s]", math.pi)):
            yield observed_order(f"order of the {column.split(' [')[0].split()[-1]}",
                                 coarse.result[column] - reference,
                                 run.result[column] - reference, 2)


@case(QUICK, "inviscid_vortices", "Time/Time step = 0.01")
def inviscid_vortices(run):
    def drift(some_run):
        energy = some_run.table("statistics")["kinetic energy [J]"]
        return energy[-1] / energy[0] - 1

    fine = drift(run)
    yield Number("drift of the kinetic energy", fine, 0, 3e-5, "theory")
    with SceneRun("inviscid_vortices", "Time/Time step = 0.02") as coarse:
        yield observed_order("order of the drift in time", drift(coarse), fine, 3)


@case(QUICK, "hill_vortex", "Scene/Refinement = 2")
def hill_vortex(run):
    table = run.table("statistics")
    source = "exact, unbounded"
    for what, column, reference, tolerance in (
            ("circulation, m^2/s", "hill circulation [m^2/s]", 5, 1e-3),
            ("impulse, kg m/s", "hill vortex impulse [kg m/s]", 2 * math.pi, 1e-3),
            ("kinetic energy, J", "kinetic energy [J]", 10 * math.pi / 7, 3e-3)):
        for when, row in (("start", 0), ("end", -1)):
            yield relative(f"{what}, at the {when}", table[column][row], reference, tolerance,
                           source)
    yield Number("drift of the circulation", table["hill circulation [m^2/s]"][-1] /
                 table["hill circulation [m^2/s]"][0] - 1, 0, 3e-4, source)
    yield relative("speed at the end, m/s", table["hill ring speed [m/s]"][-1], 1, 0.01, source)
    yield relative("place at the end, m", table["hill ring y [m]"][-1], 2, 0.02, source)


def at(table, column, time):
    """Value of a column of the statistics, linear in time."""
    times, values = table["time [s]"], table[column]
    k = next(k for k in range(1, len(times)) if times[k] >= time - 1e-9)
    share = (time - times[k - 1]) / (times[k] - times[k - 1])
    return values[k - 1] + share * (values[k] - values[k - 1])


NET, POSITIVE = "circulation [m^2/s]", "positive circulation [m^2/s]"


def slope(table):
    return (at(table, NET, 5) - at(table, NET, 2)) / 3


@case(LONG, "vortex_ring")
def vortex_ring(run):
    table = run.table("statistics")
    source = f"{INDEPENDENT}, D/60 and D/120"
    rows = read_reference("vortex_ring/stroke6.csv")
    series = {"time [s]": [row[0] for row in rows], NET: [row[1] for row in rows]}
    differences = {time: abs(net / at(series, NET, time) - 1)
                   for time, net in zip(table["time [s]"], table[NET]) if 0.3 < time <= 16}
    yield Number("largest relative difference of the circulation, 1 < t < 16",
                 max(d for time, d in differences.items() if time > 1), 0, 0.004, source)
    yield Number("the same, 0.3 < t < 1",
                 max(d for time, d in differences.items() if time <= 1), 0, 0.02, source)
    for time, reference in ((1, 0.823), (2, 1.249), (4, 2.236), (6, 3.239), (8, 3.142),
                            (10, 3.194), (12, 3.170), (16, 3.035)):
        yield relative(f"circulation at t = {time}", at(table, NET, time), reference, 0.005,
                       source)
    for time, reference in ((2, 1.316), (4, 2.285), (6, 3.275), (8, 3.276), (10, 3.257),
                            (12, 3.209), (16, 3.055)):
        yield relative(f"positive circulation at t = {time}", at(table, POSITIVE, time),
                       reference, 0.01, source)
    yield Number("slope of the circulation, 2 < t < 5", slope(table), 0.497, 0.005, source)
    flux = "inlet shear vorticity flux lower [m^2/s^2]"
    for time in (1, 3, 5):
        yield Number(f"flux of vorticity through the inlet at t = {time}",
                     at(table, flux, time), 0.5, 0.002, "exact, U^2/2")
    yield Number("place of the ring at t = 10", at(table, "jet ring y [m]", 10), 4.14, 0.03,
                 source)
    yield Number("speed of the ring, 10 < t < 12, by its place",
                 (at(table, "jet ring y [m]", 12) - at(table, "jet ring y [m]", 10)) / 2, 0.455,
                 0.005, source)
    yield Number("speed of the ring at t = 10, by its vorticity",
                 at(table, "jet ring speed [m/s]", 10), 0.455, 0.014, source)


@case(LONG, "vortex_ring_stroke8")
def vortex_ring_stroke8(run):
    table = run.table("statistics")
    with SceneRun("vortex_ring_stroke8", "Scene/Refinement = 0.5") as coarse_run:
        coarse = coarse_run.table("statistics")
    for time in (2, 4, 6, 8, 10, 12, 16):
        yield relative(f"circulation at t = {time}, D/30", at(coarse, NET, time),
                       at(table, NET, time), 0.015, "the same with D/60")
    yield Number("flux of vorticity through the inlet at t = 5",
                 at(table, "inlet shear vorticity flux lower [m^2/s^2]", 5), 0.5, 0.002,
                 "exact, U^2/2")


def stimson_jeffery(distance):
    """Drag of each of two equal spheres that follow each other in Stokes flow over that
    of one alone, the distance of their centres in diameters: Stimson & Jeffery 1926,
    10.1098/rspa.1926.0053; .645 where they touch."""
    a = math.acosh(distance)
    total = 0
    for n in range(1, 200):
        fraction = (4 * math.sinh((n + 0.5) * a) ** 2 - (2 * n + 1) ** 2 * math.sinh(a) ** 2) / (
            2 * math.sinh((2 * n + 1) * a) + (2 * n + 1) * math.sinh(2 * a))
        total += n * (n + 1) / ((2 * n - 1) * (2 * n + 3)) * (1 - fraction)
    return 4 / 3 * math.sinh(a) * total


@case(LONG, "two_stokes_spheres")
def two_stokes_spheres(run):
    def steady(some_run, body):
        """Extrapolated in 1/sqrt(t) from t = 6.25 and 25."""
        table = some_run.table("statistics")
        column = f"{body} force y by forcing [N]"
        return 2 * at(table, column, 25) - at(table, column, 6.25)

    with SceneRun("stokes_sphere") as single:
        alone = steady(single, "front")
    yield relative("drag of one sphere over 3 pi", alone / (3 * math.pi), 1, 0.005, FORMULA)
    for body in ("front", "rear"):
        yield relative(f"drag of the {body} sphere over that of one alone",
                       steady(run, body) / alone, stimson_jeffery(2), 0.005,
                       "Stimson & Jeffery 1926, 10.1098/rspa.1926.0053")
