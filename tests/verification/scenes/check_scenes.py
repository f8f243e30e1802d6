#!/usr/bin/env python3
"""Runs the shipped verification scenes and compares them with the references.

    check_scenes.py quick|long|NAME ...    pass or fail
    check_scenes.py --table quick long     the table of docs/verification/README.md
"""

import sys

import bell_cases  # noqa: F401, adds to CASES
import elasticity_cases  # noqa: F401, adds to CASES
import energy_cases  # noqa: F401, adds to CASES
import flow_cases  # noqa: F401, adds to CASES
import jellyfish_cases  # noqa: F401, adds to CASES
import tissue_cases  # noqa: F401, adds to CASES
from cases import CASES
from scene_run import SceneRun


def selected(names):
    unknown = set(names) - {"quick", "long"} - {entry[0] for entry in CASES}
    if unknown or not names:
        sys.exit("Cases: quick, long, " + ", ".join(entry[0] for entry in CASES))
    return [entry for entry in CASES if entry[0] in names or entry[1] in names]


def main(arguments):
    table = "--table" in arguments
    failures = 0
    for name, _, scene, overrides, function in selected(
            [a for a in arguments if a != "--table"]):
        with SceneRun(scene, *overrides) as run:
            numbers = list(function(run))
            seconds = run.result["wall time [s]"]
        command = " ".join([f"`{scene}.prm`",
                            *(f"`--set \"{override}\"`" for override in overrides)])
        for number in numbers:
            failures += not number.passes()
            if table:
                print(f"| {command} | {number.what} | {number.value:.6g} | "
                      f"{number.reference:.6g} | {number.difference()} | {number.source} |",
                      flush=True)
                command = ""
            else:
                print(f"{'pass' if number.passes() else 'FAIL'}  {name}: {number.what}: "
                      f"{number.value:.8g}, reference {number.reference:.8g} "
                      f"+- {number.tolerance:.2g} ({seconds:.1f} s)", flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
