"""Every test that the safety case names exists, and every row names one."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAME = re.compile(r"`(\w+\.\w+)`")


class SafetyCase(unittest.TestCase):
    def setUp(self):
        lines = (ROOT / "framework/device/SAFETY_CASE.md").read_text().splitlines()
        self.rows = [line for line in lines if line.startswith("| ")][1:]
        self.assertGreater(len(self.rows), 15)

    def test_every_row_names_a_test(self):
        for row in self.rows:
            self.assertTrue(NAME.search(row.split("|")[-2]), row)

    def test_every_named_test_exists(self):
        sources = "".join(file.read_text() for file in ROOT.glob("tests/**/*_test.cpp"))
        tests = {".".join(pair) for pair in re.findall(r"^TEST(?:_F|_P)?\((\w+), (\w+)\)", sources, re.MULTILINE)}
        named = {name for row in self.rows for name in NAME.findall(row)}
        self.assertEqual(named - tests, set())


if __name__ == "__main__":
    unittest.main()
