#!/usr/bin/env python3
"""Runs one scene over lists of values, side by side, and collects the results.

Every case is a folder below --output, named after its values. A case that has
finished is not run again; one that was stopped is resumed from its checkpoint.
Ctrl-C and SIGTERM stop all cases with a checkpoint; the same command then goes
on. table.csv has one row for each case: the varied entries, then the columns
of its result.csv. With --refine, orders.csv and the screen show the observed
orders of every column."""

import argparse
import csv
import hashlib
import itertools
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

import convergence

SUCCESS, INPUT_ERROR, DIVERGED, INTERRUPTED = 0, 1, 2, 3


class UsageError(Exception):
    """Something in the arguments is wrong; the text is for the user."""


def parse_axis(text):
    """The steps along one --vary or --refine: a list of {entry: value}.

    "A/B = 1, 2; A/C = x, y" gives [{A/B: 1, A/C: x}, {A/B: 2, A/C: y}].
    """
    columns = {}
    for part in text.split(";"):
        entry, equals, values = part.partition("=")
        entry = entry.strip()
        items = [v.strip() for v in values.split("|" if "|" in values else ",")]
        if not equals or not entry or not all(items):
            raise UsageError(f"'{part.strip()}' is not of the form "
                             "\"Section/Entry = value, value, ...\"")
        if entry in columns:
            raise UsageError(f"'{entry}' appears twice in '{text}'")
        columns[entry] = items
    if len({len(items) for items in columns.values()}) > 1:
        raise UsageError(f"the lists in '{text}' differ in length")
    return [dict(zip(columns, row)) for row in zip(*columns.values())]


def case_name(values):
    """A folder name that tells the values, whatever the order of the cases."""
    parts = [f"{entry.split('/')[-1]}={value}" for entry, value in values.items()]
    name = re.sub(r"[^A-Za-z0-9=.,+-]+", "_", ",".join(parts)) or "case"
    full = ";".join(f"{entry}={value}" for entry, value in values.items())
    if len(name) > 100 or len({e.split("/")[-1] for e in values}) < len(values):
        name = name[:80] + "-" + hashlib.sha256(full.encode()).hexdigest()[:8]
    return name


def make_cases(axes):
    """The product of all axes: {name: {entry: value}}."""
    cases = {}
    for steps in itertools.product(*axes):
        values = {}
        for step in steps:
            for entry, value in step.items():
                if entry in values:
                    raise UsageError(f"'{entry}' is varied twice")
                values[entry] = value
        name = case_name(values)
        if name in cases:
            raise UsageError(f"the case {name} appears twice")
        cases[name] = values
    return cases


