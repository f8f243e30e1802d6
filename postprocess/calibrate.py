#!/usr/bin/env python3
"""Finds the value of an entry for which a result of a scene reaches a target.

The two ends of the range come first. The target has to lie between their
results; the range is then narrowed by a safeguarded secant method (Illinois,
else bisection), one run for each value. Where the run at one end diverges or is
refused, the range is shrunk towards the other end until it encloses the target
or shows that the target lies beyond what converges.

The result is a column of result.csv, as "largest drop of margin diameter [-]".
Every run has a folder below --output, and calibrate.csv has one row for each.
The same command again reuses the runs that have finished and resumes one that
was stopped.

Exit codes: 0 the target is reached, 1 error in the arguments or the scene, 2 it
is not reached, 3 stopped early and resumable."""

import argparse
import csv
import difflib
import math
import pathlib
import re
import sys

from bracket import Bracket
from case_runner import (DIVERGED, INPUT_ERROR, INTERRUPTED, SUCCESS, CaseRunner,
                         add_run_arguments, set_jobs)
from study import UsageError, case_name

NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$")


class NotReached(Exception):
    """The target was not reached; for the user."""


class Stopped(Exception):
    """The user stopped the runs."""


def rounded(x):
    """A value as its text in the parameter file has it."""
    return float(f"{x:.12g}")


def number_and_unit(text, of):
    match = NUMBER.match(text)
    if not match:
        raise UsageError(f"'{text.strip()}' in '{of}' is not a number with or without a unit")
    return float(match[1]), match[2]


def parse_range(text):
    """"S/E = a : b" as (entry, a, b, unit)."""
    entry, equals, values = (part.strip() for part in text.partition("="))
    ends = values.split(":")
    if not (entry and equals) or len(ends) != 2:
        raise UsageError(f"'{text}' is not of the form \"Section/Entry = value : value\"")
    (a, unit_a), (b, unit_b) = (number_and_unit(end, text) for end in ends)
    if unit_a and unit_b and unit_a != unit_b:
        raise UsageError(f"the ends of '{text}' have two units; give both in one")
    if a == b:
        raise UsageError(f"the ends of '{text}' are the same value")
    return entry, rounded(min(a, b)), rounded(max(a, b)), unit_a or unit_b


def parse_target(text):
    """"COLUMN = X" as (column, X)."""
    column, equals, value = (part.strip() for part in text.rpartition("="))
    try:
        target = float(value)
    except ValueError:
        target = math.nan
    if not (column and equals) or not math.isfinite(target):
        raise UsageError(f"the target '{text}' is not of the form \"column [unit] = value\", "
                         "with the value in the unit of the column")
    return column, target


def find_column(wanted, columns):
    """The column of that name, which may go without its unit."""
    if wanted in columns:
        return wanted
    found = [column for column in columns if column.rsplit(" [", 1)[0] == wanted]
    if len(found) == 1:
        return found[0]
    nearest = difflib.get_close_matches(wanted, columns, 5, 0.3)
    raise UsageError(f"'{wanted}' is no result of this scene"
                     + ("; the nearest are " if nearest else "")
                     + ", ".join(f"'{column}'" for column in nearest))


