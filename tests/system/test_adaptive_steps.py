#!/usr/bin/env python3
"""Adaptive time steps: at the wanted CFL number, on a ladder of few lengths, the
same on any number of ranks and after a restart."""

import numpy

import runs

ADAPTIVE = runs.sets(Time__Time_step_control="adaptive")
RING = [*ADAPTIVE, *runs.sets(Time__Time_step="0.1 s", Time__End_time="1 s",
                              Fluid__Viscosity="1 Pa s")]


class AdaptiveStepsTest(runs.SystemTest):
    def test_flow(self):
        self.run_scene("flow.prm", "one", *RING)
        table = self.table("one")
        steps = table["time step [s]"][1:]
        self.assertAlmostEqual(table["time [s]"][-1], 1)
        # A margin of one rung and 5 % is left for growth.
        self.assertLess(table["CFL number [-]"].max(), 1.2 * 1.3)
        self.assertGreater(table["CFL number [-]"][3:-2].min(), 1.2 / 2 ** 0.5)
        rungs = 4 * numpy.log2(0.1 / steps[:-2])  # the last two share the rest
        self.assertLess(numpy.abs(rungs - rungs.round()).max(), 1e-6)
        self.assertLess(rungs[-1], rungs[0])  # the ring decays
        self.run_scene("flow.prm", "two", *RING, ranks=2)
        self.assert_same("two", "one", 1e-9)

    def test_restart(self):
        self.run_scene("flow.prm", "one", *RING)
        self.run_scene("flow.prm", "parts", *RING, *runs.sets(Time__Number_of_steps=5))
        self.run_program("--resume", "parts", "--quiet", *runs.sets(Time__Number_of_steps=0))
        self.assert_same("parts", "one", 1e-12)

    def test_explicit_viscosity_limits_the_step(self):
        # limit 2.4 / (8 nu / h^2) = 0.01172 s
        for terms, longest in (("explicit", 0.01172), ("implicit", 0.1)):
            self.run_scene("flow.prm", terms, *RING,
                           *runs.sets(Fluid__Viscosity="100 Pa s", Fluid__Viscous_terms=terms))
            largest = self.table(terms)["time step [s]"].max()
            self.assertLess(largest, longest * (1 + 1e-3))
            self.assertGreater(largest, 0.8 * longest)

    def test_body_that_starts_from_rest(self):
        self.run_scene("sphere.prm", "run", *ADAPTIVE,
                       *runs.sets(Time__Time_step="1 s", Time__Number_of_steps=12,
                                  Rigid_body_sphere__Density="9600 kg/m^3"))
        table = self.table("run")
        # a = 9/10.5 g of the added mass; not more than 1.2 cells in the first step.
        first = (1.2 * 1.5e-3 / (9 / 10.5 * 9.81)) ** 0.5
        self.assertLess(table["time step [s]"][1], first)
        self.assertGreater(table["time step [s]"][1], 0.8 * first)
        self.assertLess(table["CFL number [-]"].max(), 1.2 * 1.3)

    def test_nothing_to_follow(self):
        process = self.run_program(runs.SCENES / "swim.prm", *ADAPTIVE, "--output", "run",
                                   *runs.sets(Scene__Physics="elasticity"), code=1)
        self.assert_refused(process, "adaptive steps follow the flow, and there is none")


if __name__ == "__main__":
    runs.main()
