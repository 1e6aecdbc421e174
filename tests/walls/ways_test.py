# SPDX-License-Identifier: MIT
"""The ways of guides/ways.md lead through functions that are there, and back to few files."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEP = re.compile(r"\d+\. `([^`]+)` `(\w+)`")
MOST_RETURNS = 2


def ways():
    """{heading: [(file, function), ...]}"""
    text = (ROOT / "guides" / "ways.md").read_text(encoding="utf-8")
    heads = re.split(r"^## (.+)$", text, flags=re.MULTILINE)[1:]
    return {name: STEP.findall(steps) for name, steps in zip(heads[::2], heads[1::2])}


def returns(steps):
    """How often a way comes to a file in which it was before, other than straight from there."""
    files = [file for file, _ in steps]
    return sum(file in files[:k] and file != files[k - 1] for k, file in enumerate(files))


class Ways(unittest.TestCase):
    def test_every_step_is_a_function_of_its_file(self):
        for way, steps in ways().items():
            self.assertGreater(len(steps), 5, way)
            for file, function in steps:
                self.assertRegex((ROOT / file).read_text(encoding="utf-8"), rf"\b{function}\(", way)

    def test_a_way_goes_back_to_few_files(self):
        for way, steps in ways().items():
            self.assertLessEqual(returns(steps), MOST_RETURNS, way)

    def test_going_back_is_counted(self):
        self.assertEqual(returns([("a", "f"), ("b", "g"), ("b", "h"), ("a", "k"), ("b", "m")]), 2)


if __name__ == "__main__":
    unittest.main()
