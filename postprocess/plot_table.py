#!/usr/bin/env python3
"""Draws the table of a sweep: error against work, both logarithmic, one line for
each series. Series named "GROUP: LABEL" share a panel for each group. Full marks
are values too large, open ones values too small.

With --by any columns over any other, both linear: one line for each value of the
column --by names, one panel for each column of --y.

With --map which cases came to their end, a panel for each series: a full mark where the
exit code is 0, a cross where not, over the columns of --x and --y, both logarithmic. The
values of --by lie side by side in the order of the table. --line "NAME = FORMULA in x"
adds a curve."""

import argparse
import csv
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullFormatter

MARKERS = "osD^vP*Xh<>d"


class Wrong(Exception):
    """What the user has to change."""


def read_table(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    except FileNotFoundError:
        raise Wrong(f"the file {path} does not exist") from None
    if not rows:
        raise Wrong(f"{path} has no rows")
    return rows


def find_columns(rows, wanted, kind):
    """The columns of those names or, where a text is no name, that hold it."""
    names = list(rows[0])
    found = [n for n in names if any(n == text or (text not in names and text in n)
                                     for text in wanted)]
    if not found:
        raise Wrong(f"no column for {kind} holds '{', '.join(wanted)}'; there are "
                    f"{', '.join(names)}")
    return found


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


def curves(rows, x, y):
    """{group: {label: [(x, y)]}} in the order of the table; gaps left out."""
    groups = {}
    for row in rows:
        group, colon, label = row.get("series", "").partition(": ")
        if not colon:
            group, label = "", group
        points = groups.setdefault(group, {}).setdefault(label, [])
        at, value = number(row[x]), number(row[y])
        if at > 0 and math.isfinite(value) and value != 0:
            points.append((at, value))
    return groups


def family(rows, x, y, by):
    """{value of the column by: [(x, y)]}, in the order of the table; a case that is in
    several series counts once."""
    lines = {}
    for row in rows:
        points = lines.setdefault(row[by], [])
        point = (number(row[x]), number(row[y]))
        if all(map(math.isfinite, point)) and point not in points:
            points.append(point)
    return {value: sorted(points) for value, points in lines.items()}


def short(column):
    """The entry of a column like Section/Subsection/Entry."""
    return column.split("/")[-1] if "[" not in column else column


def draw_family(axis, lines, by):
    for k, (value, points) in enumerate(lines.items()):
        axis.plot([p[0] for p in points], [p[1] for p in points], color=f"C{k % 10}",
                  marker=MARKERS[k % len(MARKERS)], markersize=5, linewidth=1,
                  label=f"{short(by)} = {value}")
    axis.grid(alpha=0.3)


def plot_families(rows, x, columns, by, path):
    """A panel for each column."""
    n_columns = 2 if len(columns) in (2, 4) else min(3, len(columns))
    n_rows = math.ceil(len(columns) / n_columns)
    figure, axes = plt.subplots(n_rows, n_columns, squeeze=False, layout="constrained",
                                figsize=(0.5 + 4.3 * n_columns, 0.5 + 3.3 * n_rows))
    for axis, y in zip(axes.flat, columns):
        draw_family(axis, family(rows, x, y, by), by)
        axis.set_xlabel(short(x))
        axis.set_ylabel(y, fontsize="small")
    figure.legend(*axes.flat[0].get_legend_handles_labels(), loc="upper center",
                  bbox_to_anchor=(0.5, 0), ncol=4, fontsize="small", frameon=False)
    for axis in axes.flat[len(columns):]:
        axis.set_visible(False)
    figure.savefig(path, dpi=100, bbox_inches="tight")
    plt.close(figure)
    print(f"plot: {path}")


def outcomes(rows, x, y, by):
    """{series: [(x, y, place of the value of by, finished)]}; the values of by."""
    values = list(dict.fromkeys(row[by] for row in rows))
    maps = {}
    for row in rows:
        maps.setdefault(row.get("series", ""), []).append(
            (number(row[x]), number(row[y]), values.index(row[by]),
             number(row["exit code"]) == 0))
    return maps, values


def bound(text, x):
    """Name and values of "NAME = FORMULA in x"."""
    name, equals, formula = text.partition("=")
    if not equals:
        raise Wrong(f"--line '{text}' is not of the form NAME = FORMULA")
    try:
        return name.strip(), [float(eval(formula, {"__builtins__": {}}, {"x": at}))
                              for at in x]
    except Exception as error:  # whatever a formula can do wrong
        raise Wrong(f"--line '{text}': {error}") from None


def plot_map(rows, x, y, by, lines, path):
    maps, values = outcomes(rows, x, y, by)
    n_columns = 2 if len(maps) in (2, 4) else min(3, len(maps))
    n_rows = math.ceil(len(maps) / n_columns)
    figure, axes = plt.subplots(n_rows, n_columns, squeeze=False, sharex=True, sharey=True,
                                layout="constrained",
                                figsize=(0.5 + 4.3 * n_columns, 0.8 + 3 * n_rows))
    places = sorted({point[0] for points in maps.values() for point in points})
    heights = sorted({point[1] for points in maps.values() for point in points})
    ends = places[0] / 1.6, places[-1] * 1.6
    for axis, (name, points) in zip(axes.flat, maps.items()):
        for at, value, k, finished in points:
            shift = 1.22 ** (k - (len(values) - 1) / 2)
            axis.plot(at * shift, value, "o" if finished else "x", color=f"C{k % 10}",
                      markersize=7, markeredgewidth=2)
        for text in lines:
            label, heights_of_line = bound(text, ends)
            axis.plot(ends, heights_of_line, "k--", linewidth=1, label=label)
        axis.set_title(name, fontsize="medium")
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_ylim(heights[0] / 1.5, heights[-1] * 1.5)
        axis.set_yticks(heights, [f"{value:g}" for value in heights])
        axis.minorticks_off()
        axis.set_xlabel(short(x))
        axis.set_ylabel(short(y))
    for axis in axes.flat[len(maps):]:
        axis.set_visible(False)
    marks = [plt.Line2D([], [], color=f"C{k % 10}", marker="o", linestyle="none",
                        label=f"{short(by)} = {value}") for k, value in enumerate(values)]
    marks.append(plt.Line2D([], [], color="0.4", marker="x", linestyle="none",
                            markeredgewidth=2, label="ends early"))
    marks += axes.flat[0].get_legend_handles_labels()[0]
    figure.legend(handles=marks, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=5,
                  fontsize="small", frameon=False)
    figure.savefig(path, dpi=100, bbox_inches="tight")
    plt.close(figure)
    print(f"plot: {path}")


def draw(axis, lines):
    for k, (label, points) in enumerate(lines.items()):
        if not points:
            continue
        color, marker = f"C{k % 10}", MARKERS[k % len(MARKERS)]
        axis.plot([p[0] for p in points], [abs(p[1]) for p in points], color=color,
                  linewidth=1)
        for sign, face in ((1, color), (-1, "white")):
            some = [p for p in points if sign * p[1] > 0]
            axis.plot([p[0] for p in some], [abs(p[1]) for p in some], marker, color=color,
                      markerfacecolor=face, markersize=5, linestyle="none")
        axis.plot([], [], color=color, marker=marker, markersize=5, linewidth=1,
                  label=label or "sweep")
    axis.set_xscale("log")
    axis.set_yscale("log")
    for scale in (axis.xaxis, axis.yaxis):
        scale.set_minor_locator(LogLocator(subs=range(2, 10)))
        scale.set_minor_formatter(NullFormatter())
    axis.grid(alpha=0.3)


def plot(rows, x, columns, path):
    """A panel for each group of each column; all panels of a column share y."""
    panels = [(y, group, lines) for y in columns for group, lines in curves(rows, x, y).items()]
    n_groups = len(panels) // len(columns)
    n_columns = 2 if n_groups in (2, 4) else min(3, len(panels))
    n_rows = math.ceil(len(panels) / n_columns)
    figure, axes = plt.subplots(n_rows, n_columns, squeeze=False, sharex=True,
                                layout="constrained",
                                figsize=(1 + 3.9 * n_columns, 0.5 + 3.6 * n_rows))
    first = {}  # axis of each column
    for axis, (y, group, lines) in zip(axes.flat, panels):
        if y in first:
            axis.sharey(first[y])
        first.setdefault(y, axis)
        draw(axis, lines)
        axis.set_title(group, fontsize="medium")
        axis.tick_params(labelbottom=True)
        axis.set_xlabel(x)
        axis.set_ylabel(y, fontsize="small")
        axis.legend(fontsize="small", loc="upper center", bbox_to_anchor=(0.5, -0.17),
                    ncols=2, frameon=False)
    for axis in axes.flat[len(panels):]:
        axis.set_visible(False)
    figure.savefig(path, dpi=100)
    plt.close(figure)
    print(f"plot: {path}")


def main(arguments):
    parser = argparse.ArgumentParser(prog="ephyra plot", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", help="table.csv of a sweep")
    parser.add_argument("--x", default="cpu time [s]", metavar="COLUMN",
                        help="column of the work (default: cpu time [s])")
    parser.add_argument("--y", action="append", default=[], metavar="TEXT",
                        help="columns of the error, named in full or in part; repeatable "
                        "(default: all errors against references)")
    parser.add_argument("--by", metavar="COLUMN", help="one line for each value of this column")
    parser.add_argument("--map", action="store_true", help="which cases came to their end")
    parser.add_argument("--line", action="append", default=[], metavar="TEXT",
                        help="a curve in the map, NAME = FORMULA in x; repeatable")
    parser.add_argument("--output", metavar="FILE",
                        help="the picture (default: beside the table, as PNG)")
    options = parser.parse_args(arguments)
    table = pathlib.Path(options.table)
    try:
        rows = read_table(table)
        x = find_columns(rows, [options.x], "--x")[0]
        columns = find_columns(rows, options.y or ["error of"], "--y")
        path = options.output or table.with_suffix(".png")
        if options.map:
            if len(columns) > 1 or not options.by:
                raise Wrong("a map has one column for --y and one for --by")
            plot_map(rows, x, columns[0], find_columns(rows, [options.by], "--by")[0],
                     options.line, path)
        elif options.by:
            plot_families(rows, x, columns, find_columns(rows, [options.by], "--by")[0], path)
        else:
            plot(rows, x, columns, path)
    except Wrong as error:
        print(f"plot: {error}.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