class Calibration:
    """The runs of one calibration."""

    def __init__(self, options):
        scene = pathlib.Path(options.file)
        if not scene.is_file():
            raise UsageError(f"the file {scene} does not exist")
        self.entry, low, high, self.unit = parse_range(options.vary)
        self.column, self.target = parse_target(options.target)
        if not options.tolerance > 0:
            raise UsageError("the tolerance has to be positive")
        self.tolerance = options.tolerance * (abs(self.target) or 1)
        self.most_runs = options.runs
        self.bracket = Bracket((low, high))
        self.runner = CaseRunner("calibrate", options, scene, options.set)
        self.rows = []

    def text(self, x):
        return f"{x:.12g} {self.unit}".strip()

    def case(self, x):
        values = {self.entry: self.text(x)}
        name = case_name(values)
        self.runner.cases[name] = values
        return name

    def evaluate(self, points):
        """Runs the scene at @p points and hands the results to the bracket."""
        names = [self.case(x) for x in points]
        done = self.runner.done
        self.runner.run([name for name in names if not self.runner.finished(name)
                         and done.get(name, {}).get("exit code") != DIVERGED])
        for x, name in zip(points, names):
            code = done.get(name, {}).get("exit code", INTERRUPTED)
            if code == INTERRUPTED:
                raise Stopped
            if code not in (SUCCESS, DIVERGED, INPUT_ERROR):
                raise UsageError(f"the run at {self.entry} = {self.text(x)} failed, see "
                                 f"{self.runner.folder / name}.log")
            self.take(x, name, code)

    def take(self, x, name, code):
        value, status = None, "diverged" if code == DIVERGED else "refused"
        if code == SUCCESS:
            row = self.runner.result(name)
            self.column = find_column(self.column, list(row))
            value, status = self.number(row[self.column]), "ran"
            if value is None:
                status = "no number"
        self.bracket.add(x, None if value is None else value - self.target)
        if value is not None and abs(value - self.target) <= self.tolerance:
            status = "reached"
        self.rows.append((self.text(x), "" if value is None else repr(value), status,
                          self.runner.done[name].get("cpu time [s]", ""), code))
        self.write_table()
        print(f"{self.entry} = {self.text(x)}: "
              + (status if value is None else f"{self.column} = {value:.10g}"), flush=True)

    @staticmethod
    def number(text):
        try:
            value = float(text)
        except ValueError:
            return None
        return value if math.isfinite(value) else None

    def write_table(self):
        with open(self.runner.folder / "calibrate.csv", "w", newline="",
                  encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow([self.entry, self.column, "status", "cpu time [s]", "exit code"])
            writer.writerows(self.rows)

    def reached(self):
        """(x, f) within the tolerance, or None."""
        best = self.bracket.best()
        return best if best and abs(best[1]) <= self.tolerance else None

    def run(self):
        """The value of the entry; NotReached where there is none."""
        self.evaluate(self.bracket.first_ends)
        self.check_ends()
        while not self.reached():
            x = self.bracket.next()
            if x is None:
                raise NotReached(self.why_narrow())
            if len(self.rows) >= self.most_runs:
                raise NotReached(f"the target is not reached in {self.most_runs} runs; the "
                                 f"nearest is {self.describe(self.bracket.best())}; --runs allows more")
            self.evaluate([rounded(x)])
        x, f = self.reached()
        if not self.bracket.is_monotone:
            print("calibrate: the results are not monotone between the ends: there may be other "
                  "values that reach the target.", file=sys.stderr)
        return x, f + self.target

    def describe(self, point):
        return (f"{self.column} = {point[1] + self.target:.6g} at {self.entry} = "
                f"{self.text(point[0])}")

    def check_ends(self):
        values, failed = self.bracket.values(), self.bracket.failed()
        statuses = [row[2] for row in self.rows]
        if statuses == ["refused", "refused"]:
            raise UsageError("the scene was refused at both ends of the range, see above")
        if not values:
            raise NotReached(f"the runs at both ends of the range of {self.entry} failed "
                             f"({', '.join(statuses)}); give ends at which the scene runs")
        if failed:
            status = next(s for s in statuses if s not in ("ran", "reached"))
            print(f"calibrate: the run at {self.text(failed[0])} failed ({status}); the range is "
                  "shrunk towards the other end.", file=sys.stderr)
        elif not self.reached() and self.bracket.ends is None:
            raise NotReached(f"the target {self.target:.6g} is not between the results at the ends: "
                             f"{self.describe(values[0])} and {self.describe(values[-1])}; "
                             "give a range that encloses it")

    def why_narrow(self):
        if self.bracket.ends:
            return ("the result jumps over the target: "
                    + " and ".join(self.describe((x, self.bracket.points[x]))
                                   for x in self.bracket.ends))
        gap = self.bracket.gap_to_failure()
        good, bad = gap if gap[0] in dict(self.bracket.values()) else reversed(gap)
        return (f"the target {self.target:.6g} lies beyond what converges: "
                f"{self.describe((good, self.bracket.points[good]))}, and the run at "
                f"{self.text(bad)} fails")


def prm_text(entry, value):
    """The entry as lines of a parameter file."""
    *sections, name = entry.split("/")
    lines = ["  " * k + f"subsection {section.strip()}" for k, section in enumerate(sections)]
    lines.append("  " * len(sections) + f"set {name.strip()} = {value}")
    lines += ["  " * k + "end" for k in reversed(range(len(sections)))]
    return "\n".join(lines)


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        prog="ephyra calibrate", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", help="parameter file of the scene")
    parser.add_argument("--vary", required=True, metavar='"S/E = a : b"',
                        help="the entry, and the ends of the range in which it is looked for")
    parser.add_argument("--target", required=True, metavar='"COLUMN = X"',
                        help="the column of result.csv and the value it should reach")
    parser.add_argument("--tolerance", type=float, default=1e-3, metavar="T",
                        help="largest difference from the target, relative to it; as it is where "
                        "the target is zero (default 1e-3)")
    parser.add_argument("--runs", type=int, default=40, help="most runs (default 40)")
    add_run_arguments(parser)
    options = parser.parse_args(arguments)
    set_jobs(options)
    return options


def main(arguments):
    options = parse_arguments(arguments)
    try:
        calibration = Calibration(options)
        calibration.runner.load()
        x, value = calibration.run()
    except UsageError as error:
        print(f"calibrate: {error}.", file=sys.stderr)
        return INPUT_ERROR
    except NotReached as error:
        print(f"calibrate: {error}.", file=sys.stderr)
        return DIVERGED
    except Stopped:
        print("calibrate: stopped; the same command goes on.", file=sys.stderr)
        return INTERRUPTED
    print(f"calibrate: {calibration.column} = {value:.10g} after {len(calibration.rows)} runs, "
          f"table: {calibration.runner.folder / 'calibrate.csv'}")
    print(prm_text(calibration.entry, calibration.text(x)))
    return SUCCESS


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
