#!/usr/bin/env python3
"""One column of several runs over time in one picture, named after the runs."""

import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import ephyra_io


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="+", type=pathlib.Path, help="output folders of runs")
    parser.add_argument("--file", default="statistics.csv", help="table in each of them")
    parser.add_argument("--column", required=True, help="what is drawn over the first column")
    parser.add_argument("--title", default="", help="above the picture")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="picture")
    options = parser.parse_args()

    figure, axis = plt.subplots(figsize=(7, 2.6), layout="constrained")
    for folder in options.folders:
        table = ephyra_io.read_csv(folder / options.file)
        if options.column not in table:
            raise SystemExit(f"plot_columns: {folder / options.file} has no column "
                             f"'{options.column}', but {', '.join(table)}.")
        time = next(iter(table))
        axis.plot(table[time], table[options.column], label=folder.name, linewidth=1.2)
    axis.set_xlabel(time)
    axis.set_ylabel(options.column)
    axis.set_title(options.title)
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    figure.savefig(options.output, dpi=110)


if __name__ == "__main__":
    main()
