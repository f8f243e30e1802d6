"""The sweep: runs, resuming, the table, and observed orders."""

import contextlib
import csv
import io
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))
import sweep

FAKE = pathlib.Path(__file__).with_name("fake_binary.py")


class Runs(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.scene = self.folder / "scene.prm"
        self.scene.write_text("# scene\n")
        self.output = self.folder / "out"

    def command(self, *options):
        return [str(self.scene), "--binary", str(FAKE), "--output", str(self.output),
                *options]

    def run_sweep(self, *options):
        screen = io.StringIO()
        with contextlib.redirect_stdout(screen), contextlib.redirect_stderr(screen):
            code = sweep.main(self.command(*options))
        return code, screen.getvalue()

    def table(self, name="table.csv"):
        with open(self.output / name, newline="") as file:
            return list(csv.DictReader(file))

    def calls(self):
        return {path.parent.name: path.read_text().split()
                for path in self.output.glob("*/calls.txt")}

    def test_table_and_orders(self):
        code, screen = self.run_sweep(
            "--refine", "Model/Cells = 1, 2, 4", "--vary", "Model/Other = x, y",
            "--set", "Model/Fixed = 1", "-j", "3")
        self.assertEqual(code, 0, screen)
        table = self.table()
        self.assertEqual(len(table), 6)
        self.assertEqual(list(table[0])[:3], ["Model/Other", "Model/Cells", "drag [N]"])
        self.assertEqual(table[-1]["Model/Cells"], "4")
        self.assertEqual(float(table[-1]["drag [N]"]), 3 + 5 / 16)
        orders = {(row["case"], row["column"]): row for row in self.table("orders.csv")}
        drag = orders["Model/Other = y", "drag [N]"]
        self.assertEqual((drag["kind"], drag["order 1"]), ("three grids", "2.00"))
        self.assertAlmostEqual(float(drag["limit"]), 3)
        error = orders["Model/Other = x", "error of speed [m/s]"]
        self.assertEqual((error["order 1"], error["order 2"]), ("3.00", "3.00"))
        self.assertEqual(orders["Model/Other = x", "constant [1]"]["order 1"], "-")

    def test_reference(self):
        _, screen = self.run_sweep("--refine", "Model/Cells = 1, 2",
                                   "--reference", "drag [N] = 2")
        # Errors against 2 are 6 and 2.25.
        self.assertIn(f"order (reference) {math.log(6 / 2.25) / math.log(2):.2f}", screen)
        self.assertEqual([float(row["relative error of drag [-]"]) for row in self.table()],
                         [3, 1.125])

    def test_study_file(self):
        study = self.folder / "some.study"
        study.write_text("""scene scene.prm
            reference drag [N] = last of fine
            column drag
            series coarse
            refine Model/Cells = 1, 2
            series fine
            refine Model/Cells = 2, 4
            """)
        arguments = self.command()
        arguments[0] = str(study)
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(sweep.main(arguments), 0)
            study.write_text(study.read_text().replace("2, 4", "2, 4, 8"))
            self.assertEqual(sweep.main(arguments), 0)
        table = self.table()
        self.assertEqual(list(table[0]), [
            "series", "Model/Cells", "drag [N]", "relative error of drag [-]", "steps [-]",
            "wall time [s]", "cpu time [s]", "exit code"])
        self.assertEqual([(row["series"], row["Model/Cells"]) for row in table],
                         [("coarse", "1"), ("coarse", "2"), ("fine", "2"), ("fine", "4"),
                          ("fine", "8")])
        exact = 3 + 5 / 64
        for row in table:
            self.assertAlmostEqual(float(row["relative error of drag [-]"]),
                                   float(row["drag [N]"]) / exact - 1)
        self.assertEqual(self.calls(), {f"Cells={n}": ["started"] for n in (1, 2, 4, 8)})
        self.assertEqual([row["case"] for row in self.table("orders.csv")], ["coarse", "fine"])

    def test_report_of_some_columns(self):
        self.run_sweep("--refine", "Model/Cells = 1, 2, 4", "--column", "drag")
        self.assertEqual([row["column"] for row in self.table("orders.csv")], ["drag [N]"])

    def test_finished_cases_are_not_run_again(self):
        self.run_sweep("--vary", "Model/Cells = 1, 2")
        code, screen = self.run_sweep("--vary", "Model/Cells = 1, 2, 4")
        self.assertEqual(code, 0)
        self.assertIn("2 already finished", screen)
        self.assertEqual(self.calls(), {f"Cells={n}": ["started"] for n in (1, 2, 4)})
        self.run_sweep("--vary", "Model/Cells = 1", "--overwrite")
        self.assertEqual(self.calls()["Cells=1"], ["started", "started"])

    def test_failed_cases_show_in_the_table(self):
        code, screen = self.run_sweep("--vary", "Model/Behaviour = good, diverges")
        self.assertEqual(code, 2)
        self.assertIn("The step did not converge.", screen)
        self.assertEqual([row["exit code"] for row in self.table()], ["0", "2"])
        self.assertEqual(self.table()[1]["drag [N]"], "")
        code, _ = self.run_sweep("--vary", "Model/Behaviour = good, bad input")
        self.assertEqual(code, 1)

    def test_stopped_cases_are_resumed(self):
        command = [sys.executable, "-B", str(ROOT / "postprocess/sweep.py"),
                   *self.command("--vary", "Model/Behaviour = slow, good")]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        ready = self.output / "Behaviour=slow" / "ready"
        deadline = time.monotonic() + 30
        while not ready.exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        time.sleep(0.1)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(30), 3)
        code, _ = self.run_sweep("--vary", "Model/Behaviour = slow, good")
        self.assertEqual(code, 0)
        self.assertEqual(self.calls()["Behaviour=slow"], ["started", "resumed"])
        self.assertEqual([(row["wall time [s]"], row["cpu time [s]"]) for row in self.table()],
                         [("3.5", "5.5"), ("2.0", "3.0")])

    def test_another_scene_is_refused(self):
        self.run_sweep("--vary", "Model/Cells = 1")
        self.scene.write_text("# another\n")
        code, screen = self.run_sweep("--vary", "Model/Cells = 1")
        self.assertEqual(code, 1)
        self.assertIn("--overwrite", screen)
        self.assertEqual(self.run_sweep("--vary", "Model/Cells = 1", "--overwrite")[0], 0)

    def test_a_scene_that_failed_may_be_corrected(self):
        self.run_sweep("--vary", "Model/Behaviour = bad input")
        self.scene.write_text("# corrected\n")
        self.assertEqual(self.run_sweep("--vary", "Model/Behaviour = good")[0], 0)

    def test_bad_arguments(self):
        for options in ((), ("--vary", "Model/Cells"), ("--refine", "Model/Cells = 1, 1"),
                        ("--vary", "A/b = 1", "--reference", "drag")):
            code, screen = self.run_sweep(*options)
            self.assertEqual(code, 1)
            self.assertTrue(screen.startswith("sweep: "), screen)
        self.assertFalse(self.output.exists())


if __name__ == "__main__":
    os.chmod(FAKE, 0o755)
    unittest.main()
