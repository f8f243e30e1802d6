"""Runs of the shipped scenes, and their tables."""

import bisect
import csv
import math
import os
import pathlib
import shutil
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCENES = ROOT / "parameters" / "verification"
REFERENCE = ROOT / "tests" / "verification" / "reference"
BINARY = os.environ.get("EPHYRA_BINARY", str(ROOT / "build" / "ephyra-binary"))


def read_table(path):
    """{column: list of numbers} of a table with a header."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}


def read_reference(name):
    """Rows of numbers; comments and a line of names are left out."""
    rows = []
    for line in (REFERENCE / name).read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#") and line[0] in "-.0123456789":
            rows.append([float(value) for value in line.split(",")])
    return rows


def crossing(x, y, level):
    """Where y(x), linear between its points, first passes the level."""
    for k in range(1, len(y)):
        if (y[k - 1] - level) * (y[k] - level) <= 0 and y[k] != y[k - 1]:
            return x[k - 1] + (x[k] - x[k - 1]) * (level - y[k - 1]) / (y[k] - y[k - 1])
    raise ValueError(f"the level {level} is not reached")


def interpolated(x, y, at):
    """y at a place between the growing x, linear between the points."""
    k = min(max(bisect.bisect_right(x, at), 1), len(x) - 1)
    return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1])


def order(coarse, fine):
    """Observed order from two errors, the second at half the size."""
    return math.log2(abs(coarse) / abs(fine))


class SceneRun:
    """One run of a scene with overrides, in a folder of its own."""

    def __init__(self, scene, *overrides, ranks=1):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="ephyra-scene-"))
        command = ["mpiexec", "-n", str(ranks)] if ranks > 1 else []
        command += [BINARY, str(SCENES / f"{scene}.prm"), "--quiet", "--overwrite",
                    "--output", str(self.folder)]
        for override in overrides:
            command += ["--set", override]
        result = subprocess.run(command, capture_output=True, text=True, check=False,
                                stdin=subprocess.DEVNULL)
        if result.returncode != 0:
            raise RuntimeError(f"{' '.join(command)} gives exit code {result.returncode}:\n"
                               f"{result.stdout}{result.stderr}")
        self.result = {name: values[0] for name, values in self.table("result").items()}

    def table(self, name):
        return read_table(self.folder / f"{name}.csv")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder)
