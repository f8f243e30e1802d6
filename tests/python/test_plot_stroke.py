"""Vortices of a stroke: their circulation and their way."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))
try:
    import numpy as np

    import ephyra_io
    import plot_stroke
    import vortices
    from test_plot_run import write_run
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)  # CTest: skipped


class FakeFlow:
    """Gaussian vortices (circulation, r, y, radius) on a uniform grid."""

    def __init__(self, gaussians, n=300):
        self.r_faces, self.y_faces = np.linspace(0, 6, n + 1), np.linspace(-6, 6, 2 * n + 1)
        r = 0.5 * (self.r_faces[1:] + self.r_faces[:-1])[:, None]
        y = 0.5 * (self.y_faces[1:] + self.y_faces[:-1])[None, :]
        self.fields = {"vorticity [1/s]": sum(
            g / (np.pi * a**2) * np.exp(-((r - r0)**2 + (y - y0)**2) / a**2)
            for g, r0, y0, a in gaussians)}


class Vortices(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        write_run(self.folder)
        self.body = ephyra_io.Body(self.folder / "bell/bell_000000.vtu")

    def test_circulation_above_a_level(self):
        # Of a Gaussian vortex with the peak w the circulation above L is
        # G (1 - L / w).
        flow = FakeFlow([(-3.0, 2.0, -3.0, 0.4), (5.0, 4.0, 3.0, 0.5), (9.0, 1.4, 1.2, 0.2)])
        found = vortices.vortices(flow, self.body, level=0.5, gap=0.6)
        self.assertEqual(len(found), 2)  # the third is inside of the body
        for vortex, (g, r, y, a) in zip(found, [(-3.0, 2.0, -3.0, 0.4), (5.0, 4.0, 3.0, 0.5)]):
            peak = abs(g) / (np.pi * a**2)
            self.assertAlmostEqual(vortex["circulation"] / (g * (1 - 0.5 / peak)), 1, delta=2e-3)
            self.assertAlmostEqual(vortex["r"], r, delta=1e-3)
            self.assertAlmostEqual(vortex["y"], y, delta=1e-3)

    def test_what_is_near_the_body_does_not_count(self):
        flow = FakeFlow([(1.0, 2.0, 2.0, 1.0)])
        level, gap = 0.02, 0.3
        (vortex,) = vortices.vortices(flow, self.body, level, gap)
        r, y = np.meshgrid(0.01 + 0.02 * np.arange(300), -5.99 + 0.02 * np.arange(600),
                           indexing="ij")
        # The distance from the quarter annulus 1 < r < 2 in the first quadrant.
        outside = np.where(r * y > 0, np.maximum(np.hypot(r, y) - 2, 1 - np.hypot(r, y)),
                           np.hypot(r - np.clip(r, 1, 2), y))
        omega = flow.fields["vorticity [1/s]"]
        counted = np.sum(omega[(outside > gap) & (omega > level)]) * 0.02**2
        self.assertAlmostEqual(vortex["circulation"] / counted, 1, delta=0.02)

    def test_following(self):
        # The vortex of the stroke leaves the margin; one of the stroke before
        # is stronger, but elsewhere.
        def vortex(circulation, r, y):
            return {"circulation": circulation, "r": r, "y": y, "peak": 1.0}
        instants = [(0.1 * k, (1.0, 0.0), [vortex(9.0, 0.5, -4.0 - 0.1 * k),
                                           vortex(-3.0, 1.0, -0.3 * k),
                                           vortex(5.0 - abs(k - 3), 1.0 - 0.1 * k, -0.2 * k)])
                    for k in range(8)]
        path = plot_stroke.follow(instants, 1, 1.0)
        self.assertEqual([v["circulation"] for v in path], [2, 3, 4, 5, 4, 3, 2, 1])
        path = plot_stroke.follow(instants, -1, 1.0)
        self.assertTrue(all(v["circulation"] == -3 for v in path))

    def test_not_a_swimmer(self):
        (self.folder / "parameters.prm").write_text("set Pacing frequency = 0 Hz\n")
        with contextlib.redirect_stderr(io.StringIO()) as screen:
            self.assertEqual(plot_stroke.main([str(self.folder)]), 1)
            self.assertEqual(plot_stroke.main([str(self.folder), "--period", "1"]), 1)
        self.assertIn("--period gives the period", screen.getvalue())
        self.assertIn("no whole stroke", screen.getvalue())


if __name__ == "__main__":
    unittest.main()
