"""What a sweep runs: lists of values, series of cases, and study files.

A study file names a scene and several series of cases, one word and its text in
each line, '#' begins a comment:

    scene      ../verification/sphere_drag.prm
    reference  sphere drag coefficient by forcing [-] = 1.089
    column     drag coefficient

    series     scheme: rk3
    vary       Scene/Refinement = 1, 2, 4

    series     scheme: ab2
    set        Fluid/Time scheme = ab2
    vary       Scene/Refinement = 1, 2, 4

The words are the options of `ephyra sweep`. What stands above the first series
holds for all of them. The scene is looked for from the folder of the file. A
reference may be the last case of a series instead of a number:

    reference  circulation [m^2/s] = last of SERIES"""

import hashlib
import itertools
import pathlib
import re

import convergence

LAST_OF = "last of "
WORDS = ("scene", "set", "vary", "refine", "reference", "column", "series")


class UsageError(Exception):
    """Something in the arguments or the study is wrong; for the user."""


def parse_axis(text):
    """The steps along one list of values: a list of {entry: value}.

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


def parse_setting(text):
    """"A/B = value" as an axis of one step."""
    entry, equals, value = (part.strip() for part in text.partition("="))
    if not (entry and equals and value):
        raise UsageError(f"'{text}' is not of the form \"Section/Entry = value\"")
    return [{entry: value}]


def parse_reference(text):
    """"COLUMN = X" as {column: X}; X is a number, or a text for the name of a
    series whose last case is the reference."""
    column, _, series = (part.strip() for part in text.partition("= " + LAST_OF))
    if series:
        return {column: series}
    column, _, value = text.rpartition("=")
    try:
        return {column.strip(): float(value)}
    except ValueError:
        raise UsageError(f"the reference '{text}' is not of the form \"column [unit] = value\" "
                         f"or \"column [unit] = {LAST_OF}SERIES\"") from None


def case_name(values):
    """A folder name that tells the values, whatever the order of the cases."""
    parts = [f"{entry.split('/')[-1]}={value}" for entry, value in values.items()]
    name = re.sub(r"[^A-Za-z0-9=.,+-]+", "_", ",".join(parts)) or "case"
    full = ";".join(f"{entry}={value}" for entry, value in values.items())
    if len(name) > 100 or len({e.split("/")[-1] for e in values}) < len(values):
        name = name[:80] + "-" + hashlib.sha256(full.encode()).hexdigest()[:8]
    return name


class Series:
    """One line of a diagram: the product of its axes, with its references."""

    def __init__(self, name, words):
        self.name = name
        self.axes = [parse_setting(text) for text in words["set"]]
        self.axes += [parse_axis(text) for text in words["vary"]]
        if len(words["refine"]) > 1:
            raise UsageError(f"'refine' appears twice{f' for {name}' if name else ''}")
        self.refined = [step for text in words["refine"] for step in parse_axis(text)]
        if self.refined:
            try:
                self.sizes()
            except ValueError as error:
                raise UsageError(str(error)) from None
            self.axes.append(self.refined)
        self.references = {}
        for text in words["reference"]:
            self.references.update(parse_reference(text))

    def sizes(self):
        """Relative sizes of the refined steps, by their first entry."""
        return convergence.mesh_sizes([next(iter(step.values())) for step in self.refined])

    def cases(self):
        """The values of every case: a list of {entry: value}."""
        result = []
        for steps in itertools.product(*self.axes):
            values = {}
            for step in steps:
                for entry, value in step.items():
                    if entry in values:
                        raise UsageError(f"'{entry}' is varied twice")
                    values[entry] = value
            result.append(values)
        return result


class Study:
    """A scene, what holds for all cases, and the series."""

    def __init__(self, scene, settings, columns, series):
        self.scene = scene
        self.settings = settings
        self.columns = columns
        self.series = series
        self.cases = {}  # folder name: {entry: value}
        self.rows = []   # (series, folder name)
        names = {}
        for one in series:
            for values in one.cases():
                key = frozenset(values.items())
                if key not in names:
                    name = case_name(values)
                    if name in self.cases:
                        raise UsageError(f"the case {name} appears twice")
                    names[key] = name
                    self.cases[name] = values
                if (one, names[key]) in self.rows:
                    raise UsageError(f"the case {names[key]} appears twice")
                self.rows.append((one, names[key]))
        for one in series:
            for target in one.references.values():
                if isinstance(target, str) and target not in [s.name for s in series]:
                    raise UsageError(f"the reference '{LAST_OF}{target}' names no series")

    def resolve_references(self, results):
        """Puts the numbers of @p results, {case: row}, where a reference is the
        last case of a series; drops the reference where that has none."""
        last = {one.name: name for one, name in self.rows}
        for one in self.series:
            for column, target in list(one.references.items()):
                if isinstance(target, str):
                    text = results.get(last[target], {}).get(column)
                    del one.references[column]
                    if text is not None:
                        one.references[column] = float(text)


def read_words(path):
    """The lines of a study file: those for all series, and [(name, lines)]."""
    common = {word: [] for word in WORDS}
    series, current = [], common
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        word, _, text = line.split("#")[0].strip().partition(" ")
        text = text.strip()
        if not word:
            continue
        if word not in WORDS or not text:
            raise UsageError(f"{path}:{number}: '{line.strip()}' is not one of "
                             f"{', '.join(WORDS)} with its text")
        if word == "series":
            current = {word: [] for word in WORDS}
            series.append((text, current))
        elif word in ("scene", "column") and current is not common:
            raise UsageError(f"{path}:{number}: '{word}' belongs above the first series")
        else:
            current[word].append(text)
    return common, series


def make_study(options):
    """The study that the arguments of a sweep describe."""
    file = pathlib.Path(options.file)
    words = {"set": [], "vary": options.vary, "refine": options.refine,
             "reference": options.reference}
    if not file.is_file():
        raise UsageError(f"the file {file} does not exist")
    settings, columns = options.set, options.column
    if file.suffix != ".study":
        study = Study(file, settings, columns, [Series("", words)])
    else:
        common, parts = read_words(file)
        if len(common["scene"]) != 1:
            raise UsageError(f"{file} has to name one scene")
        scene = file.parent / common["scene"][0]
        if not scene.is_file():
            raise UsageError(f"{file}: the scene {scene} does not exist")
        for word in ("vary", "refine", "reference"):
            words[word] = common[word] + words[word]
        if options.series:
            parts = [part for part in parts if any(text in part[0] for text in options.series)]
        series = [Series(name, {word: words[word] + own[word] for word in words})
                  for name, own in parts]
        study = Study(scene, common["set"] + settings, common["column"] + columns, series)
    if not study.cases or not any(study.cases.values()):
        raise UsageError("nothing to vary: give --vary or --refine, or a study with series")
    return study
