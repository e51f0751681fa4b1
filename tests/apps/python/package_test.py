"""The package's types, its notebook, and what it says of itself."""

import ast
import json
import os
import subprocess
import sys
import tempfile
import unittest

import presa
from presa import _presa

ROOM = "apps/python"


class Types(unittest.TestCase):
    def test_are_sound(self):
        with tempfile.TemporaryDirectory(prefix="presa-") as cache:
            done = subprocess.run(
                [sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache, "-p", "presa"],
                cwd=ROOM, capture_output=True, text=True,
            )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_of_the_compiled_part_name_all_of_it(self):
        with open(os.path.join(ROOM, "presa", "_presa.pyi"), encoding="utf-8") as file:
            classes = {node.name: node for node in ast.parse(file.read()).body if isinstance(node, ast.ClassDef)}
        stated = {node.name for node in classes["Simulation"].body if isinstance(node, ast.FunctionDef)}
        there = {name for name in vars(_presa.Simulation) if not name.startswith("_")} | {"__init__"}
        self.assertEqual(stated, there)

    def test_of_the_package_name_all_of_it(self):
        for name in presa.__all__:
            self.assertTrue((getattr(presa, name).__doc__ or "").strip(), name)
        self.assertEqual(sorted(dir(presa)), sorted(presa.__all__))


class Notebook(unittest.TestCase):
    def test_runs_from_its_first_cell_to_its_last(self):
        with open(os.path.join(ROOM, "grasp.ipynb"), encoding="utf-8") as file:
            cells = json.load(file)["cells"]
        code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
        self.assertGreater(len(code), 3)
        names = {}
        for number, source in enumerate(code):
            exec(compile(source, f"cell {number}", "exec"), names)  # as a notebook does, in one namespace
        self.assertEqual(len(names["plt"].get_fignums()), 3)


if __name__ == "__main__":
    unittest.main()
