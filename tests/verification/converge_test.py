# SPDX-License-Identifier: MIT
"""homespun converge as a user meets it."""
import csv
import json
import math
import unittest

from cli import CELLS, InFolder, run

TEXTS = {"cell", "study", "case", "quantity", "h_unit", "judgement", "claim", "verdict", "limit", "note"}


class Converge(InFolder):
    def rows(self, name):
        with open(self.folder / name, encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_quick_run_leaves_finite_numbers_verdicts_and_a_page(self):
        result = run("converge", CELLS / "layered.prm", "--quick", "--studies", "mesh,scale,coarse,strain,time",
                     "--quiet", "--output", self.folder)
        verdicts = json.loads((self.folder / "verdicts.json").read_text())["verdicts"]
        failed = [verdict for verdict in verdicts if verdict["verdict"] == "FAIL"]
        self.assertEqual(failed, [])
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.rows("converge.csv")
        self.assertEqual({row["study"] for row in rows}, {"mesh", "scale", "coarse", "strain", "time"})
        for table in ("converge.csv", "claims.csv", "cases.csv"):
            for row in self.rows(table):
                for key, text in row.items():
                    if key not in TEXTS and text:
                        self.assertTrue(math.isfinite(float(text)), (table, key, row))
        for row in rows:
            self.assertGreater(float(row["h"]), 0.)
            self.assertTrue(row["value"] or row["error"] or row["quantity"].startswith("change"), row)
            if row["judgement"]:
                self.assertLess(float(row["order_lowest"]), float(row["order_highest"]), row)
        # A laminate with a mesh that fits it: closed form, the same at every level.
        for row in rows:
            if row["quantity"].startswith("C11"):
                self.assertAlmostEqual(float(row["value"]), 500 * 5.67982018, delta=0.01)
        self.assertTrue(any("laminate" in verdict["claim"] and verdict["verdict"] == "PASS" for verdict in verdicts))
        study = json.loads((self.folder / "study.json").read_text())
        self.assertTrue(any(item["what"] == "study manufactured" for item in study["left_out"]))
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertIn("observed orders lie within their limits", page)

    def test_a_resumed_study_runs_only_what_is_missing_and_equals_an_uninterrupted_one(self):
        options = ("converge", CELLS / "layered.prm", "--quick", "--studies", "mesh,time", "--quiet", "--no-report",
                   "--output", self.folder)
        self.assertEqual(run(*options).returncode, 0)
        numbers = lambda: [{key: text for key, text in row.items() if key != "seconds"}
                           for row in self.rows("converge.csv")]
        before = numbers()
        lines = (self.folder / "cases.csv").read_text().splitlines(keepends=True)
        (self.folder / "cases.csv").write_text("".join(lines[:-1]))  # the last case counts as not complete
        verdicts = (self.folder / "verdicts.json").read_text()
        self.assertEqual(run(*options, "--resume").returncode, 0)
        self.assertEqual(numbers(), before)
        self.assertEqual(len(self.rows("cases.csv")), len(lines) - 1)
        strip = lambda text: [(v["claim"], v["verdict"], v["value"]) for v in json.loads(text)["verdicts"]]
        self.assertEqual(strip((self.folder / "verdicts.json").read_text()), strip(verdicts))
        # Rows of another cell never stand in the same table.
        other = self.cell_with("hard: 1e7", "hard: 2e7")
        result = run("converge", other, "--quick", "--resume", "--output", self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("inputs.json", result.stderr)

    def test_brackets_of_laminates_close_and_those_of_corners_fall_faster_on_adaptive_meshes(self):
        result = run("converge", CELLS / "layered.prm", CELLS / "three-stiffness.prm", "--quick", "--studies",
                     "adaptive", "--quiet", "--no-report", "--output", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        claims = self.rows("claims.csv")
        self.assertEqual({row["verdict"] for row in claims if row["cell"] == "layered"}, {"PASS"})
        self.assertEqual({row["verdict"] for row in claims if "P2: the adaptive bracket is narrower" in row["claim"]}, {"PASS"})
        rows = self.rows("converge.csv")
        self.assertEqual({row["cell"] for row in rows}, {"three-stiffness"})
        for row in rows:
            self.assertAlmostEqual(float(row["h"]), float(row["dofs"]) ** -0.5, delta=1e-5 * float(row["h"]))

    def test_an_unknown_study_is_refused_with_the_names_there_are(self):
        result = run("converge", CELLS / "layered.prm", "--studies", "mesh,knit", "--output", self.folder)
        self.assertEqual(result.returncode, 2)
        for word in ("--studies", "knit", "manufactured", "scale"):
            self.assertIn(word, result.stderr)


if __name__ == "__main__":
    unittest.main()
