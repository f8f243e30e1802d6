"""Accounts of energy of moving bodies, and electromechanics without a flow."""

from cases import LONG, QUICK, Number, case, observed_order
from scene_run import SceneRun


def imbalance(run):
    """At the end, over the largest elastic energy."""
    table = run.table("statistics")
    return (table["energy imbalance of body [J]"][-1]
            / max(table["elastic energy [J]"]))


@case(QUICK, "bell_stroke")
def bell_stroke(run):
    fine = imbalance(run)
    with SceneRun("bell_stroke", "Time/Time step = 10 ms") as other:
        coarse = imbalance(other)
    yield Number("energy imbalance over elastic energy, 5 ms", fine, 0, 1e-4, "theory")
    yield observed_order("order of the imbalance in the step", coarse, fine, 2)


@case(QUICK, "../jellyfish/vacuum")
def electromechanics_in_vacuum(run):
    table = run.table("statistics")
    yield Number("energy imbalance over elastic energy", imbalance(run), 0, 5e-4, "theory")
    # The muscle does all the work: it ends as elastic, kinetic and lost energy.
    kept = sum(table[name][-1] for name in ("elastic energy [J]", "kinetic energy of body [J]",
                                            "numerical dissipation [J]"))
    yield Number("energy kept and lost over muscle work",
                 kept / table["muscle work [J]"][-1], 1, 5e-4, "theory")
    yield Number("drop of the inner margin, at least 10 %",
                 min(table["drop of inner margin diameter [-]"][-1], 0.1), 0.1, 0, "theory")
    flow = [name for name in table
            if any(word in name for word in ("flow", "fluid", "CFL", "divergence"))]
    flow += [str(path) for path in run.folder.rglob("*flow*")]
    with open(run.folder / "timing.csv", encoding="utf-8") as file:
        flow += [line for line in file
                 if any(word in line for word in ("predict", "project", "interface", "poisson"))]
    yield Number("columns, files and phases of a flow", len(flow), 0, 0, "theory")


def swimmer_imbalance(run):
    """Of body and fluid at the end, over the work of the muscle."""
    table = run.table("statistics")
    return abs(table["energy imbalance [J]"][-1]) / table["muscle work [J]"][-1]


@case(QUICK, "../jellyfish/prescribed", "Scene/Refinement = 0.5", "Time/End time = 1.2 s",
      "Time/Time step = 1 ms", "Fluid/Energy budget = true")
def prescribed_bell_in_water(run):
    table = run.table("statistics")
    yield Number("energy imbalance over muscle work", swimmer_imbalance(run), 0, 1e-4, "theory")
    # Body, fluid and what lies between them share the terms.
    work = {name: table[name][-1] for name in table if "[J]" in name}
    total = (work["elastic energy [J]"] + work["kinetic energy of body [J]"]
             + work["kinetic energy of fluid [J]"] + work["numerical dissipation [J]"]
             + work["viscous dissipation [J]"] + work["work lost at interface [J]"]
             - work["work at sides [J]"] - work["energy through window [J]"]
             - work["energy imbalance [J]"])
    yield Number("sum of all terms over muscle work", total / work["muscle work [J]"], 1, 1e-9,
                 "theory")
    nerves = [name for name in table if "potential" in name]
    with open(run.folder / "timing.csv", encoding="utf-8") as file:
        nerves += [line for line in file if "electrophysiology" in line]
    yield Number("columns and phases of a nerve net", len(nerves), 0, 0, "theory")


@case(QUICK, "../jellyfish/towed_bell", "Scene/Refinement = 0.5", "Time/End time = 3 s")
def towed_bell(run):
    # Two ways to the force of the fluid: the forcing, and probes on the surface.
    result = run.result
    forcing, probes = (result[f"bell force y by {way} [N]"] for way in ("forcing", "probes"))
    yield Number("force by probes over that by forcing", probes / forcing, 1, 0.1, "theory")
    with open(run.folder / "timing.csv", encoding="utf-8") as file:
        others = [line for line in file if "elasticity" in line or "electro" in line]
    yield Number("phases of body and nerve net", len(others), 0, 0, "theory")


@case(LONG, "../jellyfish/baseline", "Time/End time = 2 s", "Fluid/Energy budget = true")
def budget_of_a_stroke(run):
    fine = swimmer_imbalance(run)
    yield Number("energy imbalance over muscle work, a_ex/64", fine, 0, 0.02, "theory")
    with SceneRun("../jellyfish/baseline", "Time/End time = 2 s", "Fluid/Energy budget = true",
                  "Time/Time step = 0.25 ms") as other:
        finer = swimmer_imbalance(other)
    yield Number("the same at half the step over that, at most 0.7", max(finer / fine, 0.7), 0.7,
                 0, "theory")
