"""Cases of cases.py: the swimming jellyfish."""

import math

from cases import LONG, PAPER, QUICK, Number, case, observed_order, relative
from scene_run import SceneRun

DENSITY = 1100  # of the bell, kg/m^3


def momentum_error(run):
    """Largest and root mean square of the difference of the momentum of the bell and
    the impulse of the flow on it, over the largest momentum."""
    table = run.table("statistics")
    time, force = table["time [s]"], table["fluid force y [N]"]
    mass = DENSITY * table["volume [m^3]"][0]
    momentum = [mass * v for v in table["centre of mass velocity y [m/s]"]]
    impulse = [0]
    for k in range(1, len(time)):
        impulse.append(impulse[-1] + force[k] * (time[k] - time[k - 1]))
    error = [a - b for a, b in zip(momentum, impulse)]
    scale = max(map(abs, momentum))
    return max(map(abs, error)) / scale, math.hypot(*error) / math.sqrt(len(error)) / scale


# The contraction of the first stroke at a_ex/32, with steps of 1 and 0.5 ms.
START = ("Scene/Refinement = 0.5", "Time/End time = 0.3 s",
         "Output/Statistics/Time interval = 0", "Output/Statistics/Step interval = 1")


@case(QUICK, "../jellyfish/baseline", *START)
def jellyfish_momentum(run):
    _, coarse = momentum_error(run)
    with SceneRun("../jellyfish/baseline", *START, "Time/Time step = 0.25 ms") as other:
        largest, fine = momentum_error(other)
    yield Number("momentum less impulse, over the largest momentum", largest, 0, 3e-3, "theory")
    yield Number("its root mean square", fine, 0, 1e-3, "theory")
    # The load acts with its value at the end of the step. The largest error falls more
    # slowly: the force jumps when a marker passes a node, by the more the shorter the step.
    yield observed_order("order of that in the step", coarse, fine, 1)


@case(LONG, "../jellyfish/baseline", "Time/End time = 6 s", "Output/Start of averages = 4 s")
def jellyfish_baseline(run):
    yield relative("drop of the margin in the third stroke",
                   run.result["largest drop of margin diameter [-]"], 0.32, 5e-3,
                   f"tuned to {PAPER}, section 4.1")