class Sweep:
    """The cases of one output folder; what is done is kept in sweep.json."""

    def __init__(self, options, cases):
        self.options = options
        self.cases = cases
        self.folder = pathlib.Path(options.output)
        self.status_file = self.folder / "sweep.json"
        scene = pathlib.Path(options.file).read_bytes()
        common = json.dumps(options.set).encode()
        self.fingerprint = hashlib.sha256(scene + common).hexdigest()
        self.done = {}  # name -> {"exit code", "wall time [s]"}
        self.running = {}  # process -> (name, start, log)
        self.stopping = False

    def load(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        if not self.status_file.exists():
            return
        status = json.loads(self.status_file.read_text())
        if self.options.overwrite:
            return
        worth = [case for case in status["cases"].values()
                 if case["exit code"] in (SUCCESS, INTERRUPTED)]
        if status["fingerprint"] != self.fingerprint:
            if not worth:
                return
            raise UsageError(
                f"{self.folder} holds a sweep of another scene or with other --set "
                "values: choose another --output, or replace it with --overwrite")
        self.done = status["cases"]

    def save(self):
        temporary = self.status_file.with_suffix(".tmp")
        temporary.write_text(json.dumps(
            {"fingerprint": self.fingerprint, "cases": self.done}, indent=1))
        temporary.replace(self.status_file)

    def finished(self, name):
        return (self.done.get(name, {}).get("exit code") == SUCCESS
                and (self.folder / name / "result.csv").exists())

    def start(self, name):
        folder = self.folder / name
        ranks = self.options.ranks
        command = ["mpirun", "-q", "-n", str(ranks)] if ranks > 1 else []
        command.append(self.options.binary)
        if any(folder.glob("checkpoints/checkpoint_*.h5")) and not self.options.overwrite:
            command += ["--resume", str(folder)]
        else:
            command += [self.options.file, "--output", str(folder), "--overwrite"]
        for entry, value in self.cases[name].items():
            command += ["--set", f"{entry} = {value}"]
        for assignment in self.options.set:
            command += ["--set", assignment]
        log = (self.folder / f"{name}.log").open("w")
        process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT,
                                   stdin=subprocess.DEVNULL, start_new_session=True)
        self.running[process] = (name, time.monotonic(), log)

    def collect(self):
        """Takes in the processes that have ended."""
        for process in [p for p in self.running if p.poll() is not None]:
            name, start, log = self.running.pop(process)
            log.close()
            earlier = self.done.get(name, {})
            seconds = time.monotonic() - start
            if earlier.get("exit code") == INTERRUPTED:
                seconds += earlier["wall time [s]"]
            code = process.returncode
            if self.stopping and code not in (SUCCESS, DIVERGED):
                code = INTERRUPTED  # too early for a checkpoint
            self.done[name] = {"exit code": code, "wall time [s]": round(seconds, 3)}
            self.save()
            word = {SUCCESS: "done", DIVERGED: "diverged",
                    INTERRUPTED: "stopped, resumable"}.get(code, "failed")
            print(f"  {name}: {word} after {seconds:.1f} s", flush=True)
            if code not in (SUCCESS, INTERRUPTED):
                text = (self.folder / f"{name}.log").read_text(errors="replace")
                for line in text.strip().splitlines()[-3:]:
                    print(f"    {line}")

    def stop(self, *_):
        """Asks all cases for a checkpoint; asked again, ends them."""
        for process in self.running:
            process.send_signal(signal.SIGTERM if self.stopping else signal.SIGUSR1)
        self.stopping = True

    def run(self):
        waiting = [name for name in self.cases if not self.finished(name)]
        n_finished = len(self.cases) - len(waiting)
        print(f"sweep: {len(self.cases)} cases, {n_finished} already finished, "
              f"{self.options.jobs} at a time", flush=True)
        signal.signal(signal.SIGINT, self.stop)
        signal.signal(signal.SIGTERM, self.stop)
        while self.running or (waiting and not self.stopping):
            while waiting and not self.stopping and len(self.running) < self.options.jobs:
                self.start(waiting.pop(0))
            time.sleep(0.05)
            self.collect()

    def exit_code(self):
        if any(name not in self.done for name in self.cases):
            return INTERRUPTED
        codes = {self.done[name]["exit code"] for name in self.cases}
        if INTERRUPTED in codes:
            return INTERRUPTED
        if DIVERGED in codes:
            return DIVERGED
        return SUCCESS if codes == {SUCCESS} else INPUT_ERROR

    def results(self):
        """result.csv of every finished case: {name: {column: text}}."""
        found = {}
        for name in self.cases:
            if self.finished(name):
                with open(self.folder / name / "result.csv", newline="") as file:
                    found[name] = next(csv.DictReader(file))
        return found

    def write_table(self):
        results = self.results()
        entries = list(dict.fromkeys(e for values in self.cases.values() for e in values))
        columns = list(dict.fromkeys(c for row in results.values() for c in row))
        state = ["exit code"] + [c for c in ("wall time [s]",) if c not in columns]
        with open(self.folder / "table.csv", "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(entries + columns + state)
            for name, values in self.cases.items():
                row = results.get(name, {})
                done = self.done.get(name, {})
                writer.writerow([values.get(e, "") for e in entries]
                                + [row.get(c, "") for c in columns]
                                + [done.get(c, "") for c in state])
        print(f"table: {self.folder / 'table.csv'}")


def observed_orders(h, x, column, references):
    """(kind, orders, limit) of one column over the refined cases."""
    if column in references:
        errors = [value - references[column] for value in x]
        return "reference", convergence.order_of_errors(h, errors), references[column]
    if "error" in column.lower():
        return "error", convergence.order_of_errors(h, x), 0.0
    triples = [convergence.three_grid_order(h[k:k + 3], x[k:k + 3])
               for k in range(len(h) - 2)]
    return "three grids", [p for p, _ in triples], triples[-1][1] if triples else None


def is_reported(column, wanted):
    """Whether the orders of a column are of interest: one of those that the
    user named in full or in part, or any that the run does not say of itself."""
    if wanted:
        return any(word in column for word in wanted)
    return not column.startswith(("exit code", "wall time", "steps", "repeated steps"))


def report_orders(sweep, refined, references):
    """Prints the orders of the numeric columns and writes orders.csv."""
    h = convergence.mesh_sizes([next(iter(step.values())) for step in refined])
    results = sweep.results()
    groups = {}
    for name, values in sweep.cases.items():
        rest = {e: v for e, v in values.items() if e not in refined[0]}
        groups.setdefault(json.dumps(rest), []).append(name)
    rows = []
    for key, names in groups.items():
        label = ", ".join(f"{e} = {v}" for e, v in json.loads(key).items())
        if not all(name in results for name in names):
            print(f"orders: {label or 'the refinement'} is not complete")
            continue
        print("orders: " + (label or "over the refinement"))
        for column in results[names[0]]:
            if not is_reported(column, sweep.options.column):
                continue
            try:
                x = [float(results[name][column]) for name in names]
            except (KeyError, ValueError):
                continue
            kind, orders, limit = observed_orders(h, x, column, references)
            texts = ["-" if p is None else f"{p:.2f}" for p in orders]
            print(f"  {column}: {', '.join(f'{value:.8g}' for value in x)}; order "
                  f"({kind}) {', '.join(texts) or '-'}"
                  + ("" if limit is None else f"; limit {limit:.8g}"))
            rows.append([label, column, kind] + x + texts
                        + ["" if limit is None else limit])
    n_orders = max((len(row) for row in rows), default=4) - 4 - len(h)
    with open(sweep.folder / "orders.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["case", "column", "kind"] + [f"value {k + 1}" for k in range(len(h))]
                        + [f"order {k + 1}" for k in range(n_orders)] + ["limit"])
        for row in rows:
            gap = [""] * (n_orders + 4 + len(h) - len(row))
            writer.writerow(row[:-1] + gap + row[-1:])


def parse_references(texts):
    references = {}
    for text in texts:
        column, equals, value = text.rpartition("=")
        try:
            references[column.strip()] = float(value)
        except ValueError:
            equals = ""
        if not equals:
            raise UsageError(f"--reference '{text}' is not of the form \"column [unit] = value\"")
    return references


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        prog="ephyra sweep", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", help="parameter file of the scene")
    parser.add_argument("--vary", action="append", default=[], metavar='"S/E = a, b"',
                        help="values of an entry; entries separated by ';' change together, "
                        "several --vary give all combinations; values that hold commas are "
                        "separated by '|'")
    parser.add_argument("--refine", metavar='"S/E = 1, 2, 4"',
                        help="as --vary, from coarse to fine; the first entry gives the size: "
                        "increasing values count cells, decreasing ones are steps")
    parser.add_argument("--reference", action="append", default=[], metavar='"COLUMN = X"',
                        help="value that a column of result.csv should tend to")
    parser.add_argument("--column", action="append", default=[], metavar="TEXT",
                        help="report the orders of columns whose name holds this text")
    parser.add_argument("--set", action="append", default=[], metavar='"S/E = v"',
                        help="the same for all cases")
    parser.add_argument("--output", required=True, metavar="FOLDER", help="where the cases go")
    parser.add_argument("--overwrite", action="store_true", help="run all cases anew")
    parser.add_argument("-n", "--ranks", type=int, default=1, help="ranks of a case (default 1)")
    parser.add_argument("-j", "--jobs", type=int, help="cases at a time (default: cores / ranks)")
    parser.add_argument("--binary", required=True, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    options.ranks = max(1, options.ranks)
    if options.jobs is None:
        options.jobs = max(1, len(os.sched_getaffinity(0)) // options.ranks)
    options.jobs = max(1, options.jobs)
    return options


def main(arguments):
    options = parse_arguments(arguments)
    try:
        if not pathlib.Path(options.file).is_file():
            raise UsageError(f"the parameter file {options.file} does not exist")
        axes = [parse_axis(text) for text in options.vary]
        refined = parse_axis(options.refine) if options.refine else None
        if refined:
            convergence.mesh_sizes([next(iter(step.values())) for step in refined])
            axes.append(refined)
        if not axes:
            raise UsageError("nothing to vary: give --vary or --refine")
        references = parse_references(options.reference)
        sweep = Sweep(options, make_cases(axes))
        sweep.load()
    except (UsageError, ValueError) as error:
        print(f"sweep: {error}.", file=sys.stderr)
        return INPUT_ERROR
    sweep.run()
    sweep.write_table()
    if refined:
        report_orders(sweep, refined, references)
    return sweep.exit_code()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
