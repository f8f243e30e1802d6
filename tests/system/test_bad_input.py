#!/usr/bin/env python3
"""Bad input: one clean message with the remedy, from one rank, the exit code,
and nothing overwritten; on one and on two ranks."""

import runs

FLOW = runs.SCENES / "flow.prm"


class BadInputTest(runs.SystemTest):
    def check(self, parts, *arguments, code=1, unchanged=None):
        """The program ends with this code and says each of the parts once; the
        files of the folder `unchanged` (default: all) stay as they are."""
        before = unchanged if unchanged is not None else self.files("")
        for ranks in (1, 2):
            process = self.run_program(*arguments, ranks=ranks, code=code)
            self.assert_refused(process, *parts)
            for path, content in before.items():
                self.assertEqual(path.read_bytes(), content, f"{path} has changed")

    def check_parameters(self, parts, text, *arguments):
        """The same for the text of a scene; nothing at all is written."""
        scene = self.folder / "scene.prm"
        scene.write_text(f"include {FLOW}\n{text}", encoding="utf-8")
        before = self.files("")
        self.check(parts, scene, "--output", "run", *arguments)
        self.assertEqual(self.files(""), before)

    def results(self):
        """The files of a run but those that tell what was tried."""
        return {path: content for path, content in self.files("run").items()
                if path.name != "log.txt"}

    def test_misspelt_key(self):
        self.check_parameters(
            ["1 error in the parameters", "scene.prm:3", "Densty", 'did you mean "Density"'],
            "subsection Fluid\n  set Densty = 1\nend\n")

    def test_wrong_unit(self):
        self.check_parameters(
            ["1 error in the parameters", "scene.prm:3", "Fluid/Density", '"30 mm" is a length',
             "allowed is a positive density in kg/m^3"],
            "subsection Fluid\n  set Density = 30 mm\nend\n")

    def test_value_out_of_range(self):
        self.check_parameters(
            ["1 error in the parameters", "scene.prm:3", '"-1" is out of range'],
            "subsection Fluid\n  set Density = -1\nend\n")

    def test_two_errors_in_one_file(self):
        self.check_parameters(
            ["2 errors in the parameters", "scene.prm:3", "scene.prm:4", "Viscosty"],
            "subsection Fluid\n  set Density = 0\n  set Viscosty = 1\nend\n")

    def test_contradictory_physics(self):
        self.check_parameters(["a nerve net needs electrophysiology in Physics"], "",
                              *runs.sets(Scene__Muscle="nerve net"))
        self.check_parameters(["rigid bodies and elasticity exclude each other"], "",
                              *runs.sets(Scene__Physics="flow, elasticity, rigid bodies"))

    def test_command_line(self):
        self.check(["unknown option --outputs"], FLOW, "--outputs", "x")
        self.check(["missing.prm"], "missing.prm")

    def test_unwritable_output_folder(self):
        self.check(['The output folder "/proc/run" cannot be made', "--output"],
                   FLOW, "--output", "/proc/run")

    def test_output_folder_that_holds_a_run(self):
        self.run_scene("flow.prm", "run")
        self.check(['"run" already holds a run', "--resume", "--output", "--overwrite"],
                   FLOW, "--output", "run")
        self.run_scene("flow.prm", "run", "--overwrite")

    def test_folder_without_a_run(self):
        self.check(["nothing"], "--resume", "nothing")

    def test_truncated_checkpoints(self):
        self.run_scene("flow.prm", "run")
        for path in (self.folder / "run" / "checkpoints").iterdir():
            path.write_bytes(path.read_bytes()[:1000])
        self.check(["it is truncated or not an HDF5 file", "use another checkpoint"],
                   "--resume", "run", unchanged=self.results())

    def test_checkpoint_of_another_scene(self):
        self.run_scene("flow.prm", "run")
        self.check(["it belongs to another scene", "set Density = 1000", "set Density = 900",
                    "resume with the scene that wrote it"],
                   "--resume", "run", *runs.sets(Fluid__Density="900"),
                   unchanged=self.results())
        # The refused values are not kept.
        self.run_program("--resume", "run")

    def test_body_outside_of_the_grid(self):
        self.check(["The body 'sphere' reaches", "move the body or enlarge the grid"],
                   runs.SCENES / "sphere.prm", "--output", "run", "--overwrite",
                   *runs.sets(Rigid_body_sphere__Position="-1 m"))

    def test_run_that_diverges(self):
        for cut_backs in ("true", "false"):
            self.check(["not finite"], FLOW, "--output", "run", "--overwrite", *runs.sets(
                Fluid__Initial_axial_velocity="1e6*sin(10*r)*sin(20*y)",
            ), "--set", f"Time/Cut-backs = {cut_backs}", code=2, unchanged={})


if __name__ == "__main__":
    runs.main()
