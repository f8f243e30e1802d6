"""What a sweep runs: lists of values, series, study files; and their references."""

import argparse
import math
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))
import convergence
import study
import sweep_report


class Convergence(unittest.TestCase):
    def test_three_grids(self):
        for h, p in (([4, 2, 1], 2.0), ([1, 0.5, 0.25], 1.0), ([1, 0.6, 0.4], 3.5)):
            order, limit = convergence.three_grid_order(h, [7 - 0.3 * s**p for s in h])
            self.assertAlmostEqual(order, p, places=8)
            self.assertAlmostEqual(limit, 7, places=8)

    def test_no_order_where_there_is_none(self):
        self.assertEqual(convergence.three_grid_order([4, 2, 1], [1, 3, 2]), (None, None))
        self.assertEqual(convergence.three_grid_order([4, 2, 1], [1, 1, 1]), (None, None))
        self.assertEqual(convergence.order_of_errors([2, 1], [0.1, 0]), [None])

    def test_mesh_sizes(self):
        self.assertEqual(convergence.mesh_sizes(["2", "4"]), [0.5, 0.25])
        self.assertEqual(convergence.mesh_sizes(["2 ms", "1 ms"]), [2, 1])
        for values in (["1 ms", "1 s"], ["1", "3", "2"], ["1", "1"]):
            with self.assertRaises(ValueError):
                convergence.mesh_sizes(values)


class Studies(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        (self.folder / "scene.prm").write_text("# scene\n")

    def make(self, **options):
        values = {"file": str(self.folder / "scene.prm"), "set": [], "vary": [], "refine": [],
                  "reference": [], "column": [], "series": []}
        return study.make_study(argparse.Namespace(**{**values, **options}))

    def read(self, text, **options):
        file = self.folder / "some.study"
        file.write_text(text)
        return self.make(file=str(file), **options)

    def test_product_and_together(self):
        cases = list(self.make(vary=["A/x = 1, 2", "B/y = a|b, c; B/z = 3|4"]).cases.values())
        self.assertEqual(len(cases), 4)
        self.assertEqual(cases[1], {"A/x": "1", "B/y": "b, c", "B/z": "4"})

    def test_names_are_distinct(self):
        self.assertEqual(len(self.make(vary=["A/x = 1 mm, 2 mm", "B/x = 1 mm, 2 mm"]).cases), 4)

    def test_bad_lists(self):
        for text in ("A/x", "A/x = ", "A/x = 1, 2; B/y = 1", "A/x = 1; A/x = 2", "A/x = 1, 1"):
            with self.assertRaises(study.UsageError):
                self.make(vary=[text])
        with self.assertRaises(study.UsageError):
            self.make(vary=["A/x = 1", "A/x = 2"])

    def test_series_share_cases(self):
        one = self.read("""# A comment.
            scene scene.prm
            set   Time/End time = 2    # for all
            series scheme: rk3
            vary  A/x = 1, 2
            series scheme: ab2
            set   B/scheme = ab2, ab3
            vary  A/x = 1, 2
            series size: 2
            vary  A/x = 2
            """)
        self.assertEqual(one.settings, ["Time/End time = 2"])
        self.assertEqual(list(one.cases.values()),
                         [{"A/x": "1"}, {"A/x": "2"}, {"B/scheme": "ab2, ab3", "A/x": "1"},
                          {"B/scheme": "ab2, ab3", "A/x": "2"}])
        names = list(one.cases)
        self.assertEqual([(series.name, name) for series, name in one.rows],
                         [("scheme: rk3", names[0]), ("scheme: rk3", names[1]),
                          ("scheme: ab2", names[2]), ("scheme: ab2", names[3]),
                          ("size: 2", names[1])])

    def test_arguments_add_to_the_file(self):
        text = "scene scene.prm\nseries one\nvary A/x = 1, 2\nseries two\nvary A/x = 3\n"
        one = self.read(text, vary=["B/y = 5, 6"], set=["C/z = 7"], series=["on"])
        self.assertEqual(len(one.cases), 4)
        self.assertEqual(one.settings, ["C/z = 7"])
        self.assertEqual(next(iter(one.cases.values())), {"B/y": "5", "A/x": "1"})

    def test_bad_files(self):
        for text, part in (("vary A/x = 1\n", "name one scene"),
                           ("scene other.prm\nseries s\nvary A/x = 1\n", "does not exist"),
                           ("scene scene.prm\nvarry A/x = 1\n", "some.study:2"),
                           ("scene scene.prm\nset\n", "some.study:2"),
                           ("scene scene.prm\nseries s\nscene scene.prm\n", "first series"),
                           ("scene scene.prm\n", "nothing to vary"),
                           ("scene scene.prm\nreference a = last of b\nseries s\nvary A/x = 1\n",
                            "names no series"),
                           ("scene scene.prm\nreference a\nseries s\nvary A/x = 1\n",
                            "not of the form")):
            with self.assertRaises(study.UsageError) as caught:
                self.read(text)
            self.assertIn(part, str(caught.exception))

    def test_errors_against_references(self):
        one = self.read("""scene scene.prm
            reference force [N] = 4
            reference defect [m] = 0
            reference speed [m/s] = last of one
            series one
            vary A/x = 1, 2
            series two
            reference force [N] = 2
            vary A/x = 3
            """)
        results = {name: {"force [N]": text, "defect [m]": text, "speed [m/s]": text,
                          "cpu time [s]": "9"} for name, text in zip(one.cases, "321")}
        one.resolve_references(results)
        rows = sweep_report.table_rows(one, results, {"x=1": {"exit code": 0}})
        self.assertEqual([row["series"] for row in rows], ["one", "one", "two"])
        self.assertEqual([float(row["relative error of force [-]"]) for row in rows],
                         [-0.25, -0.5, -0.5])
        self.assertEqual([float(row["error of defect [m]"]) for row in rows], [3, 2, 1])
        self.assertEqual([float(row["relative error of speed [-]"]) for row in rows],
                         [0.5, 0, -0.5])
        self.assertEqual([row["cpu time [s]"] for row in rows], ["9"] * 3)
        self.assertEqual([row["exit code"] for row in rows], [0, "", ""])

    def test_errors_of_cases_without_result(self):
        one = self.read("scene scene.prm\nreference force [N] = last of one\n"
                        "series one\nvary A/x = 1, 2\n")
        one.resolve_references({"x=1": {"force [N]": "3"}})
        rows = sweep_report.table_rows(one, {"x=1": {"force [N]": "3"}}, {})
        self.assertEqual([row["force [N]"] for row in rows], ["3", ""])
        self.assertNotIn("relative error of force [-]", rows[0])


class ShippedStudies(unittest.TestCase):
    def test_they_can_be_read(self):
        files = sorted((ROOT / "parameters" / "studies").glob("*.study"))
        self.assertTrue(files)
        for file in files:
            one = study.make_study(argparse.Namespace(
                file=str(file), set=[], vary=[], refine=[], reference=[], column=[], series=[]))
            self.assertGreater(len(one.cases), 3, file)
            # A map has no references; a study of errors has them in every series.
            measures_errors = any(series.references for series in one.series)
            for series in one.series:
                self.assertEqual(bool(series.references), measures_errors,
                                 f"{file}: {series.name}")
                for target in series.references.values():
                    self.assertTrue(isinstance(target, str) or math.isfinite(target))


if __name__ == "__main__":
    unittest.main()
