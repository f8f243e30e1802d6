"""A run agrees with its restart, and with itself on other numbers of ranks."""

import os
import signal
import subprocess
import time
import unittest

from program import SCENES, ProgramTest, command, largest_difference, read_rows

SAME_RANKS = 1e-10
OTHER_RANKS = 1e-8
# What depends on how a step was solved, not on what it gave.
EFFORT = ("Newton iterations", "coupling iterations", "interface residual", "projections",
          "iterations", "residual")


class Restart(ProgramTest):
    def statistics(self, run):
        rows = read_rows(self.folder / run / "statistics.csv")
        return [{name: value for name, value in row.items() if not name.startswith(EFFORT)}
                for row in rows]

    def assert_agree(self, a, b, tolerance):
        difference, column = largest_difference(self.statistics(a), self.statistics(b))
        self.assertLessEqual(difference, tolerance, f"{column} of {a} and {b}")

    def check_restart(self, scene, half):
        """Whole runs on 1 and 2 ranks, and halves on 1 + 1, 2 + 2, 1 + 2, 2 + 1."""
        for ranks in (1, 2):
            self.succeed(scene, "--output", f"whole{ranks}", ranks=ranks)
        for first, second in ((1, 1), (2, 2), (1, 2), (2, 1)):
            name = f"halves{first}{second}"
            self.succeed(scene, "--output", name, "--set", f"Time/Number of steps = {half}",
                         ranks=first)
            self.assertEqual(len(self.statistics(name)), half + 1)
            self.succeed("--resume", name, "--set", "Time/Number of steps = 0", ranks=second)
            if first == second:
                self.assert_agree(f"whole{first}", name, SAME_RANKS)
            else:
                self.assert_agree("whole1", name, OTHER_RANKS)

    def check_ranks(self, scene, all_ranks=(2, 3)):
        self.succeed(scene, "--output", "ranks1")
        for ranks in all_ranks:
            self.succeed(scene, "--output", f"ranks{ranks}", ranks=ranks)
            self.assert_agree("ranks1", f"ranks{ranks}", OTHER_RANKS)

    def test_sphere_restart(self):
        self.check_restart(SCENES / "small_sphere.prm", 10)

    def test_sphere_ranks(self):
        self.check_ranks(SCENES / "small_sphere.prm")

    def test_swim_restart(self):
        self.check_restart(SCENES / "small_swim.prm", 10)

    def test_swim_ranks(self):
        self.check_ranks(SCENES / "small_swim.prm")

    def test_series_are_continued(self):
        scene = SCENES / "small_flow.prm"
        self.succeed(scene, "--output", "whole")
        self.succeed(scene, "--output", "halves", "--set", "Time/Number of steps = 30")
        self.succeed("--resume", "halves", "--set", "Time/Number of steps = 0")
        for name in ("flow.pvd", "statistics.csv"):
            self.assertEqual((self.folder / "whole" / name).read_text(),
                             (self.folder / "halves" / name).read_text())

    def interrupt(self, name, ranks, stop):
        """A long run, stopped by a function of its process and folder."""
        folder = self.folder / name
        process = subprocess.Popen(
            command(ranks, SCENES / "small_flow.prm", "--output", folder,
                    "--set", "Time/End time = 1e5 s"),
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        table = folder / "statistics.csv"
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            if table.exists() and table.read_bytes().count(b"\n") > 5:
                break
            time.sleep(0.02)
        stop(process, folder)
        _, errors = process.communicate(timeout=60)
        self.assertEqual((process.returncode, errors), (3, ""))
        n_rows = len(self.statistics(name))
        self.succeed("--resume", name, "--set", f"Time/Number of steps = {n_rows + 2}")
        self.assertEqual(len(self.statistics(name)), n_rows + 3)

    def test_stopped_runs_are_resumable(self):
        self.interrupt("term", 1, lambda process, folder: process.send_signal(signal.SIGTERM))
        self.interrupt("usr1", 2, lambda process, folder: process.send_signal(signal.SIGUSR1))
        self.interrupt("file", 2, lambda process, folder: (folder / "stop").touch())

    def test_wall_time_limit(self):
        code, _ = self.run_program(SCENES / "small_flow.prm", "--output", "run", "--set",
                                   "Time/End time = 1e5 s", "--set", "Time/Wall time limit = 1 s")
        self.assertEqual(code, 3)
        self.assertTrue(os.listdir(self.folder / "run" / "checkpoints"))


if __name__ == "__main__":
    unittest.main()
