"""Every rule of check_layers.py finds its violation, and only that."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import check_layers

HEADER = "#pragma once\n{includes}namespace ephyra::{folder}\n{{}}\n"


class CheckLayers(unittest.TestCase):
    def violations(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            found = []
            check_layers.check_tree(pathlib.Path(folder), found.append)
        return found

    def header(self, folder, *included):
        includes = "".join(f'#include "{name}"\n' for name in included)
        return {f"include/ephyra/{folder}/a.h":
                HEADER.format(includes=includes, folder=folder)}

    def assert_one(self, files, words):
        found = self.violations(files)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_allowed(self):
        self.assertEqual(self.violations(
            self.header("coupling", "ephyra/fluid/x.h", "ephyra/coupling/y.h")), [])
        self.assertEqual(self.violations(
            self.header("immersed_boundary", "ephyra/fluid/x.h")), [])

    def test_physics_apart(self):
        self.assert_one(self.header("elasticity", "ephyra/fluid/x.h"),
                        "elasticity/ may not include ephyra/fluid/x.h")
        self.assert_one(self.header("immersed_boundary", "ephyra/elasticity/x.h"),
                        "may not include")

    def test_upwards(self):
        self.assert_one(self.header("splines", "ephyra/geometry/x.h"), "may not")
        self.assert_one(self.header("io", "ephyra/fluid/x.h"), "may not")

    def test_confined_libraries(self):
        self.assert_one(self.header("linear_algebra", "Tpetra_CrsMatrix.hpp"),
                        "source/linear_algebra/ only")
        self.assert_one(self.header("io", "hdf5.h"), "source/io/ only")

    def test_pairing(self):
        self.assert_one({"source/fluid/a.cc": "namespace ephyra::fluid\n{}\n"},
                        "its header include/ephyra/fluid/a.h is missing")
        part = {"source/fluid/b.cc": '#include "ephyra/fluid/a.h"\nnamespace ephyra::fluid\n{}\n'}
        self.assertEqual(self.violations({**self.header("fluid"), **part}), [])

    def test_namespace_and_guard(self):
        self.assert_one({"include/ephyra/fluid/a.h": "#pragma once\n"}, "namespace")
        self.assert_one({"include/ephyra/fluid/a.h": "namespace ephyra::fluid\n{}\n"},
                        "#pragma once")

    def test_unknown_folder(self):
        self.assert_one({"include/ephyra/tools/a.h": "#pragma once\n"}, "tools/ is not")

    def test_length(self):
        long = self.header("fluid")["include/ephyra/fluid/a.h"] + "\n" * 500
        self.assert_one({"include/ephyra/fluid/a.h": long}, "allowed are 500")


if __name__ == "__main__":
    unittest.main()
