#!/usr/bin/env python3
"""Tissue at the ends of pacing, stimulus, conductivity and step."""

import math

import runs

PACED = runs.ROOT / "parameters/tutorials/paced_tissue.prm"
CABLE = runs.ROOT / "parameters/verification/cable.prm"


class TissueExtremesTest(runs.SystemTest):
    def result(self, scene, **entries):
        self.run_program(scene, "--quiet", "--overwrite", "--output", "run",
                         *runs.sets(**entries))
        table = self.table("run", "result.csv")
        return lambda column: float(table[column][-1])

    def waves(self, **entries):
        result = self.result(PACED, **{f"Electrophysiology__Stimulus__{name}": value
                                       for name, value in entries.items()}, Time__End_time="0.4 s")
        return [result(f"crossings at theta1 = {place} [-]") for place in (0.9, 0.1)]

    def test_every_pulse_or_every_second_one_is_followed(self):
        # Points release again after 30 ms only.
        self.assertEqual(self.waves(Pacing_frequency="20 Hz"), [8, 8])
        self.assertEqual(self.waves(Pacing_frequency="40 Hz"), [8, 8])

    def test_stimulus_from_too_weak_to_a_hundred_times_too_strong(self):
        self.assertEqual(self.waves(Pacing_frequency="0 Hz", Current="0.004 nA/mm^3"), [0, 0])
        for current in ("0.008 nA/mm^3", "10 nA/mm^3"):
            self.assertEqual(self.waves(Pacing_frequency="0 Hz", Current=current), [1, 1])

    def test_speed_goes_with_the_root_of_the_conductivity(self):
        # A line as long as the root of the conductivity sees the same wave.
        times = []
        for conductivity in (1e-8, 1e-3):
            length = 20 * math.sqrt(conductivity / 1.3745e-5)
            result = self.result(CABLE, Electrophysiology__Conductivity=f"{conductivity} uS/mm",
                                 Electrophysiology__Time_step="20 us", Tissue__Elements=200,
                                 Tissue__Length=f"{length!r} mm")
            times.append(result("first crossing at theta1 = 0.8 [s]"))
        self.assertLess(abs(times[1] / times[0] - 1), 1e-8)
        self.assertLess(abs(times[0] - 0.036), 0.001)

    def test_what_is_impossible_is_said(self):
        for entries, code, part in (
                ({"Electrophysiology__Stimulus__Duration": "0 s"}, 1, "a positive time in s"),
                ({"Electrophysiology__Conductivity": "-1 S/m"}, 1, "at least 0 S/m"),
                ({"Electrophysiology__Resting_time_step": "10 ms"}, 1, "Resting time step"),
                ({"Electrophysiology__Stimulus__Pacing_frequency": "20 kHz"}, 1, "overlap"),
                ({"Tissue__Motion__Axial_displacement": "-y"}, 2, "G_11 = 0")):
            process = self.run_program(PACED, "--quiet", "--overwrite", "--output", "run",
                                       *runs.sets(**entries), code=code)
            self.assertIn(part, process.stderr)


if __name__ == "__main__":
    runs.main()
