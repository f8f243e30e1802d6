#!/usr/bin/env python3
"""A run agrees with its restart from a checkpoint in its middle, on the same and
on another number of ranks, and its files have no doubled or missing rows."""

import re
import shutil

import runs

SAME_RANKS = 1e-10
OTHER_RANKS = 1e-8


class RestartTest(runs.SystemTest):
    def times(self, run, series):
        text = (self.folder / run / f"{series}.pvd").read_text(encoding="utf-8")
        for file in re.findall('file="([^"]+)"', text):
            self.assertTrue((self.folder / run / file).exists(), file)
        return [float(time) for time in re.findall('timestep="([^"]+)"', text)]

    def check(self, scene, *options, series):
        """Checkpoints are written at steps 25 and 50; the first run ends at 32,
        so that rows of 26 ... 32 have to be taken back."""
        self.run_scene(scene, "whole", *options)
        for run, ranks in (("part", 1), ("two", 2)):
            self.run_scene(scene, run, *options, *runs.sets(Time__Number_of_steps=32),
                           ranks=ranks)
            # The end of a run is a checkpoint, too; that in the middle is wanted.
            (self.folder / run / "checkpoints/checkpoint_000000032.h5").unlink()
        shutil.copytree(self.folder / "part", self.folder / "others")
        for run, ranks, tolerance in (("part", 1, SAME_RANKS), ("others", 2, OTHER_RANKS),
                                      ("two", 1, OTHER_RANKS)):
            self.run_program("--resume", run, "--quiet", *runs.sets(Time__Number_of_steps=50),
                             ranks=ranks)
            self.assertIn("step 25", (self.folder / run / "log.txt").read_text(encoding="utf-8"))
            self.assert_same(run, "whole", tolerance)
            for name in series:
                self.assertEqual(self.times(run, name), self.times("whole", name))
            result, whole = self.table(run, "result.csv"), self.table("whole", "result.csv")
            self.assertEqual(result.names, whole.names)
            for name in result.names:
                if name.startswith(("mean", "largest centre")) and not runs.tells_effort(name):
                    self.assertLessEqual(abs(result[name][0] - whole[name][0]),
                                         1e-7 * abs(whole[name][0]), name)

    def test_swim_with_forcing_as_load(self):
        self.check("swim.prm", series=("flow", "body", "dye"))
        for name in ("cycles", *(f"profiles/{name}" for name in
                                 ("potential", "activation", "radial_displacement"))):
            part, whole = (self.table(run, f"{name}.csv") for run in ("part", "whole"))
            self.assertEqual(part.names, whole.names)
            runs.numpy.testing.assert_array_equal(part.values, whole.values, name)
        self.assertEqual(self.table("whole", "cycles.csv")["cycle [-]"].tolist(), [1, 2, 3])

    def test_no_row_is_newer_than_the_run(self):
        """The run that is taken back wrote rows of cycles and profiles at step 30; the
        one that goes on ends before their next."""
        self.run_scene("swim.prm", "run", *runs.sets(Time__Number_of_steps=32))
        (self.folder / "run/checkpoints/checkpoint_000000032.h5").unlink()
        rows = {path: self.table("run", path.relative_to(self.folder / "run")).values.shape[0]
                for path in (self.folder / "run").glob("**/*.csv") if path.name != "timing.csv"}
        self.run_program("--resume", "run", "--quiet", *runs.sets(Time__Number_of_steps=28))
        taken_back = {"statistics.csv": 4, "iterations.csv": 4, "cycles.csv": 1,
                      "activation.csv": 1, "potential.csv": 1}
        for path, before in rows.items():
            table = self.table("run", path.relative_to(self.folder / "run"))
            if table.names[0] == "time [s]":
                self.assertLessEqual(table["time [s]"].max(), 0.056 + 1e-9, path)
            if path.name in taken_back:
                self.assertEqual(before - table.values.shape[0], taken_back[path.name], path)

    def test_swim_with_fixed_point(self):
        self.check("swim.prm", *runs.sets(Coupling__Scheme="fixed point"),
                   series=("flow", "body", "dye"))

    def test_swim_with_markers_placed_anew(self):
        """Before, after and at the steps that are taken back."""
        self.check("swim.prm",
                   *runs.sets(Scene__Physics="elasticity, flow", Scene__Muscle="prescribed",
                              Prescribed_activation__Time_course="min(1, t/0.1)",
                              Elasticity__Active_strain__Form="unit directors",
                              Elasticity__Active_strain__Coronal_amplitude=0.8,
                              Immersed_boundary__Marker_spacing=0.585,
                              Immersed_boundary__Largest_marker_spacing=0.6),
                   series=("flow", "body"))
        log = (self.folder / "whole/log.txt").read_text(encoding="utf-8")
        self.assertGreater(log.count("are placed anew"), 5)
        self.assertLess(self.table("whole")["largest marker spacing [cells]"].max(), 0.6)

    def test_swim_with_added_mass(self):
        # At the default tolerance round-off grows from step to step
        # (docs/verification/coupling.md).
        self.check("swim.prm", *runs.sets(Coupling__Scheme="added mass", Coupling__Tolerance=1e-3,
                                          Fluid__Time_scheme="rk3"),
                   series=("flow", "body", "dye"))

    def test_sinking_sphere(self):
        self.check("sphere.prm", series=("flow", "dye"))

    def test_sphere_in_a_moving_window(self):
        self.check("window.prm", series=("flow",))
        for name in ("probes/passed.csv", "profiles/along_pressure.csv"):
            part, whole = (self.table(run, name) for run in ("part", "whole"))
            self.assertEqual(part.names, whole.names)
            self.assertEqual(part.values.shape, whole.values.shape)
            self.assertLess(abs(part.values - whole.values).max(),
                            SAME_RANKS * abs(whole.values).max())
        # The probe is left behind, the line stays inside.
        shift = self.table("whole")["window shift [cells]"]
        inside = 96 + 1.5 * shift >= 90
        self.assertEqual(self.table("whole", "probes/passed.csv").values.shape[0], sum(inside))
        self.assertLess(sum(inside), 50)
        self.assertEqual(self.table("whole", "profiles/along_pressure.csv").values.shape, (6, 9))
        self.assertNotIn("passed pressure [Pa]", self.table("whole", "result.csv").names)

    def test_swim_in_a_moving_window(self):
        self.check("swim.prm", *runs.WINDOW_OF_SWIMMER, series=("flow", "body"))
        shift = self.table("whole")["window shift [cells]"]
        self.assertNotEqual(shift[25], 0)
        self.assertNotEqual(shift[-1], shift[25])

    def test_swim_with_a_distributed_body(self):
        self.check("swim.prm", *runs.sets(Scene__Distributed_body_from=0), series=("body",))

    def test_body_in_vacuum(self):
        self.check("swim.prm", *runs.sets(Scene__Physics="electrophysiology, elasticity"),
                   series=("body",))

    def test_tissue_alone(self):
        self.check("swim.prm", *runs.sets(Scene__Physics="electrophysiology",
                                          Scene__Muscle="none"), series=())
        self.assertGreater(self.table("whole")["largest potential [V]"].max(), 0.02)

    def test_a_finished_run_has_nothing_left(self):
        self.run_scene("sphere.prm", "run")
        before = self.files("run")
        self.run_program("--resume", "run", "--quiet")
        after = self.files("run")
        for path in ("statistics.csv", "flow.pvd", "parameters.prm"):
            self.assertEqual(before[self.folder / "run" / path], after[self.folder / "run" / path])
        names = self.table("run", "result.csv").names
        self.assertEqual(names[names.index("step [-]"):][:7],
                         ["step [-]", "smallest step [-]", "largest step [-]", "mean step [-]",
                          "sphere y [m]", "smallest sphere y [m]", "largest sphere y [m]"])

    def test_the_resolved_file_reproduces_the_run(self):
        self.run_scene("swim.prm", "first", *runs.sets(Time__Number_of_steps=20))
        shutil.copy(self.folder / "first/parameters.prm", self.folder / "again.prm")
        self.run_program("again.prm", "--output", "second", "--quiet")
        first, second = self.files("first"), self.files("second")
        for name in ("statistics.csv", "iterations.csv", "parameters.prm",
                     "profiles/potential.csv", "body/body_000002.vtu"):
            self.assertEqual(first[self.folder / "first" / name],
                             second[self.folder / "second" / name], name)


if __name__ == "__main__":
    runs.main()
