"""The diagram of a sweep's table."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))
try:
    import plot_table
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)  # CTest: skipped

TABLE = """series,A/x,relative error of force [-],error of defect [m],cpu time [s],exit code
scheme: rk3,1,-0.1,3,1,0
scheme: rk3,2,0.02,2,8,0
scheme: rk3,4,0.0,1,64,0
scheme: ab2,1,,,2,2
"size: 30, no wall",1,0.3,1,5,0
"""


class PlotTable(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.table = pathlib.Path(holder.name) / "table.csv"
        self.table.write_text(TABLE)

    def plot(self, *options):
        screen = io.StringIO()
        with contextlib.redirect_stdout(screen), contextlib.redirect_stderr(screen):
            code = plot_table.main([str(self.table), *options])
        return code, screen.getvalue()

    def test_curves(self):
        rows = plot_table.read_table(self.table)
        self.assertEqual(
            plot_table.curves(rows, "cpu time [s]", "relative error of force [-]"),
            {"scheme": {"rk3": [(1, -0.1), (8, 0.02)], "ab2": []},
             "size": {"30, no wall": [(5, 0.3)]}})

    def test_picture(self):
        code, screen = self.plot()
        self.assertEqual(code, 0, screen)
        picture = self.table.with_suffix(".png")
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")
        self.assertIn(str(picture), screen)

    def test_family(self):
        rows = [{"a": a, "b": b, "c": c} for a, b, c in (("2", "0.1", "5"), ("1", "0.1", "4"),
                                                         ("2", "0.1", "5"), ("1", "0.3", ""),
                                                         ("3", "0.3", "-7"))]
        self.assertEqual(plot_table.family(rows, "a", "c", "b"),
                         {"0.1": [(1, 4), (2, 5)], "0.3": [(3, -7)]})
        code, screen = self.plot("--x", "A/x", "--by", "series", "--y", "force", "--y", "defect")
        self.assertEqual(code, 0, screen)
        code, screen = self.plot("--by", "nonsense", "--y", "force")
        self.assertEqual(code, 1)
        self.assertIn("no column for --by holds 'nonsense'", screen)

    def test_map(self):
        self.table.write_text("series,A/x,A/y,A/dt,exit code\n"
                              "one,1,2,0.1,0\none,1,2,0.5,2\ntwo,10,2,0.1,2\n")
        rows = plot_table.read_table(self.table)
        self.assertEqual(plot_table.outcomes(rows, "A/x", "A/y", "A/dt"),
                         ({"one": [(1, 2, 0, True), (1, 2, 1, False)],
                           "two": [(10, 2, 0, False)]}, ["0.1", "0.5"]))
        self.assertEqual(plot_table.bound("a = 2/x", [1, 4]), ("a", [2, 0.5]))
        options = ("--map", "--x", "A/x", "--y", "A/y")
        code, screen = self.plot(*options, "--by", "A/dt", "--line", "bound = 3/x")
        self.assertEqual(code, 0, screen)
        self.assertEqual(self.table.with_suffix(".png").read_bytes()[:4], b"\x89PNG")
        for wrong, message in (((), "one for --by"),
                               (("--by", "A/dt", "--line", "bound"), "is not of the form"),
                               (("--by", "A/dt", "--line", "b = y"), "name 'y' is not defined")):
            code, screen = self.plot(*options, *wrong)
            self.assertEqual(code, 1)
            self.assertIn(message, screen)

    def test_lines_hold_the_points(self):
        figure, axis = plot_table.plt.subplots()
        self.addCleanup(plot_table.plt.close, figure)
        plot_table.draw(axis, {"a": [(1, -0.1), (8, 0.02)]})
        curve, full, open_, _ = axis.get_lines()
        self.assertEqual(curve.get_xydata().tolist(), [[1, 0.1], [8, 0.02]])
        self.assertEqual(full.get_xydata().tolist(), [[8, 0.02]])
        self.assertEqual(open_.get_xydata().tolist(), [[1, 0.1]])
        self.assertEqual((axis.get_xscale(), axis.get_yscale()), ("log", "log"))

    def test_columns_by_part_of_their_name(self):
        rows = plot_table.read_table(self.table)
        self.assertEqual(plot_table.find_columns(rows, ["error of"], "--y"),
                         ["relative error of force [-]", "error of defect [m]"])
        self.assertEqual(plot_table.find_columns(rows, ["error of defect [m]"], "--y"),
                         ["error of defect [m]"])

    def test_errors(self):
        code, screen = self.plot("--y", "speed")
        self.assertEqual(code, 1)
        self.assertTrue(screen.startswith("plot: no column for --y holds 'speed'"), screen)
        self.table.write_text("a\n")
        self.assertEqual(self.plot()[0], 1)
        self.table.unlink()
        self.assertIn("does not exist", self.plot()[1])


if __name__ == "__main__":
    unittest.main()
