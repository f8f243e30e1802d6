#!/usr/bin/env python3
"""Stands in for ephyra-binary: result.csv with f(h) = 3 + 5 h^2, h = 1/Cells.
A run says that it took 2 s and 3 s of processor time; a slow one, 1.5 s and
2.5 s before its checkpoint.

"square [-]" is (Cells - 3)^2 and "jump [-]" the sign of Cells - 3. Beyond
Model/Most cells a run diverges.

Model/Behaviour: `good`, `diverges`, `bad input`, or `slow`, which waits for
SIGUSR1, leaves a checkpoint and is done when resumed."""

import pathlib
import signal
import sys
import time

arguments = sys.argv[1:]
values = {"Model/Behaviour": "good", "Model/Cells": "1", "Model/Most cells": "inf"}
folder = None
resumed = False
while arguments:
    option = arguments.pop(0)
    if option == "--set":
        entry, _, value = arguments.pop(0).partition("=")
        values[entry.strip()] = value.strip()
    elif option in ("--output", "--resume"):
        folder = pathlib.Path(arguments.pop(0))
        resumed = option == "--resume"

folder.mkdir(parents=True, exist_ok=True)
with open(folder / "calls.txt", "a") as file:
    file.write("resumed\n" if resumed else "started\n")

behaviour = values["Model/Behaviour"]
cells = float(values["Model/Cells"])
if behaviour == "diverges" or cells > float(values["Model/Most cells"]):
    print("The step did not converge.")
    sys.exit(2)
if behaviour == "bad input":
    sys.exit(1)
if behaviour == "slow" and not resumed:
    signal.signal(signal.SIGUSR1, lambda *_: None)
    (folder / "ready").touch()
    signal.pause()
    (folder / "checkpoints").mkdir()
    (folder / "checkpoints" / "checkpoint_000000001.h5").touch()
    (folder / "result.csv").write_text("wall time [s],cpu time [s]\n1.5,2.5\n")
    sys.exit(3)

time.sleep(0.01)
h = 1 / cells
(folder / "result.csv").write_text(
    "wall time [s],cpu time [s],drag [N],constant [1],error of speed [m/s],name,square [-],"
    "jump [-]\n"
    f"2,3,{3 + 5 * h**2},1,{0.1 * h**3},text,{(cells - 3)**2},{1 if cells > 3 else -1}\n")
