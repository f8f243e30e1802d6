"""Circulation of the vortices that a swimmer sheds: connected regions of
vorticity of one sign above a level, away from the body."""

import numpy as np

import ephyra_io


def labels(mask):
    """Numbers from 1 of the connected regions (edge neighbours) of a mask."""
    result = np.zeros(mask.shape, dtype=int)
    n = 0
    for seed in zip(*np.nonzero(mask)):
        if result[seed]:
            continue
        n += 1
        result[seed] = n
        stack = [seed]
        while stack:
            i, j = stack.pop()
            for a, b in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                if (0 <= a < mask.shape[0] and 0 <= b < mask.shape[1] and mask[a, b]
                        and not result[a, b]):
                    result[a, b] = n
                    stack.append((a, b))
    return result


def distance_to(points, r, y, largest):
    """Distance of the cell centres from a cloud of points, where it is smaller
    than `largest`; infinite elsewhere."""
    distance = np.full((len(r), len(y)), np.inf)
    for p in points:
        i0, i1 = np.searchsorted(r, [p[0] - largest, p[0] + largest])
        j0, j1 = np.searchsorted(y, [p[1] - largest, p[1] + largest])
        block = np.hypot(r[i0:i1, None] - p[0], y[None, j0:j1] - p[1])
        distance[i0:i1, j0:j1] = np.minimum(distance[i0:i1, j0:j1], block)
    return distance


def body_points(body, spacing):
    """Points that fill the cells of a body no farther apart than `spacing`."""
    size = np.max(np.ptp(body.points.reshape(len(body.points), -1, 2), axis=1))
    a = np.linspace(0, 1, max(2, int(np.ceil(size / spacing)) + 1))
    s, t = (x.ravel() for x in np.meshgrid(a, a))
    return body.evaluate(body.points, s, t).reshape(-1, 2)


def vortices(flow, body, level, gap):
    """The regions of |vorticity| > `level` (1/s) farther than `gap` (m) from the
    body: a list of {circulation [m^2/s], r, y [m]: its centre, peak [1/s]}."""
    name = ephyra_io.field_named(flow.fields, "vorticity")
    omega = flow.fields[name]
    r = 0.5 * (flow.r_faces[1:] + flow.r_faces[:-1])
    y = 0.5 * (flow.y_faces[1:] + flow.y_faces[:-1])
    area = np.diff(flow.r_faces)[:, None] * np.diff(flow.y_faces)[None, :]
    spacing = 0.7 * np.min(np.diff(flow.r_faces))
    free = distance_to(body_points(body, spacing), r, y, gap) > gap
    found = []
    for sign in (-1, 1):
        label = labels(free & (sign * omega > level))
        for k in range(1, label.max() + 1):
            i, j = np.nonzero(label == k)
            share = omega[i, j] * area[i, j]
            circulation = np.sum(share)
            found.append({"circulation": circulation, "peak": sign * np.max(sign * omega[i, j]),
                          "r": np.sum(share * r[i]) / circulation,
                          "y": np.sum(share * y[j]) / circulation, "cells": len(i)})
    return found
