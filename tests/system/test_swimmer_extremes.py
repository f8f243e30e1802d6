#!/usr/bin/env python3
"""A swimmer at the ends of size, contraction, step and density: it works, or ends
with one sentence. Whole strokes: parameters/studies/swimmer_extremes.study."""

import numpy

import runs

# A bell on cells of a_ex/20, contracted by a formula.
PRESCRIBED = runs.sets(Scene__Physics="elasticity, flow", Scene__Muscle="prescribed",
                       Elasticity__Active_strain__Form="unit directors",
                       Output__Profiles__Step_interval=0, Output__Fields__Step_interval=0,
                       Output__Checkpoints__Step_interval=0)
ADAPTIVE = runs.sets(Time__Time_step_control="adaptive", Time__Number_of_steps=0)


def grid(radius_mm):
    """The same grid in bell radii, for a bell of any size."""
    return runs.sets(Body__Bell__Radius=f"{radius_mm} mm",
                     Body__Axial_position=f"{3 * radius_mm} mm",
                     Fluid__Grid__Length_unit=f"{radius_mm} mm",
                     Fluid__Grid__Radial_breakpoints="0, 1.5, 4",
                     Fluid__Grid__Radial_spacings="0.05, 0.05, 0.3",
                     Fluid__Grid__Axial_breakpoints="0, 5",
                     Fluid__Grid__Axial_spacings="0.05",
                     Tracers_dye__Start=f"0 mm, {radius_mm} mm",
                     Tracers_dye__End=f"{radius_mm} mm, {radius_mm} mm")


class SwimmerExtremesTest(runs.SystemTest):
    def swim(self, *options):
        """The statistics; all numbers are finite."""
        self.run_scene("swim.prm", "run", "--overwrite", *PRESCRIBED, *options)
        table = self.table("run")
        self.assertTrue(numpy.isfinite(table.values).all())
        return table

    def test_contraction_by_more_than_half(self):
        """It stretches the surface and outruns fixed steps."""
        table = self.swim(*ADAPTIVE, *runs.sets(
            Elasticity__Active_strain__Coronal_amplitude=0.94, Time__End_time="0.25 s",
            Prescribed_activation__Time_course="min(1, t/0.2)"))
        self.assertGreater(table["drop of margin diameter [-]"].max(), 0.5)
        self.assertLess(table["CFL number [-]"].max(), 0.45)
        self.assertLess(table["largest marker spacing [cells]"].max(), 1)
        self.assertIn("are placed anew", (self.folder / "run/log.txt").read_text())
        self.assertEqual(self.table("run", "result.csv")["repeated steps [-]"][0], 0)

    def test_sizes(self):
        """Small bells contract as one; in the same 0.3 s one of 30 cm hardly does: ten
        times the length, a hundred times the acceleration for the same stress."""
        drops = []
        for radius in (1.5, 15, 150):
            table = self.swim(*ADAPTIVE, *grid(radius), *runs.sets(
                Elasticity__Active_strain__Coronal_amplitude=0.5, Time__Time_step="4 ms",
                Time__End_time="0.3 s", Cycles__Period="0.1 s",
                Prescribed_activation__Time_course="min(1, t/0.2)"))
            drops.append(table["drop of margin diameter [-]"].max())
            self.assertLess(table["CFL number [-]"].max(), 0.45)
        self.assertGreater(drops[0], 0.15)
        self.assertLess(abs(drops[1] / drops[0] - 1), 0.25)
        self.assertLess(drops[2], 0.3 * drops[1])
        self.assertGreater(drops[2], 0.01)

    def test_shortening_beyond_all_is_refused(self):
        process = self.run_scene("swim.prm", "run", *PRESCRIBED, *runs.sets(
            Elasticity__Active_strain__Coronal_amplitude=0.99), code=1)
        self.assert_refused(process, "Coronal amplitude = \"0.99\": The active strain shortens a "
                            "fibre by", "lower the amplitude")


if __name__ == "__main__":
    runs.main()
