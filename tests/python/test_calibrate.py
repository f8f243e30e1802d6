"""The calibration: brackets, failures, reuse, and what it says."""

import contextlib
import csv
import io
import math
import os
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))
import calibrate
from bracket import Bracket

FAKE = pathlib.Path(__file__).with_name("fake_binary.py")


def solve(function, low, high, tolerance=1e-9):
    """(bracket, number of evaluations) of the search for a root."""
    bracket = Bracket((low, high))
    for count in range(1, 200):
        x = bracket.next()
        if x is None:
            break
        bracket.add(x, function(x))
        if bracket.best() and abs(bracket.best()[1]) <= tolerance:
            break
    return bracket, count


class Brackets(unittest.TestCase):
    def test_smooth_functions(self):
        for function, low, high, root in (
                (lambda x: x**3 - 2, 0, 4, 2**(1 / 3)), (lambda x: 1 - 2 * x, -3, 1, 0.5),
                (lambda x: math.exp(-x) - x, 0, 1, 0.567143290410)):
            bracket, count = solve(function, low, high)
            self.assertAlmostEqual(bracket.best()[0], root, delta=1e-8)
            self.assertTrue(bracket.is_monotone)
            self.assertLess(count, 20)

    def test_hard_functions_take_bisection(self):
        # Plain regula falsi would creep along one end here.
        for function in (lambda x: x**15 - 1e-3, lambda x: math.copysign(abs(x - 1)**0.5, x - 1)):
            bracket, count = solve(function, 0, 3, 1e-3)
            self.assertLessEqual(abs(bracket.best()[1]), 1e-3)
            self.assertLess(count, 110)

    def test_jump(self):
        bracket, _ = solve(lambda x: math.copysign(1, x - 0.3), 0, 1)
        self.assertIsNone(bracket.next())
        self.assertLess(bracket.ends[1] - bracket.ends[0], 2e-9)
        self.assertTrue(bracket.ends[0] <= 0.3 <= bracket.ends[1])

    def test_failure_at_an_end_and_inside(self):
        bracket, _ = solve(lambda x: None if x > 0.7 else x - 0.6, 0, 1)
        self.assertAlmostEqual(bracket.best()[0], 0.6)
        bracket, _ = solve(lambda x: None if x < 0.3 else x - 0.6, 0, 1)
        self.assertAlmostEqual(bracket.best()[0], 0.6)
        bracket, _ = solve(lambda x: None if 0.45 < x < 0.55 else x**2 - 0.31, 0, 1)
        self.assertAlmostEqual(bracket.best()[0], math.sqrt(0.31))
        bracket, _ = solve(lambda x: None if x > 0.5 else x - 0.6, 0, 1)
        self.assertIsNone(bracket.next())
        good, bad = bracket.gap_to_failure()
        self.assertTrue(0.499 < good <= 0.5 < bad < 0.501)

    def test_not_monotone(self):
        self.assertFalse(solve(lambda x: (x - 1)**2 - 0.5, 0, 1.5)[0].is_monotone)


