#!/usr/bin/env python3
"""Errors in parameter files: one message that says where, what and what instead,
exit code 1, and nothing is written."""

import runs


class BadInputTest(runs.SystemTest):
    def refuse(self, *arguments, parts):
        """On 1 and 2 ranks, with the name of a folder that must not appear."""
        for ranks in (1, 2):
            process = self.run_program(*arguments, "--output", "run", ranks=ranks, code=1)
            self.assert_refused(process, *parts)
            self.assertFalse((self.folder / "run").exists())

    def refuse_text(self, text, *parts):
        (self.folder / "bad.prm").write_text(text, encoding="utf-8")
        self.refuse("bad.prm", parts=parts)

    def test_misspelt_key(self):
        self.refuse_text("subsection Fluid\n  set Densty = 998 kg/m^3\nend\n",
                         "1 error in the parameters:",
                         'bad.prm:2: Fluid/Densty = "998 kg/m^3": there is no such entry, '
                         'did you mean "Density"?')

    def test_wrong_unit(self):
        self.refuse_text("subsection Fluid\n  set Viscosity = 1 m\nend\n",
                         'bad.prm:2: Fluid/Viscosity = "1 m": "1 m" is a length, but a dynamic '
                         "viscosity is needed")

    def test_value_out_of_range(self):
        self.refuse_text("subsection Fluid\n  set Viscosity = -1 mPa s\nend\n",
                         'bad.prm:2: Fluid/Viscosity = "-1 mPa s": "-1 mPa s" is out of range; '
                         "allowed is a dynamic viscosity of at least 0 Pa s")

    def test_all_errors_are_reported(self):
        self.refuse_text("subsection Fluid\n  set Densty = 3\n  set Viscosity = 1 m\nend\n",
                         "2 errors in the parameters:", "bad.prm:2: Fluid/Densty",
                         "bad.prm:3: Fluid/Viscosity")

    def test_contradictory_physics(self):
        self.refuse_text("subsection Scene\n  set Physics = flow, rigid bodies, elasticity\nend\n",
                         'bad.prm:2: Scene/Physics = "flow, rigid bodies, elasticity": rigid '
                         "bodies and elasticity exclude each other; leave one of them out")

    def test_only_one_periodic_side(self):
        self.refuse_text("subsection Fluid\n  subsection Lower boundary\n"
                         "    set Type = periodic\n  end\nend\n",
                         'bad.prm:3: Fluid/Lower boundary/Type = "periodic": is periodic only '
                         "together with the upper boundary: set both, or none")

    def test_impossible_grid(self):
        self.refuse_text("subsection Fluid\n  subsection Grid\n"
                         "    set Radial breakpoints = 0 m, 2 m, 1 m\n  end\nend\n",
                         "bad.prm:3: Fluid/Grid/Radial breakpoints", "must increase")

    def test_lines_of_a_body(self):
        self.refuse_text("subsection Scene\n  set Physics = elasticity, flow\nend\n"
                         "subsection Body\n  set Axial position = 0.5 m\nend\n"
                         "subsection Coupling\n  set Scheme = sequential\nend\n"
                         "subsection Flow line wall\n  set End = 0, 1 mm\nend\n"
                         "subsection Body line wall\n  set Quantities = J, stress, J\nend\n"
                         "subsection Body line point\n  set End = 0, 0\nend\n"
                         "subsection Body probe tip\n  set Quantities = strain\nend\n",
                         "4 errors in the parameters:",
                         "Flow line wall writes files of the same names",
                         'bad.prm:14: Body line wall/Quantities = "J, stress, J": one of them is '
                         "named twice",
                         'bad.prm:17: Body line point/End = "0, 0": it is the start of the line',
                         'bad.prm:20: Body probe tip/Quantities = "strain"')

    def test_limits_of_a_region(self):
        self.refuse_text("subsection Flow region jet\n  set Axial limits = 2 m, 1 m\nend\n",
                         'bad.prm:2: Flow region jet/Axial limits = "2 m, 1 m": it needs two '
                         "numbers, the smaller one first, or none")

    def test_numbers_of_tracers(self):
        self.refuse_text("subsection Tracers dye\n  set Pattern = rectangle\n"
                         "  set Numbers = 7\nend\n",
                         'bad.prm:3: Tracers dye/Numbers = "7": a rectangle needs two numbers, '
                         "along r and along y")

    def test_tracers_outside_of_the_grid(self):
        self.refuse_text("subsection Tracers dye\n  set Start = 0 m, 1 km\nend\n",
                         "The tracers 'dye' start at (r, y) = (0, 1000) m, which is outside of "
                         "the grid; move them or widen the grid")

    def test_body_outside_of_the_grid(self):
        self.refuse(runs.SCENES / "swim.prm", *runs.sets(Body__Axial_position="1 m"),
                    parts=('--set: Body/Axial position = "1 m": The bell reaches (r, y) = ',
                           "move the body or enlarge the grid"))

    def test_rigid_body_outside_of_the_grid(self):
        self.refuse(runs.SCENES / "sphere.prm",
                    *runs.sets(Rigid_body_sphere__Position="93 mm"),
                    parts=("Rigid body sphere/Position", "The body 'sphere' reaches (r, y) = ",
                           "3 cells inside of the flow grid [0, 0.05] x [0, 0.096] m"))

    def test_sides_that_do_not_balance(self):
        def inflow(formula):
            return runs.sets(Fluid__Lower_boundary__Type="velocity",
                             Fluid__Lower_boundary__Axial_velocity=formula)

        self.refuse(runs.SCENES / "flow.prm", *inflow("1"),
                    parts=("1 error in the parameters:",
                           "let 3.14159 m^3/s more in than out at t = 0 s",
                           'make one side "outflow" or "pressure"'))
        self.refuse(runs.SCENES / "flow.prm", *inflow("step(t - 0.1)*(s^2 - 1)"),
                    parts=("more out than in at t = 0.1 s",))
        self.run_program("--validate", runs.SCENES / "flow.prm", *inflow("sin(t)"),
                         *runs.sets(Fluid__Upper_boundary__Type="outflow"))
        self.run_program("--validate", runs.SCENES / "flow.prm", *inflow("sin(t)"),
                         *runs.sets(Fluid__Upper_boundary__Type="velocity",
                                    Fluid__Upper_boundary__Axial_velocity="sin(t)"))

    def test_sides_that_contradict_the_fluid(self):
        self.refuse(runs.SCENES / "flow.prm", *runs.sets(Fluid__Viscosity="0 Pa s"),
                    parts=("3 errors in the parameters:", "Fluid/Lower boundary/Type",
                           "Fluid/Upper boundary/Type", "Fluid/Outer boundary/Type"))
        self.refuse(runs.SCENES / "flow.prm",
                    *runs.sets(Fluid__Lower_boundary__Type="periodic",
                               Fluid__Upper_boundary__Type="periodic",
                               Fluid__Grid__Axial_spacings="0.05 m, 0.06 m"),
                    parts=("Fluid/Grid/Axial spacings",
                           "a periodic flow needs a uniform axial spacing"))

    def test_time_steps(self):
        self.refuse(runs.SCENES / "flow.prm",
                    *runs.sets(Fluid__Viscous_terms="explicit", Time__Time_step="0.2 s"),
                    parts=("Fluid/Viscous terms", "the time step 0.2 s exceeds the limit of "
                           "explicit viscosity, 0.117188 s"))
        self.refuse(runs.SCENES / "flow.prm", *runs.sets(Time__CFL_number="1"),
                    parts=("Time/CFL number", "set Time step control = adaptive"))
        process = self.run_program(
            "--validate", runs.SCENES / "sphere.prm",
            *runs.sets(Rigid_body_sphere__Motion="prescribed",
                       Rigid_body_sphere__Velocity="10*sin(400*t)"))
        self.assertEqual(process.stdout.count("The body 'sphere' crosses 6."), 1)

    def test_rigid_bodies(self):
        self.refuse(runs.SCENES / "sphere.prm", *runs.sets(Rigid_body_sphere__Radius="0.7 mm"),
                    parts=("Rigid body sphere/Shape", "the body is only 0.93"))
        self.refuse(runs.SCENES / "sphere.prm",
                    *runs.sets(Rigid_body_sphere__Density="900 kg/m^3",
                               Rigid_body_sphere__Interior_fluid="rigid"),
                    parts=("Rigid body sphere/Interior fluid",
                           "the body has 900 kg/m^3 and the fluid 960"))
        self.refuse(runs.SCENES / "sphere.prm",
                    *runs.sets(Immersed_boundary__Marker_spacing="1.5"),
                    parts=("Immersed boundary/Marker spacing", "out of range"))
        text = (runs.SCENES / "sphere.prm").read_text(encoding="utf-8")
        for position, overlap in (("38 mm", False), ("50 mm", True)):
            other = (f"\nsubsection Rigid body other\n  set Radius = 7.5 mm\n"
                     f"  set Position = {position}\nend\n")
            if overlap:
                self.refuse_text(text + other, "Rigid body other/Position",
                                 "the body overlaps with the body 'sphere' at the start: "
                                 "move them apart")
            else:
                (self.folder / "good.prm").write_text(text + other, encoding="utf-8")
                self.run_program("--validate", "good.prm")

    def test_coupling_that_fits_neither_density_nor_time_scheme(self):
        self.refuse(runs.SCENES / "swim.prm",
                    *runs.sets(Coupling__Scheme="forcing as load",
                               Elasticity__Density="900 kg/m^3", Fluid__Time_scheme="rk3"),
                    parts=("2 errors in the parameters:",
                           "the body has 900 kg/m^3 and the fluid 1000; set Scheme = added mass",
                           "set Time scheme = ab2, or Scheme = added mass"))
        self.refuse(runs.SCENES / "swim.prm",
                    *runs.sets(Coupling__Scheme="added mass", Coupling__Added_mass="forcing",
                               Fluid__Time_scheme="rk3"),
                    parts=("Coupling/Added mass = forcing needs one projection a step",))

    def test_moving_window(self):
        window = "Fluid/Moving window/"
        for options, parts in (
                (runs.sets(Fluid__Moving_window__Follow="ball"),
                 (f'--set: {window}Follow = "ball": there is no such body in the scene; choose '
                  '"sphere", or none',)),
                (runs.sets(Fluid__Moving_window__Follow="swimmer"),
                 ("there is no such body in the scene",)),
                (runs.sets(Rigid_body_sphere__Motion="fixed", Rigid_body_sphere__Velocity="0"),
                 (f'window.prm:32: {window}Follow = "sphere": the body does not move',)),
                (runs.sets(Fluid__Moving_window__Follow=""),
                 ("2 errors in the parameters:",
                  f"window.prm:33: {window}Cells = \"2\": is given, but Follow is empty",
                  'Flow line along/Frame = "window": there is no moving window')),
                (runs.sets(Fluid__Grid__Axial_spacings="1.5 mm, 1.6 mm"),
                 ("a moving window needs a uniform axial spacing",)),
                (runs.sets(Fluid__Lower_boundary__Type="periodic",
                           Fluid__Upper_boundary__Type="periodic"),
                 ("the flow is periodic along y, which has no ends that could move",)),
                (runs.sets(Fluid__Moving_window__Cells=30),
                 ("keeps the body 'sphere' 0.06 m above its lower end, within 30 cells",))):
            self.refuse(runs.SCENES / "window.prm", *options, parts=parts)
        self.refuse(runs.SCENES / "flow.prm", *runs.sets(Fluid__Moving_window__Follow="swimmer"),
                    parts=("there is no deformable body to follow",))

    def test_files_that_are_none(self):
        (self.folder / "folder.prm").mkdir()
        (self.folder / "empty.prm").touch()
        for name, message in (("missing.prm", 'the parameter file "missing.prm" does not exist'),
                              ("folder.prm", 'the parameter file "folder.prm" is a folder'),
                              ("empty.prm", 'the parameter file "empty.prm" sets nothing')):
            with self.subTest(name):
                self.refuse(name, parts=(message,))

    def test_command_line(self):
        process = self.run_program("a.prm", "b.prm", "--outptu", "x", code=1)
        self.assert_refused(process, "Command line:", "unknown option --outptu (see --help)",
                            "one parameter file at a time can be run, 3 were given")

    def test_sections_without_effect_are_told(self):
        process = self.run_program(
            "--validate", runs.SCENES / "sphere.prm",
            *runs.sets(Elasticity__Density="1100 kg/m^3", Coupling__Tolerance="1e-4"))
        self.assertIn('Warning: The section "Elasticity" has no effect: elasticity is not in '
                      "Scene/Physics.", process.stdout)
        self.assertIn('Warning: The section "Coupling" has no effect', process.stdout)
        self.assertNotIn('"Fluid" has no effect', process.stdout)


if __name__ == "__main__":
    runs.main()
