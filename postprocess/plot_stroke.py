#!/usr/bin/env python3
"""The strokes of a swimming run: speed and distance, and for its last stroke the
vorticity with the body at some instants, the circulation of its vortices, and
space-time maps along the subumbrella. Figures 8 to 11 of Nitti et al. 2023
(10.1016/j.apm.2023.08.003)."""

import argparse
import csv
import pathlib
import re
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import ephyra_io
import vortices
from plot_run import plot_vorticity, read_bodies, save

SPEED = "centre of mass velocity y [m/s]"
PLACE = "centre of mass y [m]"
MAPS = [("potential", "v [mV]", 1e3, "viridis"), ("activation", r"$\gamma$ [-]", 1, "viridis"),
        ("radial_displacement", r"$u_1/2a_{ex}$ [-]", None, "RdBu_r"),
        ("pressure", "p [Pa]", 1, "RdBu_r")]


def pacing_period(folder):
    """Of the stimulus in parameters.prm, s, or None."""
    file = folder / "parameters.prm"
    found = file.exists() and re.search(r"set Pacing frequency = ([0-9.eE+-]+)( Hz)?\s*(#.*)?$",
                                        file.read_text(), re.M)
    return 1 / float(found[1]) if found and float(found[1]) > 0 else None


def plot_motion(stats, begin, end, target):
    """Figure 8: speed and distance over all strokes, and over the last one with
    the margin."""
    t, v, y = stats["time [s]"], 1e3 * stats[SPEED], 1e3 * stats[PLACE]
    figure, axes = plt.subplots(2, 2, figsize=(10, 5), sharex="col", layout="constrained",
                                width_ratios=[2, 1])
    last = (t >= begin) & (t <= end * (1 + 1e-9))
    for column, mask, offset, label in ((0, t >= 0, 0, "time [s]"),
                                        (1, last, begin, "time in the last stroke [s]")):
        axes[0, column].plot(t[mask] - offset, v[mask], lw=1)
        axes[1, column].plot(t[mask] - offset, y[mask] - y[mask][0], lw=1)
        axes[1, column].set_xlabel(label)
        for axis in axes[:, column]:
            axis.grid(alpha=0.3)
    axes[0, 0].set_ylabel("speed [mm/s]")
    axes[1, 0].set_ylabel("distance [mm]")
    margin = axes[1, 1].twinx()
    margin.plot(t[last] - begin, 1e3 * stats["margin radius [m]"][last], "C3--", lw=1)
    margin.set_ylabel("margin radius [mm]", color="C3")
    return save(figure, target / "stroke_motion.png")


def regions(folder, begin, end, level, gap):
    """The vortices of every output of the stroke: [(time, margin, vortices)]."""
    instants = []
    for time, path in ephyra_io.read_pvd(folder / "flow.pvd"):
        if begin * (1 - 1e-9) <= time <= end * (1 + 1e-9):
            body = read_bodies(folder, time)[0]
            points = body.points.reshape(-1, 2)
            instants.append((time, points[np.argmin(points[:, 1])],
                             vortices.vortices(ephyra_io.Flow(path), body, level, gap)))
    return instants


def follow(instants, sign, reach):
    """The strongest vortex of that sign within `reach` of the margin, followed
    from the instant of its largest circulation to both sides: the region that
    is nearest to its last place, no farther than half of `reach`; None where
    there is none."""
    groups = [[v for v in found if v["circulation"] * sign > 0] for _, _, found in instants]

    def distance(vortex, place):
        return np.hypot(vortex["r"] - place[0], vortex["y"] - place[1])

    near = [(abs(v["circulation"]), k, v) for k, group in enumerate(groups) for v in group
            if distance(v, instants[k][1]) < reach]
    path = [None] * len(instants)
    if not near:
        return path
    _, first, path[first] = max(near, key=lambda item: item[0])
    for step in (1, -1):
        last, k = path[first], first + step
        while 0 <= k < len(instants):
            def place(vortex):
                return distance(vortex, (last["r"], last["y"]))
            candidates = [v for v in groups[k] if place(v) < 0.5 * reach
                          and abs(v["circulation"]) > 0.2 * abs(last["circulation"])]
            if not candidates:
                break
            path[k] = last = min(candidates, key=place)
            k += step
    return path


def plot_circulation(folder, begin, end, level, gap, radius, target):
    """Figure 10, and circulation.csv with what it shows."""
    instants = regions(folder, begin, end, level, gap)
    if not instants:
        return None
    paths = {"starting": follow(instants, -1, radius), "stopping": follow(instants, 1, radius)}
    quantities = [("circulation", "circulation [m^2/s]"), ("r", "r [m]"), ("y", "y [m]"),
                  ("peak", "largest vorticity [1/s]")]
    with open(target / "circulation.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["time [s]"] + [f"{name} vortex {column}" for name in paths
                                        for _, column in quantities])
        for k, (time, _, _) in enumerate(instants):
            writer.writerow([time] + ["" if path[k] is None else path[k][key]
                                      for path in paths.values() for key, _ in quantities])
    figure, axis = plt.subplots(figsize=(6, 3.5), layout="constrained")
    times = np.array([time for time, _, _ in instants]) - begin
    for (name, path), colour in zip(paths.items(), ("C0", "C3")):
        strength = np.array([np.nan if v is None else 1e4 * abs(v["circulation"]) for v in path])
        axis.plot(times, strength, "o-", ms=3, color=colour, label=f"{name} vortex")
        if not np.all(np.isnan(strength)):
            k = np.nanargmax(strength)
            print(f"stroke: {name} vortex: {strength[k]:.3g} cm^2/s at {times[k]:.3g} s "
                  f"in the stroke, r = {1e3 * path[k]['r']:.3g} mm")
    axis.set_xlabel("time in the last stroke [s]")
    axis.set_ylabel(r"$|\Gamma|$ [cm$^2$/s]")
    axis.legend()
    axis.grid(alpha=0.3)
    return save(figure, target / "stroke_circulation.png")


