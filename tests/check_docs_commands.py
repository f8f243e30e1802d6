#!/usr/bin/env python3
"""Checks every command in README.md and the documentation.

Commands are the lines of blocks fenced as ```sh. What is cheap is run with the
binary named by EPHYRA_BINARY (default build/ephyra-binary): --validate of every
parameter file with the --set values of the command, --parameters, each case of
a sweep, both ends of a calibration. Of the rest, programs, options, files and
presets must exist. A command of an unknown kind is an error: teach this script what it is. Links between the
documents must lead somewhere, too.
"""

import concurrent.futures
import functools
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BINARY = os.environ.get("EPHYRA_BINARY", str(ROOT / "build" / "ephyra-binary"))
sys.path.insert(0, str(ROOT / "postprocess"))
import calibrate
import study
import sweep

# Programs of the system, and what they are used for here.
SYSTEM_PROGRAMS = {"touch", "export", "spack", "cd", "git"}
RUN_OPTIONS_WITH_VALUE = {"-n", "--set", "--output", "--resume"}
RUN_OPTIONS = {"--overwrite", "--quiet"}


class Wrong(Exception):
    """What is wrong with a command."""


def documents():
    return [ROOT / "README.md", ROOT / "CONTRIBUTING.md",
            *sorted((ROOT / "docs").glob("**/*.md")),
            *sorted((ROOT / "parameters").glob("**/*.md"))]


def commands(path):
    """(line number, command) of every command of a document."""
    fenced, pending = False, ""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if line.startswith("```"):
            fenced = line.strip() == "```sh"
        elif fenced and line.strip() and not line.lstrip().startswith("#"):
            pending += line.strip()
            if pending.endswith("\\"):
                pending = pending[:-1] + " "
            else:
                yield number, pending
                pending = ""


@functools.lru_cache(maxsize=None)
def call_binary(*arguments):
    result = subprocess.run([BINARY, *arguments], cwd=ROOT, capture_output=True, text=True,
                            stdin=subprocess.DEVNULL, timeout=120, check=False)
    if result.returncode != 0:
        raise Wrong(f"{' '.join(arguments)} gives exit code {result.returncode}: "
                    + (result.stderr + result.stdout).strip())


def check_file(name):
    if not (ROOT / name).exists():
        raise Wrong(f"{name} does not exist")


def check_run(arguments):
    """Arguments of run, or of the binary itself."""
    files, sets, resumes = [], [], False
    while arguments:
        word = arguments.pop(0)
        if word in RUN_OPTIONS_WITH_VALUE:
            if not arguments:
                raise Wrong(f"{word} lacks its value")
            value = arguments.pop(0)
            resumes = resumes or word == "--resume"
            sets += ["--set", value] if word == "--set" else []
        elif word.startswith("-") and word not in RUN_OPTIONS:
            raise Wrong(f"unknown option {word}")
        elif not word.startswith("-"):
            files.append(word)
    if len(files) + resumes != 1:
        raise Wrong("one parameter file, or --resume, is needed")
    for file in files:
        check_file(file)
        call_binary("--validate", file, *sets)


def check_sweep(arguments):
    options = sweep.parse_arguments(["--binary", BINARY, *arguments])
    options.file = str(ROOT / options.file)
    one = study.make_study(options)
    commands_of_cases = []
    for values in one.cases.values():
        sets = one.settings + [f"{entry} = {value}" for entry, value in values.items()]
        commands_of_cases.append(["--validate", str(one.scene),
                                  *[word for text in sets for word in ("--set", text)]])
    with concurrent.futures.ThreadPoolExecutor() as pool:
        list(pool.map(lambda command: call_binary(*command), commands_of_cases))


def check_calibrate(arguments):
    options = calibrate.parse_arguments(["--binary", BINARY, *arguments])
    options.file = str(ROOT / options.file)
    one = calibrate.Calibration(options)
    sets = [word for text in options.set for word in ("--set", text)]
    for x in one.bracket.first_ends:
        call_binary("--validate", options.file, *sets, "--set", f"{one.entry} = {one.text(x)}")


def check_plot(command, arguments):
    script = "plot_table.py" if arguments and arguments[0].endswith(".csv") else "plot_run.py"
    if command == "stroke":
        script = "plot_stroke.py"
    source = (ROOT / "postprocess" / script).read_text(encoding="utf-8")
    for word in arguments:
        if word.startswith("--") and f'"{word}"' not in source:
            raise Wrong(f"unknown option {word}")


def check_launcher(arguments):
    command = arguments.pop(0)
    if command == "run":
        check_run(arguments)
    elif command == "validate":
        for file in arguments:
            check_file(file)
        call_binary("--validate", *arguments)
    elif command == "parameters":
        call_binary("--parameters=markdown" if "--markdown" in arguments else "--parameters")
    elif command == "sweep":
        check_sweep(arguments)
    elif command == "calibrate":
        check_calibrate(arguments)
    elif command in ("plot", "stroke"):
        check_plot(command, arguments)
    elif command in ("--help", "help", "build", "test", "bench"):
        help_text = subprocess.run([str(ROOT / "ephyra"), "--help"], capture_output=True,
                                   text=True, check=True).stdout
        for word in [command, *arguments]:
            if word not in help_text:
                raise Wrong(f"{word} is not in ./ephyra --help")
    else:
        raise Wrong(f"unknown launcher command {command}")


def check_cmake(arguments):
    text = " ".join(arguments)
    presets = json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]
    match = re.search(r"--preset[ =](\S+)", text)
    if match and match[1] not in [preset["name"] for preset in presets]:
        raise Wrong(f"there is no preset {match[1]}")
    known = (ROOT / "CMakeLists.txt").read_text() + (ROOT / "tests/CMakeLists.txt").read_text()
    for option in re.findall(r"-D(EPHYRA_\w+)", text):
        if f"option({option}" not in known:
            raise Wrong(f"there is no option {option}")


def check(command):
    words = shlex.split(command, comments=True)
    program, arguments = words[0], words[1:]
    if program in ("mpirun", "srun"):
        while arguments and not arguments[0].endswith("ephyra-binary"):
            arguments.pop(0)
        check_run(arguments[1:])
    elif program == "./ephyra":
        check_launcher(arguments)
    elif program in ("cmake", "ctest"):
        check_cmake(arguments)
    elif program in ("pvpython", "python3"):
        check_file(arguments[0])
    elif program not in SYSTEM_PROGRAMS:
        check_file(program)


def broken_links(path):
    for target in re.findall(r"\]\(([^)#]+)[^)]*\)", path.read_text(encoding="utf-8")):
        if "://" not in target and not (path.parent / target).exists():
            yield target


def main():
    n_commands, wrong = 0, []
    for path in documents():
        name = path.relative_to(ROOT)
        for number, command in commands(path):
            n_commands += 1
            try:
                check(command)
            except (Wrong, study.UsageError, SystemExit) as error:
                wrong.append(f"{name}:{number}: {command}\n  {error}")
        wrong += [f"{name}: the link to {target} leads nowhere" for target in broken_links(path)]
    for text in wrong:
        print(text)
    print(f"documentation: {n_commands} commands, {len(wrong)} problems")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
