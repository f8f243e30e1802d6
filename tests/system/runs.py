"""Runs of the whole program for the tests of this folder."""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)  # CTest: skipped

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCENES = ROOT / "tests" / "system" / "scenes"
BINARY = os.environ.get("EPHYRA_BINARY", str(ROOT / "build" / "ephyra-binary"))
MPIEXEC = os.environ.get("EPHYRA_MPIEXEC", "mpiexec")


def command(*arguments, ranks=1):
    start = [MPIEXEC, "-n", str(ranks)] if ranks > 1 else []
    return [*start, BINARY, *map(str, arguments)]


def sets(**entries):
    """Options --set; a double underscore separates section and entry, a single
    one stands for a blank."""
    return [word for name, value in entries.items()
            for word in ("--set", name.replace("__", "/").replace("_", " ") + f" = {value}")]


class Table:
    """A CSV file: names of the columns, and the values."""

    def __init__(self, path):
        with open(path, encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        self.names = rows[0]
        self.values = numpy.array(rows[1:], dtype=float)

    def __getitem__(self, name):
        return self.values[:, self.names.index(name)]


# A body pushed upwards, so that its window moves within 50 steps.
WINDOW_OF_SWIMMER = sets(Fluid__Moving_window__Follow="swimmer",
                         Fluid__Moving_window__Cells=1,
                         Body__Axial_position="40 mm",
                         Elasticity__Axial_body_force="4e3 N/m^3")


def tells_effort(column):
    """Residuals, numbers of iterations and the divergence say how a step was
    solved, not what came out: they are at the level of tolerances or round-off."""
    return any(word in column for word in ("residual", "iterations", "divergence"))


class SystemTest(unittest.TestCase):
    """A test with an empty folder of its own, in which the program runs."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, *arguments, ranks=1, code=0):
        """Runs the program and checks its exit code; returns the process."""
        process = subprocess.run(command(*arguments, ranks=ranks), cwd=self.folder,
                                 capture_output=True, text=True, stdin=subprocess.DEVNULL,
                                 timeout=120, check=False)
        self.assertEqual(process.returncode, code, process.stderr + process.stdout)
        return process

    def run_scene(self, scene, name, *options, ranks=1, code=0):
        """Runs one of the scenes in the folder `name`."""
        return self.run_program(SCENES / scene, "--output", name, "--quiet", *options,
                                ranks=ranks, code=code)

    def table(self, run, name="statistics.csv"):
        return Table(self.folder / run / name)

    def files(self, run):
        """Every file of a folder and what is in it."""
        return {path: path.read_bytes() for path in sorted((self.folder / run).glob("**/*"))
                if path.is_file()}

    def assert_refused(self, process, *parts):
        """The error names all parts, once, and nothing else went wrong."""
        message = process.stderr
        for part in parts:
            self.assertEqual(message.count(part), 1, f"{part!r} in {message}")
        for bad in ("terminate called", "Internal error", "HDF5-DIAG", "Segmentation"):
            self.assertNotIn(bad, message)

    def assert_same(self, run, reference, tolerance):
        """Equal statistics: differences relative to the scale of the column, or
        of the energies for what is a small difference of these."""
        a, b = self.table(run), self.table(reference)
        self.assertEqual(a.names, b.names)
        self.assertEqual(list(a["step [-]"]), list(b["step [-]"]))
        self.assertTrue(numpy.isfinite(a.values).all())
        for name in a.names:
            if tells_effort(name):
                continue
            scale = numpy.abs(b[name]).max()
            if name in ("energy imbalance of body [J]", "numerical dissipation [J]",
                        "energy imbalance [J]", "energy imbalance of fluid [J]",
                        "work at sides [J]", "energy through window [J]"):
                scale = max(scale, numpy.abs(b["elastic energy [J]"]).max())
            difference = numpy.abs(a[name] - b[name]).max()
            self.assertLessEqual(difference, tolerance * scale, f"{run}: {name}")


def main():
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]])
