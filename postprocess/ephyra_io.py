"""Reads what a run of Ephyra writes: CSV tables, the flow, and the bodies."""

import csv
import pathlib
import re
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

TYPES = {"Float32": "<f4", "Float64": "<f8", "Int64": "<i8", "UInt8": "u1"}


def read_csv(path):
    """The columns of a table: {name: array}; texts become NaN."""
    def number(text):
        try:
            return float(text)
        except ValueError:
            return float("nan")

    with open(path, newline="", encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    rows = list(csv.reader(lines))
    header = [name.strip() for name in rows[0]]
    data = [[number(text) for text in row] for row in rows[1:] if len(row) == len(header)]
    columns = np.array(data, dtype=float).reshape(len(data), len(header)).T
    return dict(zip(header, columns))


def read_pvd(path):
    """The outputs of a series: [(time in s, file)]."""
    path = pathlib.Path(path)
    entries = ElementTree.parse(path).getroot().iter("DataSet")
    return [(float(e.get("timestep")), path.parent / e.get("file")) for e in entries]


class VtkFile:
    """One of our VTK XML files: its elements and its appended arrays."""

    def __init__(self, path):
        content = pathlib.Path(path).read_bytes()
        marker = content.find(b"<AppendedData")
        self.data = content[content.find(b"_", marker) + 1:] if marker >= 0 else b""
        head = content if marker < 0 else content[:marker] + b"</VTKFile>"
        self.root = ElementTree.fromstring(head)

    def array(self, element):
        """The array that a DataArray element names; (n, components) or (n,)."""
        start = int(element.get("offset"))
        n_blocks, size, last = np.frombuffer(self.data, "<u8", 3, start)
        sizes = np.frombuffer(self.data, "<u8", int(n_blocks), start + 24)
        at = start + 24 + 8 * int(n_blocks)
        parts = []
        for compressed in sizes:
            parts.append(zlib.decompress(self.data[at:at + int(compressed)]))
            at += int(compressed)
        values = np.frombuffer(b"".join(parts), TYPES[element.get("type")])
        n_components = int(element.get("NumberOfComponents", 1))
        return values.reshape(-1, n_components) if n_components > 1 else values

    def arrays(self, parent):
        """All arrays below the first element of that name: {name: array}."""
        return {e.get("Name"): self.array(e) for e in self.root.find(f".//{parent}")}


class Flow:
    """The flow of one output: faces in m, and cell fields of shape
    (n_r, n_y) or (n_r, n_y, 3), by their names with units."""

    def __init__(self, path):
        path = pathlib.Path(path)
        self.fields = {}
        pieces = []
        for element in ElementTree.parse(path).getroot().iter("Piece"):
            file = VtkFile(path.parent / element.get("Source"))
            i0, i1, _, n_y = [int(x) for x in element.get("Extent").split()[:4]]
            pieces.append((i0, i1, n_y, file))
        pieces.sort(key=lambda piece: piece[0])
        r = []
        for i0, i1, n_y, file in pieces:
            coordinates = file.arrays("Coordinates")
            r.append(coordinates["r [m]"][0 if i0 == 0 else 1:])
            self.y_faces = coordinates["y [m]"]
            for name, values in file.arrays("CellData").items():
                shaped = values.reshape(n_y, i1 - i0, *values.shape[1:]).swapaxes(0, 1)
                self.fields.setdefault(name, []).append(shaped)
        self.r_faces = np.concatenate(r)
        self.fields = {name: np.concatenate(parts) for name, parts in self.fields.items()}


def bernstein(degree, s):
    """Bernstein polynomials at the points s: shape (len(s), degree + 1)."""
    values = np.ones((len(s), 1))
    for _ in range(degree):
        left = np.pad(values * (1 - s)[:, None], ((0, 0), (0, 1)))
        right = np.pad(values * s[:, None], ((0, 0), (1, 0)))
        values = left + right
    return values


class Body:
    """A body of one output as rational Bezier cells.

    `points` (n_cells, q + 1, p + 1, 2), `weights` (n_cells, q + 1, p + 1), and
    point fields of the shape of `weights`; q = 0 for a curve."""

    def __init__(self, path):
        file = VtkFile(path)
        data = file.arrays("PointData")
        degrees = file.arrays("CellData")["HigherOrderDegrees"]
        self.degree = (int(degrees[0, 0]), int(degrees[0, 1]))
        p, q = self.degree
        # Our files number the points of a cell lexicographically; the order of
        # VTK is in the connectivity alone.
        shape = (-1, q + 1, p + 1)
        self.points = file.arrays("Points")["Points"][:, :2].reshape(*shape, 2)
        self.weights = data.pop("RationalWeights").reshape(shape)
        self.fields = {name: values.reshape(*shape, *values.shape[1:])
                       for name, values in data.items()}

    def evaluate(self, values, s, t):
        """Rational interpolation of control values at (s, t) of every cell;
        s and t are arrays of equal length; shape (n_cells, len(s), ...)."""
        basis = bernstein(self.degree[1], t)[:, :, None] * bernstein(self.degree[0], s)[:, None]
        weighted = np.einsum("kji,cji->ckji", basis, self.weights)
        total = weighted.sum(axis=(2, 3))
        result = np.einsum("ckji,cji...->ck...", weighted, values)
        return result / total.reshape(total.shape + (1,) * (result.ndim - 2))

    def cell_outlines(self, n=9):
        """Closed polygons (r, y) around the cells: (n_cells, 4 n, 2)."""
        a, zero, one = np.linspace(0, 1, n), np.zeros(n), np.ones(n)
        s = np.concatenate([a, one, a[::-1], zero])
        t = np.concatenate([zero, a, one, a[::-1]])
        return self.evaluate(self.points, s, t)


class Points:
    """Tracers of one output: `r` and `y` in m, and fields by their names."""

    def __init__(self, path):
        file = VtkFile(path)
        points = file.arrays("Points")["Points"].reshape(-1, 3)
        self.r, self.y = points[:, 0], points[:, 1]
        self.fields = file.arrays("PointData")


def field_named(fields, *words):
    """The first field whose name starts with one of the words, or None."""
    for word in words:
        for name in fields:
            if re.match(word, name):
                return name
    return None
