#!/usr/bin/env python3
"""Turns the output folder of a run into pictures: the motion of the animal,
space-time maps of the profiles, and the vorticity with the body."""

import argparse
import pathlib
import re
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection

import ephyra_io

# What is drawn of statistics.csv where it is there.
MOTION = ["centre of mass velocity y [m/s]", "centre of mass y [m]", "margin radius [m]"]
FIRST_PROFILES = ["potential", "activation", "radial_displacement", "pressure"]
PROFILE_UNITS = {"potential": "V", "activation": "-", "displacement": "m", "pressure": "Pa"}


def find_column(columns, name):
    """The column of that name, or the first that ends with it."""
    if name in columns:
        return name
    return next((c for c in columns if c.endswith(name)), None)


def scaled_column(table, text, file):
    """The column "NAME", "NAME * FACTOR", "NAME + SHIFT" or "NAME * FACTOR + SHIFT"."""
    number = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)"
    match = re.fullmatch(rf"(.*?)(?:\s*\*\s*{number})?(?:\s+([-+])\s*{number})?", text)
    name, factor, sign, shift = (text, 1, "+", 0) if text in table else match.groups()
    if name not in table:
        raise SystemExit(f"plot: {file} has no column '{name}', but {', '.join(table)}.")
    return table[name] * float(factor or 1) + float(f"{sign or '+'}{shift or 0}")


def parse_overlay(text):
    """FILE[; x column; y column; column of the run]: x, y, where to draw it."""
    parts = [part.strip() for part in text.split(";")]
    table = ephyra_io.read_csv(parts[0])
    names = list(table)
    x = parts[1] if len(parts) > 1 else names[0]
    y = parts[2] if len(parts) > 2 else names[1]
    return {"x": scaled_column(table, x, parts[0]), "y": scaled_column(table, y, parts[0]),
            "column": parts[3] if len(parts) > 3 else y, "label": pathlib.Path(parts[0]).stem}


def plot_motion(folder, target, extra, overlays, span):
    """Curves of statistics.csv over time, or a span of it, one below the other."""
    table = ephyra_io.read_csv(folder / "statistics.csv")
    if "height [m]" in table:
        table["fineness [-]"] = table["height [m]"] / (2 * table["widest radius [m]"])
    time = find_column(table, "time [s]")
    if span:
        inside = (table[time] >= span[0]) & (table[time] <= span[1])
        table = {name: values[inside] for name, values in table.items()}
    wanted = [find_column(table, name) for name in MOTION + extra]
    wanted = list(dict.fromkeys(name for name in wanted if name))
    if not wanted:
        return None
    figure, axes = plt.subplots(len(wanted), 1, sharex=True, squeeze=False,
                                figsize=(7, 2.2 * len(wanted)), layout="constrained")
    for axis, name in zip(axes[:, 0], wanted):
        y = table[name]
        shown = name
        if name.endswith("centre of mass y [m]"):
            y, shown = y - y[0], "distance [m]"
        axis.plot(table[time], y, label="run")
        for overlay in overlays:
            if find_column([name], overlay["column"]):
                axis.plot(overlay["x"], overlay["y"], "--", label=overlay["label"])
                axis.legend()
        axis.set_ylabel(shown.replace("centre of mass ", ""))
        axis.grid(alpha=0.3)
    axes[-1, 0].set_xlabel("time [s]")
    if span:
        axes[-1, 0].set_xlim(*span)
    return save(figure, target / "motion.png")


def first_wave(time, values):
    """From the start to shortly after the first wave has passed: a wave takes
    milliseconds and would be a line in a picture of seconds."""
    spread = np.nanmax(values, axis=0) - np.nanmin(values, axis=0)
    excited = spread > 0.2 * np.max(spread)
    if not np.any(excited):
        return time[0], time[-1]
    begin = np.argmax(excited)
    quiet = np.flatnonzero(~excited[begin:])
    end = begin + quiet[0] if len(quiet) else len(time) - 1
    return time[0], min(time[-1], 1.3 * time[end])


