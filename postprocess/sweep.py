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
import csv
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import sweep_report
from study import UsageError, make_study

SUCCESS, INPUT_ERROR, DIVERGED, INTERRUPTED = 0, 1, 2, 3


class Sweep:
    """The cases of one output folder; what is done is kept in sweep.json."""

    def __init__(self, options, study):
        self.options = options
        self.study = study
        self.cases = study.cases
        self.folder = pathlib.Path(options.output)
        self.status_file = self.folder / "sweep.json"
        scene = study.scene.read_bytes()
        common = json.dumps(study.settings).encode()
        self.fingerprint = hashlib.sha256(scene + common).hexdigest()
        self.done = {}  # name -> {"exit code", "wall time [s]", "cpu time [s]"}
        self.running = {}  # process -> (name, resumed, start, log)
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
        resumed = (any(folder.glob("checkpoints/checkpoint_*.h5"))
                   and not self.options.overwrite)
        if resumed:
            command += ["--resume", str(folder)]
        else:
            command += [str(self.study.scene), "--output", str(folder), "--overwrite"]
        for assignment in self.study.settings:
            command += ["--set", assignment]
        for entry, value in self.cases[name].items():
            command += ["--set", f"{entry} = {value}"]
        log = (self.folder / f"{name}.log").open("w")
        process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT,
                                   stdin=subprocess.DEVNULL, start_new_session=True)
        self.running[process] = (name, resumed, time.monotonic(), log)

    def collect(self):
        """Takes in the processes that have ended."""
        for process in [p for p in self.running if p.poll() is not None]:
            name, resumed, start, log = self.running.pop(process)
            log.close()
            seconds = time.monotonic() - start
            code = process.returncode
            if self.stopping and code not in (SUCCESS, DIVERGED):
                code = INTERRUPTED  # too early for a checkpoint
            row = self.result(name) if code != INPUT_ERROR else {}
            earlier = self.done.get(name, {}) if resumed else {}
            self.done[name] = {"exit code": code}
            for column in ("wall time [s]", "cpu time [s]"):
                if column in row:
                    total = float(row[column]) + earlier.get(column, 0)
                    self.done[name][column] = round(total, 3)
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

    def result(self, name):
        """The row of result.csv of a case: {column: text}; empty without one."""
        try:
            with open(self.folder / name / "result.csv", newline="", encoding="utf-8") as file:
                return next(csv.DictReader(file))
        except (FileNotFoundError, StopIteration):
            return {}

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
        sweep = Sweep(options, make_study(options))
        sweep.load()
    except UsageError as error:
        print(f"sweep: {error}.", file=sys.stderr)
        return INPUT_ERROR
    sweep.run()
    sweep.report()
    return sweep.exit_code()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
