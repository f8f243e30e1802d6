"""Runs ephyra-binary on the scenes of tests/scenes, for the tests beside."""

import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "tests" / "scenes"
BINARY = os.environ.get("EPHYRA_BINARY", str(ROOT / "build" / "ephyra-binary"))
if not os.access(BINARY, os.X_OK):
    print(f"skipped: {BINARY} is not built")
    sys.exit(77)


def command(ranks, *arguments):
    mpirun = ["mpirun", "-q", "-n", str(ranks)] if ranks > 1 else []
    return [*mpirun, BINARY, *[str(a) for a in arguments]]


class ProgramTest(unittest.TestCase):
    """Each test has an empty folder of its own, self.folder."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def run_program(self, *arguments, ranks=1):
        """Exit code and text of the errors."""
        result = subprocess.run(command(ranks, *arguments), cwd=self.folder, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, timeout=120, check=False)
        return result.returncode, result.stderr

    def succeed(self, *arguments, ranks=1):
        code, errors = self.run_program(*arguments, ranks=ranks)
        self.assertEqual((code, errors), (0, ""))

    def content(self, folder):
        """All files below a folder with their bytes."""
        return {path: path.read_bytes() for path in sorted(folder.glob("**/*"))
                if path.is_file()}


def read_rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def largest_difference(a, b, scales=None):
    """Largest difference of two tables, column by column relative to the
    largest value of the column, and where it is."""
    assert len(a) == len(b), f"{len(a)} and {len(b)} rows"
    worst = (0.0, "")
    for name in a[0]:
        scale = max(abs(float(row[name])) for row in a)
        for row_a, row_b in zip(a, b):
            difference = abs(float(row_a[name]) - float(row_b[name]))
            if not math.isfinite(difference) or difference > worst[0] * scale:
                worst = (difference / scale if scale > 0 else math.inf, name)
    return worst
