#!/usr/bin/env python3
"""Elastic scenes that cannot be: every error is found before the run, with the
entry and a remedy, all of them at once."""

import runs

TUBE = """
subsection Scene
  set Physics   = elasticity
  set Mechanics = static
end
subsection Body
  set Shape        = tube
  set Degree       = 3, 3
  set Elements     = 4, 2
  set Inner radius = 0.5 m
  set Outer radius = 0.8 m
  set Length       = 1 m
end
subsection Elasticity
  subsection Side theta1_0
    set Fixed components = both
  end
end
"""

ROD = TUBE.replace("tube", "rod").replace("Inner radius = 0.5 m", "Radius = 0.5 m")

PATCH = """dimension 2
degree 1 1
knots 0 0 1 1
knots 0 0 1 1
control_points
0.5 1 1
{second}
0.5 0 1
1 0 1
"""


class ElasticScenesTest(runs.SystemTest):
    def refuse(self, *options, parts, scene=TUBE):
        """By --validate and by a run, which writes nothing."""
        (self.folder / "scene.prm").write_text(scene, encoding="utf-8")
        for more in (["--validate"], ["--output", "run"]):
            process = self.run_program("scene.prm", *more, *options, code=1)
            self.assert_refused(process, *parts)
            self.assertFalse((self.folder / "run").exists())

    def set_side(self, name, **entries):
        return [word for key, value in entries.items() for word in
                ("--set", f"Elasticity/Side {name}/{key.replace('_', ' ')} = {value}")]

    def test_unconstrained_body(self):
        self.refuse(*self.set_side("theta1_0", Fixed_components="r"),
                    parts=("Scene/Mechanics", "nothing holds the body along the axis"))

    def test_sides_that_contradict_each_other(self):
        self.refuse(*self.set_side("theta2_0", Fixed_components="r", Radial_displacement="0.1*t"),
                    *self.set_side("theta2_1", Fixed_components="y", Axial_displacement="0.2"),
                    parts=("2 errors in the parameters:",
                           "Sides theta1_0 and theta2_0 contradict each other in their common "
                           "corner: radial displacement 0 m and ",
                           "Sides theta1_0 and theta2_1 contradict each other in their common "
                           "corner: axial displacement 0 m and 0.2 m at t = 0 s; prescribe the "
                           "same value or free one side"))

    def test_ties(self):
        tie = ["--set", "Elasticity/Tied sides = theta1"]
        self.refuse(*tie, *self.set_side("theta1_1", Pressure="3"),
                    parts=("2 errors in the parameters:",
                           "side theta1_0 is tied to the opposite one and fixed as well",
                           'Elasticity/Side theta1_1/Pressure = "3": side theta1_1 is tied to the '
                           "opposite one, so that it is no surface"))
        self.refuse("--set", "Elasticity/Tied sides = theta2",
                    parts=("Elasticity/Tied sides", "cannot be tied: their control points 0 differ "
                           "in radius by 0.3 m"))

    def test_axis(self):
        self.refuse(*self.set_side("theta2_0", Pressure="3"), scene=ROD,
                    parts=("Elasticity/Side theta2_0/Pressure", "lies on the axis and has no area"))
        self.refuse(*self.set_side("theta2_0", Fixed_components="r", Radial_displacement="0.1"),
                    scene=ROD, parts=("moves a point of the axis radially by 0.1 m",))

    def test_material(self):
        self.refuse("--set", "Elasticity/c10 = -1 Pa", parts=("Elasticity/c10", "out of range"))
        for value in ("0.5", "0.6"):
            self.refuse("--set", "Elasticity/Moduli = Young and Poisson",
                        "--set", f"Elasticity/Poisson ratio = {value}",
                        parts=("Elasticity/Poisson ratio", "out of range"))
        self.refuse("--set", "Elasticity/Bulk modulus = 3 Pa",
                    parts=("Elasticity/Bulk modulus", "not used"))

    def test_muscle(self):
        muscle = ["--set", "Scene/Muscle = prescribed", "--set", "Elasticity/Active strain/Form = "
                  "unit directors", "--set", "Elasticity/Active strain/Pattern = 1"]
        self.refuse(*muscle, "--set", "Elasticity/Active strain/Coronal amplitude = 0.95",
                    parts=("Elasticity/Active strain/Coronal amplitude",
                           "shortens a fibre by 0.95 at theta1 = "))

    def test_formulas_without_a_value(self):
        self.refuse(*self.set_side("theta2_0", Pressure="1/t"),
                    parts=("Elasticity/Side theta2_0/Pressure", 'The formula "1/t" gives inf'))

    def test_all_at_once(self):
        self.refuse(*self.set_side("theta1_0", Fixed_components="none"),
                    *self.set_side("theta2_0", Pressure="1/t"),
                    "--set", "Elasticity/Tied sides = theta2", "--set", "Elasticity/Density = -1",
                    parts=("5 errors in the parameters:", "cannot be tied", "is tied to the "
                           "opposite one", "gives inf at", "nothing holds", "Elasticity/Density"))

    def test_probe_outside(self):
        self.refuse(scene=TUBE + "subsection Body probe tip\n  set Point = 0.5, 1.5\nend\n",
                    parts=("Body probe tip/Point", "out of range"))

    def test_patch_files(self):
        from_file = TUBE.replace("set Shape        = tube",
                                 "set Shape = file\n  set Patch file = patch.txt")
        for second, parts in (("1 1 1", None),
                              ("0.2 0 1", ("Body/Shape", "folded or wound the wrong way: its "
                                             "Jacobian is ")),
                              ("-1 1 1", ("Body/Shape",)),
                              ("1 1", ("patch.txt:7: a control point is a line 'r y weight'",)),
                              ("1 1 -1", ("patch.txt:7: the weight of a control point must be "
                                          "positive",)),
                              ("", ("the knot vectors ask for 4 control points, but the file "
                                    "holds 3",))):
            (self.folder / "patch.txt").write_text(PATCH.format(second=second), encoding="utf-8")
            if parts:
                self.refuse(scene=from_file, parts=parts)
            else:
                (self.folder / "scene.prm").write_text(from_file, encoding="utf-8")
                self.run_program("scene.prm", "--validate")
        (self.folder / "patch.txt").unlink()
        self.refuse(scene=from_file, parts=("cannot be opened",))

    def test_locking_is_told(self):
        (self.folder / "scene.prm").write_text(TUBE, encoding="utf-8")
        for degree, told in ((1, True), (2, False), (3, False)):
            process = self.run_program("scene.prm", "--validate", "--set",
                                       f"Body/Degree = {degree}, {degree}")
            self.assertEqual("lock where it bends" in process.stdout, told)
        process = self.run_program("scene.prm", "--validate", "--set", "Body/Degree = 2, 2",
                                   "--set", "Elasticity/K = 4 MPa")
        self.assertIn("Elements of degree 2, 2 of them across the body, lock where it bends: K/c10 "
                      "= 10000 is beyond 240", process.stdout)


if __name__ == "__main__":
    runs.main()
