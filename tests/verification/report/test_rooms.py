# SPDX-License-Identifier: MIT
"""Tests that the rooms of the report know each other in one direction: page uses figures and read,
figures uses read.
"""
import ast
import os
import pathlib
import tempfile
import unittest

import report_path

MAY_USE = {"read": {"read"}, "figures": {"figures", "read"}, "page": {"page", "figures", "read"}}
MOST_FILES = 40


def imported(path):
    """Names of all modules that a file imports, wherever in it: (line, name)."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.lineno, "." * node.level + (node.module or "")


def wrong_arrows(folder):
    """Imports of rooms by rooms that may not use them, and those that hide their room behind dots.
    """
    faults = []
    for room, allowed in MAY_USE.items():
        for path in sorted((folder / room).rglob("*.py")):
            for line, name in imported(path):
                first = name.split(".")[0]
                if not first or (first in MAY_USE and first not in allowed):
                    faults.append(f"{room}/{path.name}:{line}: {name}")
    return faults


class RoomsTest(unittest.TestCase):
    def test_no_room_uses_one_that_stands_above_it(self):
        self.assertEqual(wrong_arrows(report_path.REPORT), [])

    def test_every_room_is_there_and_can_be_looked_over(self):
        for room in MAY_USE:
            files = os.listdir(report_path.REPORT / room)
            self.assertIn("__init__.py", files)
            self.assertLessEqual(len(files), MOST_FILES, room)

    def test_a_planted_arrow_is_found(self):
        planted = {
            "read/one.py": "from figures import style\n",
            "read/two.py": "import os, page.tables\n",
            "figures/three.py": (
                "import read.vtu\n\ndef late():\n    from page.tables import length\n"
            ),
            "read/four.py": "from ..page import tables\n",
            "page/five.py": (
                "from figures import style\nimport read.vtu\nfrom page import tables\nimport"
                " pageant\n"
            ),
        }
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for place, text in planted.items():
                path = folder / place
                path.parent.mkdir(exist_ok=True)
                path.write_text(text, encoding="utf-8")
            self.assertEqual(
                wrong_arrows(folder),
                [
                    "read/four.py:1: ..page",
                    "read/one.py:1: figures",
                    "read/two.py:1: page.tables",
                    "figures/three.py:4: page.tables",
                ],
            )


if __name__ == "__main__":
    unittest.main()
