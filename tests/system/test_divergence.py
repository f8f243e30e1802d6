#!/usr/bin/env python3
"""Runs that fail on purpose end with one message that has a remedy, exit code 2,
and a checkpoint of the last good step; and the shipped scene in which sequential
coupling diverges while the implicit schemes hold."""

import re

import numpy

import runs

SHIPPED = runs.ROOT / "parameters/coupling/sequential_diverges.prm"
COARSE = runs.sets(Output__Progress_interval=0)


class DivergenceTest(runs.SystemTest):
    def diverge(self, scene, *options, parts):
        """The messages on one and on two ranks; both have the parts."""
        messages = []
        for ranks in (1, 2):
            process = self.run_program(scene, "--output", "run", "--overwrite", "--quiet",
                                       *options, ranks=ranks, code=2)
            self.assert_refused(process, *parts)
            log = (self.folder / "run/log.txt").read_text(encoding="utf-8")
            self.assertIn("Diverged after step", log)
            self.assertTrue(numpy.isfinite(self.table("run").values).all())
            messages.append(process.stderr)
        return messages

    def last_step(self):
        return int(self.table("run")["step [-]"][-1])

    def test_body_leaving_the_grid(self):
        """A fast one is beyond the end before it comes too near for its load."""
        for force, parts in (("1e4 N/m^3", ("No probe fits in front of body 'body' at (r, y) = ",
                                            "end the run earlier")),
                             ("4e4 N/m^3", ("Body 'body' has left the flow grid at (r, y) = ",
                                            "enlarge it or end the run earlier."))):
            self.diverge(runs.SCENES / "swim.prm",
                         *runs.sets(Body__Axial_position="69 mm",
                                    Elasticity__Axial_body_force=force),
                         parts=parts)
            checkpoint = f"run/checkpoints/checkpoint_{self.last_step():09d}.h5"
            self.assertTrue((self.folder / checkpoint).exists())

    def test_flow_with_a_huge_velocity(self):
        for cut_backs in ("true", "false"):
            self.diverge(runs.SCENES / "flow.prm",
                         *runs.sets(Fluid__Initial_axial_velocity="1e6*sin(10*r)*sin(20*y)"),
                         "--set", f"Time/Cut-backs = {cut_backs}",
                         parts=("The flow has become unstable: its velocity (v_r, v_y) = (",
                                ") m/s at (r, y) = (", "m has the CFL number ", ", beyond 2.8: ",
                                "run the scene with a smaller Time/Time step."))

    def test_flow_that_outruns_its_steps(self):
        """It ends where it begins to be wrong, with the place; what is kept goes
        on with shorter steps."""
        wall = runs.sets(Fluid__Outer_boundary__Type="velocity",
                         Fluid__Outer_boundary__Axial_velocity="1000*t",
                         Time__End_time="1 s", Time__Smallest_time_step="5 ms")
        message, on_two_ranks = self.diverge(
            runs.SCENES / "flow.prm", *wall,
            parts=("The flow has become unstable: its velocity (v_r, v_y) = (",
                   "; in the step before, the largest was (v_r, v_y) = ("))
        self.assertEqual(re.findall(r"[(]r, y[)] = [^)]*[)] m", message),
                         re.findall(r"[(]r, y[)] = [^)]*[)] m", on_two_ranks))
        # A little beyond what the scheme can carry.
        cfl = [float(number) for number in re.findall(r"CFL number ([0-9.]+)", message)]
        self.assertGreater(cfl[0], 2.8)
        self.assertLess(cfl[0], 3.5)
        self.assertLess(cfl[1], 2.8)
        last = self.table("run")
        checkpoint = f"run/checkpoints/checkpoint_{self.last_step():09d}.h5"
        self.assertTrue((self.folder / checkpoint).exists())
        self.assertAlmostEqual(last["CFL number [-]"][-1], cfl[1], 3)
        end = last["time [s]"][-1] + 0.01
        self.run_program("--resume", "run", "--quiet",
                         *runs.sets(Time__Time_step="1 ms", Time__Smallest_time_step="1 us",
                                    Time__End_time=f"{end} s"))
        self.assertEqual(self.last_step(), int(last["step [-]"][-1]) + 10)
        self.assertLess(self.table("run")["CFL number [-]"][-1], 1)

    def test_body_that_folds(self):
        self.diverge(runs.SCENES / "swim.prm",
                     *runs.sets(Fluid__Initial_axial_velocity="1000*exp(-(r/0.01)^2)",
                                Fluid__Convection="false"),
                     parts=("below the Smallest time step", "elasticity at t = "))

    def test_sequential_coupling(self):
        self.diverge(SHIPPED, *COARSE,
                     parts=("the sequential scheme is unstable at any time step where the added "
                            "mass of the fluid exceeds the mass of the body: use Coupling/Scheme "
                            "= forcing as load or added mass.",))
        self.assertLess(self.last_step(), 80)

    def test_sequential_coupling_of_a_light_and_thin_tube(self):
        """Added mass finishes it: the scene case tube_wave_light_and_thin."""
        self.diverge(runs.ROOT / "parameters/verification/tube_wave.prm", *COARSE,
                     *runs.sets(Coupling__Scheme="sequential", Body__Outer_radius="1.05 m",
                                Elasticity__Density="0.1 kg/m^3"),
                     parts=("the sequential scheme is unstable at any time step where the added "
                            "mass of the fluid exceeds the mass of the body",))
        self.assertLess(self.last_step(), 20)

    def test_implicit_coupling_holds(self):
        moved = []
        for scheme in ("forcing as load", "fixed point", "added mass"):
            self.run_program(SHIPPED, "--output", scheme, "--quiet", *COARSE,
                             *runs.sets(Coupling__Scheme=scheme))
            table = self.table(scheme)
            self.assertEqual(table["step [-]"][-1], 800)
            self.assertTrue(numpy.isfinite(table.values).all())
            self.assertEqual(self.table(scheme, "result.csv")["repeated steps [-]"][0], 0)
            self.assertLess(table["coupling iterations [-]"].max(), 10)
            moved.append(table["centre of mass y [m]"][-1] - table["centre of mass y [m]"][0])
            self.assertGreater(table["drop of margin diameter [-]"].max(), 0.15)
        # A swim, and the same one, since all take the load from the forcing.
        self.assertGreater(min(moved), 1e-3)
        self.assertLess(max(moved), 1.01 * min(moved))

    def test_no_jump_at_the_density_of_the_fluid(self):
        """The default scheme changes there, the result does not."""
        moved, drop = [], []
        for density in (999, 1001):
            name = str(density)
            self.run_program(SHIPPED, "--output", name, "--quiet", *COARSE,
                             *runs.sets(Coupling__Scheme="automatic", Elasticity__Density=density,
                                        Time__Time_step="1 ms"))
            table = self.table(name)
            moved.append(table["centre of mass y [m]"][-1] - table["centre of mass y [m]"][0])
            drop.append(table["drop of margin diameter [-]"].max())
        schemes = [(self.folder / name / "log.txt").read_text(encoding="utf-8")
                   for name in ("999", "1001")]
        self.assertIn("Coupling: added mass", schemes[0])
        self.assertIn("Coupling: forcing as load", schemes[1])
        # By probes the lighter one moves 8 % farther.
        self.assertAlmostEqual(moved[0] / moved[1], 1, delta=5e-3)
        self.assertAlmostEqual(drop[0] / drop[1], 1, delta=2e-3)


if __name__ == "__main__":
    runs.main()
