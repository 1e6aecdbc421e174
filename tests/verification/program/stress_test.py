# SPDX-License-Identifier: MIT
"""homespun stress: its axes, its tables, and that no published limit falls unsaid."""
import csv
import json
import re
import unittest

from cli import CELLS, InFolder, rows_of, run, status_of

ROOT = CELLS.parents[1]
PUBLISHED = ROOT / "verification" / "published" / "limits.csv"


def fallen(rows, published):
    """(axis, of) of limits below those that are published."""
    shipped = {(row["axis"], row["of"]): float(row["reached"] or 0) for row in published}
    return [(row["axis"], row["of"]) for row in rows
            if row["end"] and
            float(row["end"]) <= (1 + 1e-6) * shipped.get((row["axis"], row["of"]), 0)]


def unsaid(axes, changelog):
    """Those that no line of the CHANGELOG above the first release names."""
    text = re.split(r"(?m)^## \[?\d", changelog)[0]
    return [axis for axis in axes if not re.search(rf"(?m)^.*limit.*`{re.escape(axis[0])}`", text)]


class Stress(InFolder):
    def test_no_limit_falls_and_every_axis_is_a_row(self):
        study = ["stress", CELLS / "layered.prm", "--quick", "--quiet", "--no-report", "--output",
                 self.folder]
        result = run(*study)
        rows = rows_of(self.folder / "limits.csv")
        self.assertGreater(len(rows), 25)
        with open(PUBLISHED, encoding="utf-8", newline="") as file:
            published = list(csv.DictReader(file))
        self.assertLessEqual({(row["axis"], row["of"]) for row in rows},
                             {(row["axis"], row["of"]) for row in published})
        changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
        self.assertEqual(unsaid(fallen(rows, published), changelog), [])
        for row in rows:
            self.assertTrue(row["why"] and row["criterion"] and float(row["limit"]) > 0., row)
            if row["end"] and row["reached"]:
                self.assertGreater(float(row["end"]), float(row["reached"]), row)
        rungs = rows_of(self.folder / "stress.csv")
        for row in rows:  # the row of an axis is that of its values
            right = [float(rung["value"]) for rung in rungs if rung["outcome"] == "right"
                     and (rung["axis"], rung["of"]) == (row["axis"], row["of"])]
            self.assertEqual(float(row["reached"] or 0), max(right, default=0.), row)
        verdicts = json.loads((self.folder / "verdicts.json").read_text())["verdicts"]
        limited = {(row["axis"], row["of"]) for row in published if row["reached"]}
        self.assertEqual(len(verdicts), sum((row["axis"], row["of"]) in limited for row in rows))
        self.assertEqual(result.returncode, status_of(verdicts))
        self.assertEqual(result.returncode, 1 if fallen(rows, published) else 0, result.stderr)
        study_of = json.loads((self.folder / "study.json").read_text())
        self.assertEqual(study_of["axes"], len(rows))
        # The same once more: every row is there.
        text = (self.folder / "limits.csv").read_text()
        self.assertEqual(run(*study).returncode, result.returncode)
        self.assertEqual((self.folder / "limits.csv").read_text(), text)
        self.assertTrue(json.loads((self.folder / "study.json").read_text())["resumed"])
        # Another run is refused, with what differs; so are rows that somebody edited.
        other = run("stress", "--quick", "--no-report", "--resume", "--output", self.folder)
        self.assertEqual(other.returncode, 2)
        self.assertIn("expected the same to --resume", other.stderr)
        self.assertEqual(text, (self.folder / "limits.csv").read_text())
        (self.folder / "limits.csv").write_text(text.replace("ladder", "solver"))
        edited = run(*study)
        self.assertEqual(edited.returncode, 2)
        self.assertIn("limits.csv: was changed after the run ended", edited.stderr)


    def test_another_cell_of_a_shipped_name_has_no_published_limits(self):
        output = self.folder / "study"
        run("stress", self.cell_with("hard: 1e7", "hard: 2e7"), "--quick", "--quiet", "--no-report",
            "--output", output)
        self.assertGreater(len(rows_of(output / "limits.csv")), 25)
        self.assertNotIn("published", (output / "verdicts.json").read_text(encoding="utf-8"))


class Limits(unittest.TestCase):
    row = {"axis": "contrast", "of": "layered", "reached": "1e6", "end": "1e7"}

    def test_a_limit_that_falls_is_found(self):
        for reached, falls in (("1e6", False), ("1e7", True), ("1e9", True), ("", False)):
            found = fallen([self.row], [{**self.row, "reached": reached}])
            self.assertEqual(found, [("contrast", "layered")] * falls, reached)
        self.assertEqual(fallen([{**self.row, "end": ""}], [{**self.row, "reached": "1e9"}]), [])

    def test_the_changelog_may_say_so(self):
        axis = [("contrast", "layered")]
        self.assertEqual(unsaid(axis, "# Changelog\n- Nothing of contrast.\n"), axis)
        self.assertEqual(unsaid(axis, "- The limit of the axis `contrast` falls to 1e6.\n"), [])
        self.assertEqual(unsaid(axis, "## 0.1.0\n- The limit of `contrast` falls.\n"), axis)


if __name__ == "__main__":
    unittest.main()
