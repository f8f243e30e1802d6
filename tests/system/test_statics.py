#!/usr/bin/env python3
"""The load steps of a static scene are steps of the run: rows of all tables,
checkpoints, and an end with the last level that converged."""

import runs


class StaticsTest(runs.SystemTest):
    def test_rows_of_load_levels(self):
        self.run_scene("statics.prm", "run")
        time = self.table("run")["time [s]"]
        self.assertEqual(list(time), [0.25 * k for k in range(9)])
        probe = self.table("run", "probes/tip.csv")
        self.assertEqual(probe.names, ["time [s]", "r [m]", "y [m]", "Cauchy stress rr [Pa]",
                                       "Cauchy stress yy [Pa]", "Cauchy stress hoop [Pa]",
                                       "Cauchy stress ry [Pa]", "J [-]"])
        self.assertEqual(list(probe["time [s]"]), list(time))
        line = self.table("run", "profiles/outside_radial_displacement.csv")
        self.assertEqual(line.names, ["time [s]", "0", "0.25", "0.5", "0.75", "1"])
        self.assertEqual(list(line["time [s]"]), [0.5 * k for k in range(5)])
        # The line ends at the probe, and its hoop stretch is r / 0.8 m.
        self.assertEqual(list(0.8 + line["1"]), list(probe["r [m]"][::2]))
        hoop = self.table("run", "profiles/outside_stretch_hoop.csv")
        for name in line.names[1:]:
            self.assertLess(abs(hoop[name] - 1 - line[name] / 0.8).max(), 1e-14)
        # Something happens: the free end contracts step by step.
        self.assertTrue((line["1"][1:] < line["1"][:-1]).all())
        self.assertLess(line["1"][-1], -0.03)

    def test_restart(self):
        self.run_scene("statics.prm", "whole")
        self.run_scene("statics.prm", "part")
        (self.folder / "part/checkpoints/checkpoint_000000008.h5").unlink()
        self.run_program("--resume", "part", "--quiet")
        self.assertIn("step 4", (self.folder / "part/log.txt").read_text(encoding="utf-8"))
        self.assert_same("part", "whole", 1e-12)

    def test_load_without_equilibrium(self):
        process = self.run_scene(
            "statics.prm", "run", "--set", "Elasticity/Side theta2_0/Pressure = 3 kPa",
            *runs.sets(Elasticity__Statics__Smallest_load_step="1e-2"), code=2)
        result, time = self.table("run", "result.csv"), self.table("run")["time [s]"]
        level = result["load level [-]"][0]
        self.assertGreater(level, 0)
        self.assertLess(level, 1)
        self.assertEqual(2 * level, time[-1])
        self.assertEqual(process.stderr.count("no equilibrium at"), 1)
        for part in ("Smallest load step (0.02 s)", "Newton's method", "lower the load",
                     f"the last level that converged is {100 * level:.6g} %"):
            self.assertIn(part, process.stderr)


if __name__ == "__main__":
    runs.main()
