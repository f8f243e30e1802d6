#!/usr/bin/env python3
"""Output folders and checkpoints that cannot be used: one message with a remedy,
exit code 1, and what is there stays as it is."""

import shutil

import runs

SPHERE = runs.SCENES / "sphere.prm"


class BadFoldersTest(runs.SystemTest):
    def refuse(self, *arguments, parts):
        """On 1 and 2 ranks; no file appears or changes."""
        before = self.files(".")
        for ranks in (1, 2):
            process = self.run_program(*arguments, ranks=ranks, code=1)
            self.assert_refused(process, *parts)
        self.assertEqual(self.files("."), before)

    def make_run(self):
        """With checkpoints at the steps 4 and 8."""
        self.run_scene("sphere.prm", "run", *runs.sets(Time__Number_of_steps=8,
                                                       Output__Checkpoints__Step_interval=4))
        return self.folder / "run/checkpoints"

    def test_folder_that_cannot_be_written(self):
        (self.folder / "file").touch()
        self.refuse(SPHERE, "--output", "file/run",
                    parts=('The output folder "file/run" cannot be made',
                           "name another with --output"))
        self.refuse(SPHERE, "--output", "file",
                    parts=('The output folder "file" is a file; name another folder',))

    def test_folder_that_holds_a_run(self):
        self.make_run()
        self.refuse(SPHERE, "--output", "run",
                    parts=('The output folder "run" already holds a run; continue that run with '
                           "--resume, name another folder with --output, or replace it with "
                           "--overwrite.",))
        # Nor does --overwrite destroy a run for a scene that cannot start.
        self.refuse(SPHERE, "--output", "run", "--overwrite",
                    *runs.sets(Rigid_body_sphere__Position="1 m"),
                    parts=("move the body or enlarge the grid",))
        self.refuse(SPHERE, "--output", "run", "--overwrite",
                    *runs.sets(Fluid__Viscous_terms="explicit", Fluid__Viscosity="10 Pa s"),
                    parts=("exceeds the limit of explicit viscosity",))
        self.run_program(SPHERE, "--output", "run", "--overwrite", "--quiet",
                         *runs.sets(Time__Number_of_steps=2))
        self.assertEqual(len(self.table("run").values), 3)

    def test_nothing_to_resume(self):
        for name in ("nowhere", str(SPHERE)):
            self.refuse("--resume", name,
                        parts=("holds no run that could be resumed; name the folder of a run, or "
                               "start one without --resume.",))
        shutil.rmtree(self.make_run())
        self.refuse("--resume", "run",
                    parts=("There is no checkpoint in run/checkpoints: name the folder of a run "
                           "that has written one, or start again without --resume.",))
        self.refuse("--resume", "run", "--output", "other",
                    parts=("--resume continues in its own folder: leave out --output",))

    def test_truncated_checkpoints(self):
        checkpoints = self.make_run()
        newest, older = (checkpoints / f"checkpoint_{step:09d}.h5" for step in (8, 4))
        for size in (newest.stat().st_size // 2, 0):
            newest.write_bytes(newest.read_bytes()[:size])
            shutil.copytree(self.folder / "run", self.folder / "copy")
            # The older one stands in.
            process = self.run_program("--resume", "copy")
            self.assertEqual(process.stdout.count("it is truncated or not an HDF5 file"), 1)
            self.assertIn("Resumed from copy/checkpoints/checkpoint_000000004.h5", process.stdout)
            self.assertEqual(self.table("copy")["step [-]"].tolist(), list(range(9)))
            shutil.rmtree(self.folder / "copy")
        older.unlink()
        self.refuse("--resume", "run",
                    parts=("Checkpoint run/checkpoints/checkpoint_000000008.h5: it is truncated "
                           "or not an HDF5 file; use another checkpoint.",))

    def test_damaged_checkpoint(self):
        checkpoints = self.make_run()
        (checkpoints / "checkpoint_000000004.h5").unlink()
        file = checkpoints / "checkpoint_000000008.h5"
        content = bytearray(file.read_bytes())
        middle = len(content) // 2
        content[middle:middle + 64] = bytes(255 - byte for byte in content[middle:middle + 64])
        file.write_bytes(content)
        self.refuse("--resume", "run", parts=("Checkpoint run/checkpoints/checkpoint_000000008.h5",))

    def test_checkpoint_of_another_scene(self):
        self.make_run()
        self.refuse("--resume", "run", *runs.sets(Fluid__Viscosity="2 Pa s"),
                    parts=("Checkpoint run/checkpoints/checkpoint_000000008.h5: it belongs to "
                           "another scene, it has", "Viscosity = 58 mPa s", "Viscosity = 2 Pa s",
                           "resume with the scene that wrote it"))
        self.refuse(runs.SCENES / "swim.prm", "--resume", "run",
                    parts=("it belongs to another scene",))


if __name__ == "__main__":
    runs.main()
