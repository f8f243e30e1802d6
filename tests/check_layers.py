#!/usr/bin/env python3
"""Checks the layering rules of docs/architecture.md.

  - A file includes its own folder and those folders below it in the table
    VISIBLE; physics folders never see each other.
  - Headers of Trilinos, HDF5 and muParser stay in the sources of one folder.
  - source/X/y.cc has its header include/ephyra/X/y.h, or source/X/y.h where
    nobody else needs it; or it is a part of what another header of the folder
    declares.
  - Headers carry `#pragma once`; all name the namespace of their folder.
  - No source file is longer than MAX_LINES lines.

Prints one line for each violation; the exit code says whether there are any.
"""

import pathlib
import re
import sys

MAX_LINES = 500

BASICS = ["base", "splines", "linear_algebra", "geometry"]
PHYSICS = ["electrophysiology", "elasticity", "fluid"]
VISIBLE = {
    "base": [],
    "splines": ["base"],
    "linear_algebra": ["base", "splines"],
    "geometry": ["base", "splines", "linear_algebra"],
    "electrophysiology": BASICS,
    "elasticity": BASICS,
    "fluid": BASICS,
    "immersed_boundary": BASICS + ["fluid"],
    "diagnostics": BASICS,
    "coupling": BASICS + PHYSICS + ["immersed_boundary", "diagnostics"],
    "io": ["base"],
    "simulation": BASICS + PHYSICS
    + ["immersed_boundary", "coupling", "diagnostics", "io"],
}

# Headers of a library: a pattern, and where alone it may be included.
CONFINED = [
    (r"(Tpetra|Teuchos|Amesos2|Belos|Kokkos|Xpetra|Ifpack2|MueLu|Thyra)",
     "source/linear_algebra/"),
    (r"hdf5\.h|H5\w*\.h", "source/io/"),
    (r"muParser", "source/base/"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def check_includes(name, folder, text, report):
    for included in INCLUDE.findall(text):
        match = re.match(r"ephyra/([^/]+)/", included)
        if match and match[1] != folder and match[1] not in VISIBLE[folder]:
            report(f"{name}: {folder}/ may not include {included}")
        for pattern, allowed in CONFINED:
            if re.match(pattern, included) and not name.startswith(allowed):
                report(f"{name}: {included} may be included in {allowed} only")


def check_namespace(name, folder, text, report):
    space = "ephyra" if folder == "base" else f"ephyra::{folder}"
    if not re.search(rf"\bnamespace {space}\b", text):
        report(f"{name}: does not open namespace {space}")


def check_pairing(root, path, parts, text, report):
    header = pathlib.Path("include", "ephyra", *parts[1:]).with_suffix(".h")
    if (root / header).exists() or path.with_suffix(".h").exists():
        return
    if not any(name.startswith(f"ephyra/{parts[1]}/") for name in INCLUDE.findall(text)):
        report(f"{'/'.join(parts)}: its header {header.as_posix()} is missing")


def check_tree(root, report):
    """Calls report(text) for every violation below the folder root."""
    files = sorted(root.glob("include/ephyra/**/*.h")) + sorted(
        root.glob("source/*/**/*.cc")) + sorted(root.glob("source/*/**/*.h"))
    for path in files:
        name = path.relative_to(root).as_posix()
        parts = path.relative_to(root).parts
        folder = parts[2] if parts[0] == "include" else parts[1]
        text = path.read_text(encoding="utf-8")
        if folder not in VISIBLE:
            report(f"{name}: folder {folder}/ is not in docs/architecture.md")
            continue
        check_includes(name, folder, text, report)
        check_namespace(name, folder, text, report)
        if path.suffix == ".h" and "#pragma once" not in text:
            report(f"{name}: #pragma once is missing")
        if path.suffix == ".cc":
            check_pairing(root, path, parts, text, report)

    others = [path for pattern in ("tests/**/*.cc", "tests/**/*.h", "tests/**/*.py",
                                   "postprocess/**/*.py", "source/*.cc")
              for path in root.glob(pattern)]
    for path in files + sorted(others):
        n_lines = len(path.read_text(encoding="utf-8").splitlines())
        if n_lines > MAX_LINES:
            report(f"{path.relative_to(root)}: {n_lines} lines, allowed are {MAX_LINES}")


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else
                        pathlib.Path(__file__).resolve().parent.parent)
    violations = []
    check_tree(root, violations.append)
    for line in violations:
        print(line)
    print(f"layers: {len(violations)} violations")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
