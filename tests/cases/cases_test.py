# SPDX-License-Identifier: MIT
"""Small inputs of the kinds that people report in public trackers, each with what the program must
say of it. A row of cases.json is a test:

folder   of the files, of which the command gets a copy that it runs in
command  the words behind `homespun`
status   the exit status
says     what stdout and stderr together must contain
silent   what they must not contain
C        the stiffness of out/homogenize.json [N/m], to within 1e-10 of its largest entry, or to
         within `C_tolerance` of it
"""
import json
import pathlib
import shutil
import sys
import unittest

CASES = pathlib.Path(__file__).resolve().parent
sys.path.append(str(CASES.parent / "verification" / "program"))
from cli import InFolder, run  # noqa: E402

ROWS = json.loads((CASES / "cases.json").read_text(encoding="utf-8"))


class Cases(InFolder):
    def try_row(self, row):
        place = self.folder / "case"
        shutil.copytree(CASES / row["folder"], place)
        result = run(*row["command"].split(), cwd=place)
        self.assertEqual(result.returncode, row["status"], result.stdout)
        said = result.stdout + result.stderr
        for words in row.get("says", []):
            self.assertIn(words, said)
        for words in row.get("silent", []):
            self.assertNotIn(words, said)
        if "C" in row:
            found = json.loads((place / "out" / "homogenize.json").read_text())["C"]
            largest = max(abs(entry) for line in row["C"] for entry in line)
            for line, expected in zip(found, row["C"], strict=True):
                for one, other in zip(line, expected, strict=True):
                    self.assertAlmostEqual(one, other,
                                           delta=row.get("C_tolerance", 1e-10) * largest)


def test_of(row):
    return lambda self: self.try_row(row)


for number, one_row in enumerate(ROWS):
    setattr(Cases, f"test_{number:03d}_{one_row['folder']}", test_of(one_row))


class Folders(unittest.TestCase):
    def test_every_folder_has_a_row_and_all_together_are_small(self):
        self.assertEqual({row["folder"] for row in ROWS},
                         {path.name for path in CASES.iterdir()
                          if path.is_dir() and path.name != "__pycache__"})
        size = sum(path.stat().st_size for path in CASES.rglob("*") if path.is_file())
        self.assertLess(size, 1 << 20)


if __name__ == "__main__":
    unittest.main()