class Runs(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.scene = self.folder / "scene.prm"
        self.scene.write_text("# scene\n")
        self.output = self.folder / "out"

    def calibrate(self, target, vary="Model/Cells = 1 : 5", *options):
        screen = io.StringIO()
        with contextlib.redirect_stdout(screen), contextlib.redirect_stderr(screen):
            code = calibrate.main([str(self.scene), "--binary", str(FAKE), "--output",
                                   str(self.output), "--target", target, "--vary", vary, *options])
        return code, screen.getvalue()

    def table(self):
        with open(self.output / "calibrate.csv", newline="") as file:
            return list(csv.DictReader(file))

    def n_calls(self):
        return sum(len(path.read_text().split()) for path in self.output.glob("*/calls.txt"))

    def test_target_is_reached(self):
        code, screen = self.calibrate("drag [N] = 4.25", "Model/Cells = 1 : 5",
                                      "--tolerance", "1e-6")
        self.assertEqual(code, 0, screen)
        last = self.table()[-1]
        self.assertAlmostEqual(float(last["Model/Cells"]), 2, delta=1e-5)
        self.assertEqual(last["status"], "reached")
        self.assertLess(len(self.table()), 14)
        self.assertTrue(screen.endswith(
            f"subsection Model\n  set Cells = {last['Model/Cells']}\nend\n"), screen)
        # The same again runs nothing, a tighter tolerance goes on from there.
        n_calls = self.n_calls()
        self.assertEqual(self.calibrate("drag = 4.25", "Model/Cells = 1 : 5",
                                        "--tolerance", "1e-6")[0], 0)
        self.assertEqual(self.n_calls(), n_calls)
        self.calibrate("drag = 4.25", "Model/Cells = 1 : 5", "--tolerance", "1e-9")
        self.assertLess(self.n_calls(), n_calls + 4)

    def test_target_beyond_the_ends(self):
        code, screen = self.calibrate("drag [N] = 9")
        self.assertEqual(code, 2)
        self.assertIn("drag [N] = 8 at Model/Cells = 1 and drag [N] = 3.2 at Model/Cells = 5",
                      screen)
        self.assertEqual(len(self.table()), 2)

    def test_end_that_diverges(self):
        code, screen = self.calibrate("drag = 4.25", "Model/Cells = 1 : 5", "--set",
                                      "Model/Most cells = 2.3")
        self.assertEqual(code, 0, screen)
        self.assertIn("the run at 5 failed (diverged)", screen)
        self.assertEqual(self.table()[1]["status"], "diverged")
        self.assertAlmostEqual(float(self.table()[-1]["drag [N]"]), 4.25, delta=4.25e-3)
        n_calls = self.n_calls()
        self.calibrate("drag = 4.25", "Model/Cells = 1 : 5", "--set", "Model/Most cells = 2.3")
        self.assertEqual(self.n_calls(), n_calls)

    def test_target_beyond_what_converges(self):
        code, screen = self.calibrate("drag = 4.25", "Model/Cells = 1 : 5", "--set",
                                      "Model/Most cells = 1.9")
        self.assertEqual(code, 2)
        self.assertIn("lies beyond what converges: drag [N] = 4.38", screen)
        self.assertNotIn("reached", [row["status"] for row in self.table()])

    def test_both_ends_diverge(self):
        code, screen = self.calibrate("drag = 4", "Model/Cells = 1 : 5", "--set",
                                      "Model/Most cells = 0")
        self.assertEqual(code, 2)
        self.assertIn("both ends", screen)

    def test_scene_that_is_refused(self):
        code, screen = self.calibrate("drag = 4", "Model/Cells = 1 : 5", "--set",
                                      "Model/Behaviour = bad input")
        self.assertEqual(code, 1)
        self.assertIn("refused at both ends", screen)

    def test_jump_and_other_solutions(self):
        code, screen = self.calibrate("jump [-] = 0")
        self.assertEqual(code, 2)
        self.assertIn("jumps over the target", screen)
        code, screen = self.calibrate("square = 2.1", "Model/Cells = 1 : 4.4")
        self.assertEqual(code, 0, screen)
        self.assertIn("not monotone", screen)

    def test_unknown_result(self):
        code, screen = self.calibrate("drags [N] = 4")
        self.assertEqual(code, 1)
        self.assertIn("'drag [N]'", screen)

    def test_limit_of_runs(self):
        code, screen = self.calibrate("drag = 4.25", "Model/Cells = 1 : 5", "--runs", "3")
        self.assertEqual(code, 2)
        self.assertIn("not reached in 3 runs; the nearest is drag [N] = ", screen)

    def test_units(self):
        self.assertEqual(calibrate.parse_range("A/B c = 3 : 1e-1 nA/(mm mV)"),
                         ("A/B c", 0.1, 3., "nA/(mm mV)"))
        self.assertEqual(calibrate.parse_range("A = 1mm : 2 mm"), ("A", 1., 2., "mm"))

    def test_bad_arguments(self):
        for target, vary in (("drag", "A/b = 1 : 2"), ("drag = x", "A/b = 1 : 2"),
                             ("drag = 1", "A/b = 1"), ("drag = 1", "A/b = 1 : 1"),
                             ("drag = 1", "A/b = 1 m : 2 mm"), ("drag = 1", "A/b = x : 2")):
            code, screen = self.calibrate(target, vary)
            self.assertEqual(code, 1)
            self.assertTrue(screen.startswith("calibrate: "), screen)
        self.assertFalse(self.output.exists())


if __name__ == "__main__":
    os.chmod(FAKE, 0o755)
    unittest.main()
