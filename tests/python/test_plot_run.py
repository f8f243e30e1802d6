"""Reading our VTK files, and the pictures of a run."""

import contextlib
import io
import pathlib
import struct
import sys
import tempfile
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))
try:
    import numpy as np

    import ephyra_io
    import plot_run
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)  # CTest: skipped


def vtk_file(path, kind, attributes, body, arrays):
    """Writes a file as source/io/vtk_xml.cc does; {name} in body is an array."""
    appended, elements = b"", {}
    for name, (vtk_type, n_components, values) in arrays.items():
        raw = np.asarray(values, ephyra_io.TYPES[vtk_type]).tobytes()
        elements[name] = (f'<DataArray type="{vtk_type}" Name="{name}" NumberOfComponents='
                          f'"{n_components}" format="appended" offset="{len(appended)}"/>')
        blocks = [zlib.compress(raw[k:k + 64]) for k in range(0, len(raw), 64)]
        appended += struct.pack(f"<{3 + len(blocks)}Q", len(blocks), 64, len(raw) % 64,
                                *[len(block) for block in blocks]) + b"".join(blocks)
    for name, element in elements.items():
        body = body.replace("{" + name + "}", element)
    text = (f'<?xml version="1.0"?>\n<VTKFile type="{kind}"><{kind}{attributes}>{body}</{kind}>'
            '<AppendedData encoding="raw">\n_')
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text.encode() + appended + b"\n</AppendedData></VTKFile>")


def write_run(folder):
    """A small run: two ranks, two outputs, a quarter annulus as the body."""
    (folder / "statistics.csv").write_text(
        "time [s],centre of mass y [m],centre of mass velocity y [m/s]\n"
        "0,1,0\n0.5,1.1,0.2\n1,1.3,0.4\n")
    (folder / "profiles").mkdir()
    (folder / "profiles" / "activation.csv").write_text(
        "time [s],0,0.5,1\n0,0,0,0\n0.5,0,0.2,0.4\n1,0,0.3,0.9\n")
    r, y = np.array([0, 1, 2, 4.0]), np.array([-1, 0, 3.0])
    vorticity = np.array([[1, 2], [3, 4], [5, 6.0]])
    for rank, (i0, i1) in enumerate([(0, 2), (2, 3)]):
        vtk_file(folder / f"flow/flow_000000_{rank}.vtr", "RectilinearGrid", "",
                 "<Piece><CellData>{vorticity [1/s]}</CellData><Coordinates>{r [m]}{y [m]}"
                 "</Coordinates></Piece>",
                 {"vorticity [1/s]": ("Float32", 1, vorticity[i0:i1].T),
                  "r [m]": ("Float64", 1, r[i0:i1 + 1]), "y [m]": ("Float64", 1, y)})
    (folder / "flow/flow_000000.pvtr").write_text(
        '<VTKFile><PRectilinearGrid><Piece Extent="2 3 0 2 0 0" Source="flow_000000_1.vtr"/>'
        '<Piece Extent="0 2 0 2 0 0" Source="flow_000000_0.vtr"/></PRectilinearGrid></VTKFile>')
    w = 0.5**0.5
    points = [[1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]
    vtk_file(folder / "bell/bell_000000.vtu", "UnstructuredGrid", "",
             "<Piece><PointData>{RationalWeights}{x [m]}</PointData><CellData>{HigherOrderDegrees}"
             "</CellData><Points>{Points}</Points></Piece>",
             {"RationalWeights": ("Float64", 1, [1, w, 1, 1, w, 1]),
              "x [m]": ("Float32", 1, [p[0] for p in points]),
              "HigherOrderDegrees": ("Float64", 3, [2, 1, 0]),
              "Points": ("Float64", 3, points)})
    for name, file in (("flow", "flow_000000.pvtr"), ("bell", "bell_000000.vtu")):
        (folder / f"{name}.pvd").write_text(
            f'<VTKFile type="Collection"><Collection><DataSet timestep="0.5" part="0" '
            f'file="{name}/{file}"/></Collection></VTKFile>')
    return vorticity


class PlotRun(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def test_flow_is_put_together(self):
        vorticity = write_run(self.folder)
        (time, path), = ephyra_io.read_pvd(self.folder / "flow.pvd")
        flow = ephyra_io.Flow(path)
        self.assertEqual(time, 0.5)
        np.testing.assert_array_equal(flow.r_faces, [0, 1, 2, 4])
        np.testing.assert_array_equal(flow.y_faces, [-1, 0, 3])
        np.testing.assert_array_equal(flow.fields["vorticity [1/s]"], vorticity)

    def test_arcs_are_exact(self):
        write_run(self.folder)
        body = ephyra_io.Body(self.folder / "bell/bell_000000.vtu")
        s = np.linspace(0, 1, 7)
        for t, radius in ((0.0, 1.0), (0.5, 1.5), (1.0, 2.0)):
            points = body.evaluate(body.points, s, np.full(7, t))[0]
            np.testing.assert_allclose(np.hypot(*points.T), radius, rtol=1e-14)
            x = body.evaluate(body.fields["x [m]"], s, np.full(7, t))[0]
            np.testing.assert_allclose(x, points[:, 0], atol=1e-6)
        outline = body.cell_outlines()
        self.assertAlmostEqual(outline[..., 0].min(), 0)
        self.assertAlmostEqual(outline[..., 1].max(), 2)

    def test_pictures(self):
        write_run(self.folder)
        other = self.folder / "other.csv"
        other.write_text("# measured\nt,v\n0,0\n1,0.5\n")
        with contextlib.redirect_stdout(io.StringIO()):
            code = plot_run.main([str(self.folder), "--overlay",
                                  f"{other}; t; v; centre of mass velocity y [m/s]"])
        self.assertEqual(code, 0)
        for name in ("motion", "space_time", "vorticity"):
            picture = self.folder / "pictures" / f"{name}.png"
            self.assertGreater(picture.stat().st_size, 5000)

    def test_overlays_are_scaled_and_shifted(self):
        file = self.folder / "other.csv"
        file.write_text("t + 1,v [cm/s]\n0,1\n1,3\n")
        for x, y, expected in (("t + 1", "v [cm/s]", [0, 1, 1, 3]),
                               ("t + 1 - 0.5", "v [cm/s] * 1e-2", [-0.5, 0.5, 0.01, 0.03]),
                               ("t + 1 * 2 + 1", "v [cm/s] * -2", [1, 3, -2, -6])):
            overlay = plot_run.parse_overlay(f"{file}; {x}; {y}; speed")
            np.testing.assert_allclose([*overlay["x"], *overlay["y"]], expected)
        for wrong in ("u", "v", "v [cm/s] * x"):
            with self.assertRaisesRegex(SystemExit, "has no column"):
                plot_run.parse_overlay(f"{file}; t + 1; {wrong}; speed")

    def test_nothing_to_draw(self):
        with contextlib.redirect_stderr(io.StringIO()) as screen:
            self.assertEqual(plot_run.main([str(self.folder)]), 1)
            self.assertEqual(plot_run.main([str(self.folder / "missing")]), 1)
        self.assertIn("nothing to draw", screen.getvalue())


if __name__ == "__main__":
    unittest.main()