def plot_maps(folder, begin, period, radius, target, stimulus=0.97):
    """Figure 11: along the subumbrella over the last stroke, with the place of
    the stimulus (red) and the begin of the stroke (dashed)."""
    maps = [(f, *rest) for f, *rest in MAPS if (folder / "profiles" / f"{f}.csv").exists()]
    if not maps:
        return None
    figure, axes = plt.subplots(len(maps), 1, figsize=(7, 2.2 * len(maps)), layout="constrained",
                                squeeze=False)
    for axis, (name, label, factor, colours) in zip(axes[:, 0], maps):
        table = ephyra_io.read_csv(folder / "profiles" / f"{name}.csv")
        columns = list(table)
        t = table[columns[0]] - begin
        mask = (t > -0.1 * period) & (t <= period * (1 + 1e-9))
        place = 1 - np.array([float(c) for c in columns[1:]])
        if np.sum(mask) < 2:
            print(f"stroke: {name} was not written in the last stroke")
            axis.set_axis_off()
            continue
        values = np.array([table[c][mask] for c in columns[1:]]) * (factor or 0.5 / radius)
        signed = colours == "RdBu_r"
        # The pressure of the contraction hides that of the passive stage.
        limit = np.nanpercentile(np.abs(values), 90 if name == "pressure" else 99.5) or 1
        image = axis.pcolormesh(t[mask], place, values, shading="nearest", rasterized=True,
                                cmap=colours,
                                **({"vmin": -limit, "vmax": limit} if signed else {}))
        figure.colorbar(image, ax=axis, label=label)
        axis.axvline(0, color="k", ls="--", lw=1)
        axis.axhline(1 - stimulus, color="r", lw=0.8)
        axis.set_ylabel(r"$1-\theta^1$")
    axes[-1, 0].set_xlabel("time in the last stroke [s]")
    return save(figure, target / "stroke_maps.png")


def print_recoil(folder, begin, period):
    """When the activation has ended, and when the bell is back: 5 % of their
    largest values in the last stroke."""
    ends = {}
    for name in ("activation", "radial_displacement"):
        path = folder / "profiles" / f"{name}.csv"
        if not path.exists():
            return
        table = ephyra_io.read_csv(path)
        columns = list(table)
        t = table[columns[0]] - begin
        mask = (t >= 0) & (t <= period * (1 + 1e-9))
        if np.sum(mask) < 2:
            return
        values = np.abs(np.array([table[c][mask] for c in columns[1:]])).max(axis=0)
        ends[name] = t[mask][np.flatnonzero(values > 0.05 * values.max())[-1]]
    print(f"stroke: activation below 5 % from {ends['activation']:.3g} s on, radial displacement "
          f"from {ends['radial_displacement']:.3g} s on")


def main(arguments):
    parser = argparse.ArgumentParser(prog="ephyra stroke", description=__doc__)
    parser.add_argument("folder", help="output folder of a run")
    parser.add_argument("--output", help="where the pictures go (default: FOLDER/pictures)")
    parser.add_argument("--period", type=float, help="of a stroke in s (default: of the pacing)")
    parser.add_argument("--instant", action="append", type=float, default=[],
                        help="of the vorticity, a fraction of the stroke; repeatable (default "
                        "0.1, 0.15, 0.2, 0.35, 0.75)")
    parser.add_argument("--level", type=float, default=5.0,
                        help="vorticity in 1/s at which a vortex ends (default 5)")
    parser.add_argument("--gap", type=float, default=0.05,
                        help="distance from the body, in radii of the bell, that does not belong "
                        "to a vortex (default 0.05)")
    options = parser.parse_args(arguments)
    folder = pathlib.Path(options.folder)
    if not (folder / "statistics.csv").exists():
        print(f"stroke: {folder} has no statistics.csv.", file=sys.stderr)
        return 1
    period = options.period or pacing_period(folder)
    if not period:
        print("stroke: the run is not paced; --period gives the period.", file=sys.stderr)
        return 1
    target = pathlib.Path(options.output) if options.output else folder / "pictures"
    target.mkdir(parents=True, exist_ok=True)
    stats = ephyra_io.read_csv(folder / "statistics.csv")
    missing = [name for name in (SPEED, PLACE, "widest radius [m]") if name not in stats]
    if missing or stats["time [s]"][-1] < period * (1 - 1e-6):
        print(f"stroke: {folder} is no whole stroke of a swimmer.", file=sys.stderr)
        return 1
    radius = stats["widest radius [m]"][0]
    end = period * np.floor(stats["time [s]"][-1] / period * (1 + 1e-6))
    begin = end - period
    plot_motion(stats, begin, end, target)
    plot_maps(folder, begin, period, radius, target)
    print_recoil(folder, begin, period)
    if (folder / "flow.pvd").exists():
        instants = options.instant or [0.1, 0.15, 0.2, 0.35, 0.75]
        plot_vorticity(folder, target, [begin + x * period for x in instants], 0, 3.0, None)
        plot_circulation(folder, begin, end, options.level, options.gap * radius, radius, target)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
