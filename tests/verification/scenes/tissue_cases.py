"""Cases of cases.py: tissues on moving lines."""

from cases import LONG, Number, case


@case(LONG, "beating_line")
def beating_line(run):
    source = "the first cycle"
    arrival = run.table("profiles/map_arrival")
    cycles = [round(10 * t) for t in arrival["time [s]"]]
    travel = [arrival["0.2"][cycles.index(10 * k + 1)] - arrival["0.8"][cycles.index(10 * k + 1)]
              for k in range(10)]
    for cycle in (1, 4, 9):
        yield Number(f"travel time in cycle {cycle + 1}, ms", 1e3 * travel[cycle],
                     1e3 * travel[0], 2e-3, source)
    yield Number("smallest potential, mV", 1e3 * run.result["smallest smallest potential [V]"],
                 -71.1, 0.1, "undershoot of the isolated neuron")
    table = run.table("statistics")
    time, v = table["time [s]"], table["largest potential [V]"]
    rest = [1e3 * potential for t, potential in zip(time, v) if t % 1 > 0.5]
    for what, potential in (("smallest", min(rest)), ("largest", max(rest))):
        yield Number(f"{what} potential between the waves, mV", potential, -70.762, 0.002,
                     "rest of the neuron")
