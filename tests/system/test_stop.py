#!/usr/bin/env python3
"""Orders to stop: checkpoint, exit code 3, and the run goes on later."""

import shutil
import signal
import subprocess
import time

import runs

# Far more steps than anyone waits for.
ENDLESS = runs.sets(Time__Number_of_steps=1000000, Time__End_time="1e4 s",
                    Output__Fields__Step_interval=0, Output__Checkpoints__Step_interval=0,
                    Rigid_body_sphere__Gravity="0 m/s^2")


class StopTest(runs.SystemTest):
    def start(self, *options, ranks=1):
        process = subprocess.Popen(
            runs.command(runs.SCENES / "sphere.prm", "--output", "run", *ENDLESS, *options,
                         ranks=ranks),
            cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        deadline = time.monotonic() + 30
        table = self.folder / "run/statistics.csv"
        while not table.exists() or table.read_text(encoding="utf-8").count("\n") < 3:
            self.assertLess(time.monotonic(), deadline, "the run does not begin")
            self.assertIsNone(process.poll())
            time.sleep(0.05)
        return process

    def check_stopped(self, process, reason, ranks=1):
        output, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 3, output + errors)
        log = (self.folder / "run/log.txt").read_text(encoding="utf-8")
        self.assertIn(f"Stopped early ({reason}", log)
        self.assertIn("continue with --resume run", log)
        last = int(self.table("run")["step [-]"][-1])
        self.assertTrue((self.folder / f"run/checkpoints/checkpoint_{last:09d}.h5").exists())
        self.run_program("--resume", "run", "--quiet",
                         *runs.sets(Time__Number_of_steps=last + 5), ranks=ranks)
        steps = self.table("run")["step [-]"]
        self.assertEqual(list(steps), list(range(last + 6)))

    def test_signals(self):
        for order in (signal.SIGTERM, signal.SIGUSR1, signal.SIGINT):
            with self.subTest(order.name):
                shutil.rmtree(self.folder / "run", ignore_errors=True)
                process = self.start()
                process.send_signal(order)
                self.check_stopped(process, f"signal {order.name} was received")

    def test_signal_of_a_job_on_two_ranks(self):
        process = self.start(ranks=2)
        process.send_signal(signal.SIGUSR1)
        output, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 3, output + errors)
        self.assertIn("Stopped early (signal SIGUSR1 was received)", output)
        self.run_program("--resume", "run", "--quiet", ranks=2,
                         *runs.sets(Time__Number_of_steps=int(
                             self.table("run")["step [-]"][-1]) + 5))

    def test_file_in_the_output_folder(self):
        process = self.start()
        (self.folder / "run/stop").touch()
        self.check_stopped(process, "the file \"run/stop\" was found")
        self.assertFalse((self.folder / "run/stop").exists())

    def test_wall_time(self):
        process = self.start(*runs.sets(Time__Wall_time_limit="2 s"))
        self.check_stopped(process, "the limit of wall time is near")

    def test_number_of_steps_and_end_time(self):
        self.run_scene("sphere.prm", "steps", *runs.sets(Time__Number_of_steps=7))
        self.assertEqual(self.table("steps")["step [-]"][-1], 7)
        self.run_scene("sphere.prm", "time", *runs.sets(Time__Number_of_steps=0,
                                                        Time__End_time="10.5 ms"))
        self.assertEqual(self.table("time")["time [s]"][-1], 0.0105)

    def test_results_are_those_of_the_end(self):
        for interval in (1, 5):
            self.run_scene("sphere.prm", f"every{interval}", *runs.sets(
                Time__Number_of_steps=7, Output__Statistics__Step_interval=interval))
        self.assertEqual(self.table("every5")["step [-]"][-1], 5)
        for name in ("sphere velocity y [m/s]", "kinetic energy [J]"):
            self.assertEqual(*(self.table(f"every{interval}", "result.csv")[name][0]
                               for interval in (1, 5)))


if __name__ == "__main__":
    runs.main()
