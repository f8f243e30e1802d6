#!/usr/bin/env python3
"""A tissue by parameter file alone: every curve, ionic model, placement, measure
and motion together, with answers that the geometry cannot change."""

import itertools

import numpy
import runs

FILE = """# A quarter of an ellipse.
dimension 1
unit mm
degree 2
knots 0 0 0 1 1 1
control_points
5 0 1
5 8 0.7071067811865476
12 8 1
"""
LINES = {"disk": [], "cylinder": [], "hemi-ellipsoid": [], "sphere": [], "spheroid": [],
         "torus": [], "file": runs.sets(Tissue__Patch_file="line.txt")}
PLACEMENTS = ("Greville points", "control coefficients", "quadrature points")
MOTION = runs.sets(Tissue__Motion__Radial_displacement="-0.1*r*sin(200*t)",
                   Tissue__Motion__Axial_displacement="0.2*y*t/1e-3")


class TissueTest(runs.SystemTest):
    def run_tissue(self, name, *options, code=0):
        return self.run_scene("tissue.prm", name, *options, code=code)

    def combinations(self):
        """Every curve and placement, with the other choices taken in turn."""
        (self.folder / "line.txt").write_text(FILE, encoding="utf-8")
        others = itertools.cycle(itertools.product(
            ([], MOTION), ("reference", "deformed"), ("consistent", "lumped")))
        for shape, placement in itertools.product(LINES, PLACEMENTS):
            motion, measure, mass = next(others)
            yield f"{shape}, {placement}, {measure}, {mass}, {bool(motion)}", [
                *LINES[shape], *motion, *runs.sets(
                    Tissue__Shape=shape, Electrophysiology__Placement=placement,
                    Electrophysiology__Measure=measure, Electrophysiology__Mass_matrix=mass)]

    def assert_same_as_cell(self, model, *options):
        """A line that is excited everywhere at once is an isolated cell."""
        self.run_tissue("cell", "--overwrite", *model, *runs.sets(Tissue__Isolated_cell="true"))
        cell = self.table("cell")["largest potential [V]"]
        for name, others in self.combinations():
            with self.subTest(name):
                self.run_tissue("line", "--overwrite", *model, *others, *options)
                line = self.table("line")
                self.assertGreater(numpy.ptp(cell), 0.01)
                for column in ("largest potential [V]", "smallest potential [V]"):
                    self.assertLess(abs(line[column] - cell).max(), 1e-9)
                probe = self.table("line", "probes/middle.csv")
                self.assertLess(abs(probe["potential [V]"] - cell).max(), 1e-9)

    def test_neuron_everywhere(self):
        neuron = runs.sets(Electrophysiology__Stimulus__EPSC_times="0 s",
                           Electrophysiology__Synapses__Release="false")
        self.assert_same_as_cell(neuron, *runs.sets(
            **{"Tissue probe middle/Quantities": "potential, activation, gates, currents"}))

    def test_nagumo_everywhere(self):
        self.assert_same_as_cell(runs.sets(Electrophysiology__Ionic_model="Nagumo",
                                           Electrophysiology__Nagumo__Rate="4000 1/s",
                                           Electrophysiology__Initial_potential="0.3 V"))

    def test_charge_everywhere(self):
        # 0.1 nA/mm^3 for 0.1 ms over 1e-3 nF/mm^3.
        charge = runs.sets(Electrophysiology__Ionic_model="none",
                           Electrophysiology__Stimulus__Current="0.1 nA/mm^3")
        for name, others in self.combinations():
            with self.subTest(name):
                self.run_tissue("line", "--overwrite", *charge, *others)
                line = self.table("line")
                for column in ("largest potential [V]", "smallest potential [V]"):
                    self.assertLess(abs(line[column][-1] - 0.01), 1e-12)

    def test_wave_passes_the_seam_of_a_torus(self):
        # Excited at the seam or opposite to it, round a thin ring.
        torus = runs.sets(Tissue__Shape="torus", Tissue__Ring_radius="1 m",
                          Tissue__Core_radius="2 mm", Tissue__Elements=600,
                          Time__End_time="16 ms",
                          Electrophysiology__Stimulus__Current="0.5 nA/mm^3")
        arrival = {}
        for where, interval in (("seam", "0, 0.02"), ("opposite", "0.5, 0.52")):
            self.run_tissue(where, *torus, *runs.sets(
                Electrophysiology__Stimulus__Interval=interval, **{
                    "Tissue line all/Quantities": "arrival", "Tissue line all/Intervals": 4}))
            table = self.table(where, "profiles/all_arrival.csv")
            arrival[where] = [table[name][-1] for name in ("0", "0.25", "0.5", "0.75", "1")]
        self.assertTrue(numpy.isfinite(list(arrival.values())).all())
        seam, opposite = arrival["seam"], arrival["opposite"]
        self.assertEqual(seam[0], seam[4])
        for a, b in ((0, 2), (1, 3), (2, 4), (3, 1)):
            self.assertLess(abs(seam[a] - opposite[b]), 2e-6)
        # The pulse is on one side of the seam: 2 % of the way round apart.
        self.assertLess(abs((seam[3] - seam[1]) * 0.475 - 0.02 * 2 * numpy.pi * 2e-3), 2e-5)

    def test_a_map_of_arrivals_and_the_restart(self):
        wave = runs.sets(Tissue__Shape="cylinder", Tissue__Elements=400, Time__End_time="12 ms",
                         Electrophysiology__Stimulus__Current="0.5 nA/mm^3",
                         Electrophysiology__Stimulus__Interval="0, 0.02",
                         Output__Checkpoints__Time_interval="6 ms", **{
                             "Tissue line all/Quantities": "arrival, position, currents",
                             "Tissue line all/Intervals": 10})
        wave += MOTION[:2] + runs.sets(Electrophysiology__Measure="deformed")
        self.run_tissue("whole", *wave)
        table = self.table("whole", "profiles/all_arrival.csv")
        last = table.values[-1][1:]
        self.assertTrue(numpy.isnan(table.values[0][1:]).all())
        self.assertTrue(numpy.isfinite(last[:2]).all() and numpy.isnan(last[-2:]).all())
        reached = last[numpy.isfinite(last)]
        self.assertTrue((numpy.diff(reached) > 0).all())
        place = self.table("whole", "profiles/all_r.csv")
        self.assertLess(abs(place["0.5"] - 0.01 * (1 - 0.1 * numpy.sin(200 * place["time [s]"]))
                            ).max(), 1e-12)
        self.run_tissue("part", *wave)
        for checkpoint in sorted((self.folder / "part/checkpoints").glob("*.h5"))[1:]:
            checkpoint.unlink()
        self.run_program("--resume", "part", "--quiet")
        for name in ("all_arrival", "all_current_i_I"):
            part, whole = (self.table(folder, f"profiles/{name}.csv").values
                           for folder in ("part", "whole"))
            numpy.testing.assert_array_equal(part, whole)

    def test_what_does_not_fit_is_said_at_once(self):
        process = self.run_tissue(
            "run", *runs.sets(Tissue__Shape="torus",
                              Electrophysiology__Ionic_model="Nagumo",
                              Electrophysiology__Start_of_the_line__Type="potential",
                              Electrophysiology__Initial_potential="0.3*x", **{
                                  "Tissue probe middle/Quantities": "gates",
                                  "Tissue line all/End": 0}), code=1)
        for part in ("the line is closed and has no end", "the ionic model has no gates",
                     "it is the start of the line, too", "Initial potential"):
            self.assertEqual(process.stderr.count(part), 1, process.stderr)
        process = self.run_tissue(
            "run", *runs.sets(Tissue__Motion__Radial_displacement="-0.02*t/1e-3"), code=2)
        self.assertIn("where it has to be positive; change", process.stderr)


if __name__ == "__main__":
    runs.main()