def plot_profiles(folder, target):
    """Space-time maps: time along x, the position on the body along y."""
    files = {path.stem: path for path in sorted((folder / "profiles").glob("*.csv"))}
    names = sorted(files, key=lambda n: (FIRST_PROFILES.index(n) if n in FIRST_PROFILES
                                         else len(FIRST_PROFILES), n))
    maps = []
    for name in names:
        table = ephyra_io.read_csv(files[name])
        columns = list(table)
        try:
            position = np.array([float(column) for column in columns[1:]])
        except ValueError:
            print(f"plot: {files[name]} is no profile (its columns are not positions)")
            continue
        if len(position) > 1 and len(table[columns[0]]) > 1:
            maps.append((name, table[columns[0]], position,
                         np.array([table[c] for c in columns[1:]])))
    if not maps:
        return None
    figure, axes = plt.subplots(len(maps), 1, squeeze=False,
                                figsize=(7, 2.4 * len(maps)), layout="constrained")
    for axis, (name, time, position, values) in zip(axes[:, 0], maps):
        signed = np.nanmin(values) < 0 < np.nanmax(values) and name != "potential"
        limit = np.nanmax(np.abs(values)) or 1.0
        image = axis.pcolormesh(time, position, values, shading="nearest", rasterized=True,
                                cmap="RdBu_r" if signed else "viridis",
                                **({"vmin": -limit, "vmax": limit} if signed else {}))
        unit = next((u for word, u in PROFILE_UNITS.items() if word in name), None)
        figure.colorbar(image, ax=axis, label=unit)
        axis.set_title(name.replace("_", " "), fontsize="medium")
        axis.set_ylabel(r"$\theta^1$")
        if name == "potential":
            axis.set_xlim(*first_wave(time, values))
    axes[-1, 0].set_xlabel("time [s]")
    return save(figure, target / "space_time.png")


def read_bodies(folder, time):
    """The bodies at the output next to a time: two-dimensional ones."""
    bodies = []
    for series in sorted(folder.glob("*.pvd")):
        entries = ephyra_io.read_pvd(series)
        if not entries or entries[0][1].suffix != ".vtu":
            continue
        body = ephyra_io.Body(min(entries, key=lambda e: abs(e[0] - time))[1])
        if body.degree[1] > 0:
            bodies.append(body)
    return bodies


def draw_snapshot(axis, flow, name, bodies, scale, window):
    values = flow.fields[name]
    r, y = flow.r_faces, flow.y_faces
    for side in (1, -1):  # the left half mirrors the right one, with its sign
        image = axis.pcolormesh(side * r, y, side * values.T, cmap="RdBu_r",
                                vmin=-scale, vmax=scale, rasterized=True)
        for body in bodies:
            polygons = body.cell_outlines() * np.array([side, 1])
            axis.add_collection(PolyCollection(polygons, facecolor="0.35", edgecolor="0.35", linewidth=0.3))
    axis.set_xlim(-window[0], window[0])
    axis.set_ylim(window[1], window[2])
    axis.set_aspect("equal")
    return image


def view(flows, bodies, width):
    """Half width, bottom and top of the pictures: around all bodies, in all of
    the snapshots, so that they can be compared. The flow may move along y."""
    r_max = flows[0].r_faces[-1]
    bottom = min(flow.y_faces[0] for flow in flows)
    top = max(flow.y_faces[-1] for flow in flows)
    if not bodies or width <= 0:
        return r_max, bottom, top
    points = np.concatenate([body.points.reshape(-1, 2) for body in bodies])
    size = width * np.max(points[:, 0])
    return (min(size / 1.5, r_max), max(np.min(points[:, 1]) - size / 2, bottom),
            min(np.max(points[:, 1]) + size / 4, top))


