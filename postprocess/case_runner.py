"""Runs cases of one scene side by side, each in a folder of its own."""

import argparse
import csv
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import time

from study import UsageError

SUCCESS, INPUT_ERROR, DIVERGED, INTERRUPTED = 0, 1, 2, 3


def add_run_arguments(parser):
    """Options of every command that runs cases."""
    parser.add_argument("--set", action="append", default=[], metavar='"S/E = v"',
                        help="the same for all cases")
    parser.add_argument("--output", required=True, metavar="FOLDER", help="where the cases go")
    parser.add_argument("--overwrite", action="store_true", help="run all cases anew")
    parser.add_argument("-n", "--ranks", type=int, default=1, help="ranks of a case (default 1)")
    parser.add_argument("-j", "--jobs", type=int, help="cases at a time (default: cores / ranks)")
    parser.add_argument("--binary", required=True, help=argparse.SUPPRESS)


def set_jobs(options):
    options.ranks = max(1, options.ranks)
    if options.jobs is None:
        options.jobs = max(1, len(os.sched_getaffinity(0)) // options.ranks)
    options.jobs = max(1, options.jobs)


class CaseRunner:
    """The cases of one output folder; what is done is kept in NAME.json.

    `cases` is {folder name: {entry: value}}; it may grow between two run()."""

    def __init__(self, name, options, scene, settings):
        self.name = name
        self.options = options
        self.scene = scene
        self.settings = settings
        self.cases = {}
        self.folder = pathlib.Path(options.output)
        self.status_file = self.folder / f"{name}.json"
        common = json.dumps(settings).encode()
        self.fingerprint = hashlib.sha256(scene.read_bytes() + common).hexdigest()
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
                f"{self.folder} holds cases of another scene or with other --set "
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
            command += [str(self.scene), "--output", str(folder), "--overwrite"]
        for assignment in self.settings:
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

    def run(self, names):
        """Runs these cases; returns when they have ended."""
        waiting = list(names)
        signal.signal(signal.SIGINT, self.stop)
        signal.signal(signal.SIGTERM, self.stop)
        while self.running or (waiting and not self.stopping):
            while waiting and not self.stopping and len(self.running) < self.options.jobs:
                self.start(waiting.pop(0))
            time.sleep(0.05)
            self.collect()

    def result(self, name):
        """The row of result.csv of a case: {column: text}; empty without one."""
        try:
            with open(self.folder / name / "result.csv", newline="", encoding="utf-8") as file:
                return next(csv.DictReader(file))
        except (FileNotFoundError, StopIteration):
            return {}
