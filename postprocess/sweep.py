#!/usr/bin/env python3
"""Runs one scene over lists of values, side by side, and collects the results.

Every case is a folder below --output, named after its values. A case that has
finished is not run again; one that was stopped is resumed from its checkpoint.
Ctrl-C and SIGTERM stop all cases with a checkpoint; the same command then goes
on. table.csv has one row for each case: the varied entries, the columns of its
result.csv, the errors against the references, and what the run took. With
--refine, orders.csv and the screen show the observed orders of every column.

A file NAME.study holds these options for several series of cases of one scene:
see postprocess/study.py."""

import argparse
import sys

import sweep_report
from case_runner import (DIVERGED, INPUT_ERROR, INTERRUPTED, SUCCESS, CaseRunner,
                         add_run_arguments, set_jobs)
from study import UsageError, make_study


class Sweep(CaseRunner):
    """All cases of a study, and their tables."""

    def __init__(self, options, study):
        super().__init__("sweep", options, study.scene, study.settings)
        self.study = study
        self.cases = study.cases

    def run_all(self):
        waiting = [name for name in self.cases if not self.finished(name)]
        n_finished = len(self.cases) - len(waiting)
        print(f"sweep: {len(self.cases)} cases, {n_finished} already finished, "
              f"{self.options.jobs} at a time", flush=True)
        self.run(waiting)

    def exit_code(self):
        if any(name not in self.done for name in self.cases):
            return INTERRUPTED
        codes = {self.done[name]["exit code"] for name in self.cases}
        if INTERRUPTED in codes:
            return INTERRUPTED
        if DIVERGED in codes:
            return DIVERGED
        return SUCCESS if codes == {SUCCESS} else INPUT_ERROR

    def report(self):
        """table.csv, and orders.csv where something was refined."""
        results = {name: self.result(name) for name in self.cases if self.finished(name)}
        self.study.resolve_references(results)
        sweep_report.write_table(self.folder / "table.csv",
                                 sweep_report.table_rows(self.study, results, self.done))
        if any(series.refined for series in self.study.series):
            sweep_report.report_orders(self.folder / "orders.csv", self.study, results)


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        prog="ephyra sweep", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", help="parameter file of the scene, or a study (NAME.study)")
    parser.add_argument("--vary", action="append", default=[], metavar='"S/E = a, b"',
                        help="values of an entry; entries separated by ';' change together, "
                        "several --vary give all combinations; values that hold commas are "
                        "separated by '|'")
    parser.add_argument("--refine", action="append", default=[], metavar='"S/E = 1, 2, 4"',
                        help="as --vary, from coarse to fine; the first entry gives the size: "
                        "increasing values count cells, decreasing ones are steps")
    parser.add_argument("--reference", action="append", default=[], metavar='"COLUMN = X"',
                        help="value that a column of result.csv should tend to: adds its error "
                        "to the table")
    parser.add_argument("--column", action="append", default=[], metavar="TEXT",
                        help="only columns whose name holds this text, in the table and the orders")
    parser.add_argument("--series", action="append", default=[], metavar="TEXT",
                        help="only series of the study whose name holds this text")
    add_run_arguments(parser)
    options = parser.parse_args(arguments)
    set_jobs(options)
    return options


def main(arguments):
    options = parse_arguments(arguments)
    try:
        sweep = Sweep(options, make_study(options))
        sweep.load()
    except UsageError as error:
        print(f"sweep: {error}.", file=sys.stderr)
        return INPUT_ERROR
    sweep.run_all()
    sweep.report()
    return sweep.exit_code()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
