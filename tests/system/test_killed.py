#!/usr/bin/env python3
"""A run that is killed at any moment, or runs out of disk, resumes from its last
complete checkpoint and gives what one left alone gives."""

import resource
import signal
import subprocess
import time

import runs

STEPS = runs.sets(Time__Number_of_steps=40, Output__Checkpoints__Step_interval=5)


class KilledTest(runs.SystemTest):
    def start(self, *arguments, **options):
        process = subprocess.Popen(runs.command(*arguments, "--quiet"), cwd=self.folder,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, **options)
        self.addCleanup(process.kill)
        return process

    def kill_when(self, condition, *arguments):
        """Kills the program as soon as the condition holds."""
        process = self.start(*arguments)
        end = time.monotonic() + 100
        while not condition():
            self.assertIsNone(process.poll(), "the run ended before it was killed")
            self.assertLess(time.monotonic(), end)
        process.kill()
        process.communicate()
        self.assertEqual(process.returncode, -signal.SIGKILL)

    def rows(self):
        path = self.folder / "run/statistics.csv"
        return path.read_text(encoding="utf-8").count("\n") - 1 if path.exists() else 0

    def resume_and_compare(self, *options):
        self.run_program("--resume", "run", "--quiet", *options)
        for name in ("statistics.csv", "iterations.csv", "cycles.csv", "profiles/activation.csv",
                     "body.pvd", "flow.pvd"):
            ours, whole = (self.folder / run / name for run in ("run", "whole"))
            self.assertEqual(ours.read_text(encoding="utf-8"),
                             whole.read_text(encoding="utf-8"), name)
        self.assertEqual(list((self.folder / "run/checkpoints").glob("*.tmp")), [])

    def test_swimmer(self):
        scene = runs.SCENES / "swim.prm"
        self.run_scene("swim.prm", "whole", *STEPS)
        for step in (8, 21, 34):  # some steps after a checkpoint
            first = step == 8
            self.kill_when(lambda s=step: self.rows() > s,
                           *((scene, "--output", "run", *STEPS) if first else ("--resume", "run")))
        self.resume_and_compare()

        # While a checkpoint is being written.
        temporary = self.folder / "run/checkpoints"
        for _ in range(20):
            self.kill_when(lambda: any(temporary.glob("*15.h5.tmp")),
                           scene, "--output", "run", "--overwrite", *STEPS)
            if any(temporary.glob("*.tmp")):
                break
        self.assertTrue(any(temporary.glob("*.tmp")), "no checkpoint was caught half written")
        self.resume_and_compare()

    def test_full_disk(self):
        self.run_scene("swim.prm", "whole", *STEPS)
        self.run_scene("swim.prm", "run", *STEPS, *runs.sets(Time__Number_of_steps=13))
        # The end of a run is a checkpoint, too; one in the middle is wanted.
        checkpoints = self.folder / "run/checkpoints"
        (checkpoints / "checkpoint_000000013.h5").unlink()
        more = ("--resume", "run", *runs.sets(Time__Number_of_steps=40))
        checkpoint = max(file.stat().st_size for file in checkpoints.iterdir())
        table = (self.folder / "run/statistics.csv").stat().st_size
        for size, what in ((checkpoint // 2, "Checkpoint"), (table, "statistics.csv")):
            message = self.run_on_full_disk(size, *more)
            for part in (what, "space"):
                self.assertIn(part, message)
            self.assertEqual(message.count("\n"), 1, message)
            for bad in ("terminate called", "Internal error", "HDF5-DIAG", "Segmentation"):
                self.assertNotIn(bad, message)
        self.resume_and_compare(*more[2:])

    def run_on_full_disk(self, size, *arguments):
        """From the first step on no file grows beyond that size; writing more is
        an error, as on a full disk (Python leaves the signal ignored)."""
        log = self.folder / "run/log.txt"
        before = log.read_text(encoding="utf-8").count("Resumed")
        process = self.start(*arguments, restore_signals=False)
        while log.read_text(encoding="utf-8").count("Resumed") == before:
            self.assertIsNone(process.poll(), "the run ended before the disk was full")
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (size, size))
        _, message = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 1, message)
        return message


if __name__ == "__main__":
    runs.main()
