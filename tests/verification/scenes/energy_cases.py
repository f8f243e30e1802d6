"""Accounts of energy of moving bodies, and electromechanics without a flow."""

from cases import QUICK, Number, case, observed_order
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