def plot_vorticity(folder, target, times, n_snapshots, width, window):
    series = folder / "flow.pvd"
    if not series.exists():
        return None
    entries = ephyra_io.read_pvd(series)
    if times:
        chosen = [min(entries, key=lambda e: abs(e[0] - t)) for t in times]
    else:
        picks = np.linspace(0, len(entries) - 1, min(n_snapshots, len(entries)))
        chosen = [entries[round(k)] for k in picks]
    flows = [ephyra_io.Flow(path) for _, path in chosen]
    name = ephyra_io.field_named(flows[0].fields, "vorticity")
    if name is None:
        print("plot: the flow was written without its vorticity")
        return None
    scale = np.percentile(np.abs(np.concatenate([f.fields[name].ravel() for f in flows])),
                          99.7) or 1.0
    bodies = [read_bodies(folder, time) for time, _ in chosen]
    window = window or view(flows, [body for group in bodies for body in group], width)
    height = 3.0 * (window[2] - window[1]) / (2 * window[0])
    figure, axes = plt.subplots(1, len(chosen), squeeze=False, sharey=True,
                                figsize=(3.0 * len(chosen) + 1, height + 1),
                                layout="constrained")
    for axis, (time, _), flow, group in zip(axes[0], chosen, flows, bodies):
        image = draw_snapshot(axis, flow, name, group, scale, window)
        axis.set_title(f"t = {time:.4g} s", fontsize="medium")
        axis.set_xlabel("r [m]")
    axes[0, 0].set_ylabel("y [m]")
    figure.colorbar(image, ax=axes[0].tolist(), label=name, shrink=0.7)
    return save(figure, target / "vorticity.png")


def save(figure, path):
    figure.savefig(path, dpi=150)
    plt.close(figure)
    print(f"plot: {path}")
    return path


def main(arguments):
    parser = argparse.ArgumentParser(prog="ephyra plot", description=__doc__)
    parser.add_argument("folder", help="output folder of a run")
    parser.add_argument("--output", help="where the pictures go (default: FOLDER/pictures)")
    parser.add_argument("--column", action="append", default=[],
                        help="a further column of statistics.csv to draw, or \"fineness [-]\", height "
                        "over widest diameter; repeatable")
    parser.add_argument("--span", type=float, nargs=2, metavar=("T0", "T1"),
                        help="of the curves, in s (default: the whole run)")
    parser.add_argument("--overlay", action="append", default=[],
                        metavar='"FILE; x; y; COLUMN"',
                        help="a CSV file to lay over the curve of a column of the run; its x "
                        "and y columns are the first two unless named, and may be scaled and "
                        'shifted, as in "speed [cm/s] * 0.01" or "time [s] - 0.1"; repeatable')
    parser.add_argument("--time", action="append", type=float, default=[],
                        help="time in s of a snapshot; repeatable")
    parser.add_argument("--snapshots", type=int, default=4,
                        help="number of snapshots where no time is given (default 4)")
    parser.add_argument("--width", type=float, default=3.0,
                        help="size of the snapshots in radii of the body; 0: the whole flow "
                        "(default 3)")
    parser.add_argument("--window", type=float, nargs=3, metavar=("R", "Y0", "Y1"),
                        help="largest r, smallest and largest y of the snapshots in m, instead "
                        "of --width")
    options = parser.parse_args(arguments)
    folder = pathlib.Path(options.folder)
    if not folder.is_dir():
        print(f"plot: the folder {folder} does not exist.", file=sys.stderr)
        return 1
    target = pathlib.Path(options.output) if options.output else folder / "pictures"
    target.mkdir(parents=True, exist_ok=True)
    overlays = [parse_overlay(text) for text in options.overlay]
    pictures = []
    if (folder / "statistics.csv").exists():
        pictures.append(plot_motion(folder, target, options.column, overlays,
                                    options.span))
    pictures.append(plot_profiles(folder, target))
    pictures.append(plot_vorticity(folder, target, options.time, options.snapshots,
                                   options.width, options.window))
    if not any(pictures):
        print(f"plot: nothing to draw in {folder}: no statistics.csv, profiles/ or flow.pvd.",
              file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
