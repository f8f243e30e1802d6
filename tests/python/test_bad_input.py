"""Bad input: one clean message with the remedy, from one rank, the exit code,
and nothing overwritten; on one and on two ranks."""

import unittest

from program import SCENES, ProgramTest

FLOW = SCENES / "small_flow.prm"
SPHERE = SCENES / "small_sphere.prm"


class BadInput(ProgramTest):
    def check(self, code, words, *arguments):
        """The run fails with this code, and says each of the words once."""
        before = self.content(self.folder)
        for ranks in (1, 2):
            found, errors = self.run_program(*arguments, ranks=ranks)
            self.assertEqual(found, code, errors)
            for word in words:
                self.assertEqual(errors.count(word), 1, f"{word!r} in:\n{errors}")
            self.assertNotIn("HDF5", errors)
            self.assertNotIn("MPI", errors)
            for path, content in before.items():
                self.assertEqual(path.read_bytes(), content, f"{path} has changed")

    def check_parameters(self, words, text, *arguments):
        """The same for the text of a scene; nothing at all is written."""
        scene = self.folder / "scene.prm"
        scene.write_text(f"include {FLOW}\n{text}")
        before = self.content(self.folder)
        self.check(1, words, scene, "--output", "run", *arguments)
        self.assertEqual(self.content(self.folder), before)

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
        self.check_parameters(
            ["a nerve net needs electrophysiology in Physics"], "",
            "--set", "Scene/Muscle = nerve net")
        self.check_parameters(
            ["rigid bodies and elasticity exclude each other"], "",
            "--set", "Scene/Physics = flow, elasticity, rigid bodies")

    def test_command_line(self):
        self.check(1, ["unknown option --outputs"], FLOW, "--outputs", "x")
        self.check(1, ["missing.prm"], "missing.prm")

    def test_unwritable_output_folder(self):
        self.check(1, ['The output folder "/proc/run" cannot be made', "--output"],
                   FLOW, "--output", "/proc/run")

    def test_output_folder_that_holds_a_run(self):
        self.succeed(FLOW, "--output", "run")
        self.check(1, ['"run" already holds a run', "--resume", "--output", "--overwrite"],
                   FLOW, "--output", "run")
        self.succeed(FLOW, "--output", "run", "--overwrite")

    def test_folder_without_a_run(self):
        self.check(1, ["nothing"], "--resume", "nothing")

    def test_truncated_checkpoints(self):
        self.succeed(FLOW, "--output", "run")
        for path in (self.folder / "run" / "checkpoints").iterdir():
            path.write_bytes(path.read_bytes()[:1000])
        tables = {path: content for path, content in self.content(self.folder / "run").items()
                  if path.suffix in (".csv", ".h5")}
        for ranks in (1, 2):
            code, errors = self.run_program("--resume", "run", ranks=ranks)
            self.assertEqual(code, 1)
            self.assertEqual(errors.count("it is truncated or not an HDF5 file"), 1, errors)
            for path, content in tables.items():
                self.assertEqual(path.read_bytes(), content, f"{path} has changed")

    def test_checkpoint_of_another_scene(self):
        self.succeed(FLOW, "--output", "run")
        before = {path: content for path, content in self.content(self.folder / "run").items()
                  if path.name not in ("log.txt", "parameters.prm")}
        for ranks in (1, 2):
            code, errors = self.run_program("--resume", "run", "--set", "Fluid/Density = 900",
                                            ranks=ranks)
            self.assertEqual(code, 1)
            for word in ("it belongs to another scene", "set Density = 1000",
                         "set Density = 900"):
                self.assertEqual(errors.count(word), 1, errors)
            for path, content in before.items():
                self.assertEqual(path.read_bytes(), content, f"{path} has changed")
        # The refused values are not kept.
        self.succeed("--resume", "run")

    def test_body_leaves_the_grid(self):
        for ranks in (1, 2):
            code, errors = self.run_program(
                SPHERE, "--output", "run", "--overwrite", "--set", "Rigid body ball/Position = 0.9 m",
                ranks=ranks)
            self.assertEqual(code, 1)
            self.assertEqual(errors.count("Body 'ball' reaches"), 1, errors)
            self.assertEqual(errors.count("move the body or enlarge the grid"), 1, errors)

    def test_run_that_diverges(self):
        wild = ["--set", "Fluid/Initial axial velocity = 1e6*sin(10*r)*sin(20*y)"]
        for ranks in (1, 2):
            for cut_backs in ("true", "false"):
                code, errors = self.run_program(
                    FLOW, "--output", "run", "--overwrite", *wild,
                    "--set", f"Time/Cut-backs = {cut_backs}", ranks=ranks)
                self.assertEqual(code, 2, errors)
                self.assertEqual(errors.count("not finite"), 1, errors)


if __name__ == "__main__":
    unittest.main()
