# SPDX-License-Identifier: MIT
"""homespun converge as a user meets it."""
import json
import math
import unittest

from broken_cells_test import Cell
from cli import LAYERED, LONG, THREE, InFolder, cut, rows_of, run, status_of

TEXTS = {"cell", "study", "case", "quantity", "h_unit", "judgement", "claim", "limit", "kind",
         "kind_of_claim", "derivation", "id"}


class Converge(InFolder):
    def rows(self, kind=None):
        return [row for row in rows_of(self.folder / "converge.csv")
                if kind in (None, row["kind"])]

    def test_quick_run_leaves_finite_numbers_verdicts_and_a_page(self):
        result = run("converge", LAYERED, "--quick", "--studies",
                     "mesh,scale,coarse,strain,time", "--quiet", "--output", self.folder)
        verdicts = json.loads((self.folder / "verdicts.json").read_text())["verdicts"]
        failed = [verdict for verdict in verdicts if verdict["verdict"] == "FAIL"]
        self.assertEqual(failed, [])
        self.assertEqual(result.returncode, status_of(verdicts), result.stderr)
        self.assertEqual((result.stdout, result.stderr), ("", ""))  # quiet, with its page
        for verdict in verdicts:
            self.assertIn(verdict["kind"], ("program", "input", "method"), verdict)
            self.assertTrue(verdict["derivation"], verdict)
        for kind in ("level", "claim", "case"):
            self.assertEqual({row["study"] for row in self.rows(kind)},
                             {"mesh", "scale", "coarse", "strain", "time"})
            for row in self.rows(kind):
                for key, text in row.items():
                    if key not in TEXTS and text:
                        self.assertTrue(math.isfinite(float(text)), (key, row))
        rows = self.rows("level")
        for row in rows:
            self.assertGreater(float(row["h"]), 0.)
            self.assertTrue(row["value"] or row["error"] or row["quantity"].startswith("change"),
                            row)
            if row["judgement"]:
                self.assertLess(float(row["order_lowest"]), float(row["order_highest"]), row)
        # A laminate with a mesh that fits it: closed form, the same at every level.
        for row in rows:
            if row["quantity"].startswith("C11"):
                self.assertAlmostEqual(float(row["value"]), 500 * 5.67982018, delta=0.01)
        self.assertTrue(any("laminate" in verdict["claim"] and verdict["verdict"] == "PASS"
                            for verdict in verdicts))
        study = json.loads((self.folder / "study.json").read_text())
        self.assertTrue(any(item["what"] == "study edges" for item in study["left_out"]))
        self.assertFalse(any(note.startswith("adaptive")
                             for note in study["notes"]), "they did not run")
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertIn("observed orders lie within their limits", page)

    def test_a_resumed_study_runs_only_what_is_missing_and_equals_an_uninterrupted_one(self):
        options = ("converge", LAYERED, "--quick", "--studies", "mesh,time",
                   "--quiet", "--no-report", "--output", self.folder)
        first = run(*options)
        self.assertIn(first.returncode, (0, 4), first.stderr)
        numbers = lambda: [{key: text for key, text in row.items() if key != "seconds"}
                           for row in self.rows()]
        before = numbers()
        path = self.folder / "converge.csv"
        lines = path.read_text().splitlines(keepends=True)
        # The last case counts as not complete.
        path.write_text("".join(lines[:-1]))
        verdicts = (self.folder / "verdicts.json").read_text()
        changed = run(*options, "--resume")  # its tables were changed after it ended
        self.assertEqual(changed.returncode, 2, changed.stdout + changed.stderr)
        cut(self.folder)
        self.assertEqual(run(*options).returncode, first.returncode)
        self.assertTrue(json.loads((self.folder / "study.json").read_text())["resumed"])
        self.assertEqual(numbers(), before)
        self.assertEqual(len(self.rows()), len(lines) - 1)
        strip = lambda text: [(v["claim"], v["verdict"], v["value"])
                              for v in json.loads(text)["verdicts"]]
        self.assertEqual(strip((self.folder / "verdicts.json").read_text()), strip(verdicts))

    def test_rows_of_other_inputs_never_stand_in_the_same_table(self):
        output = self.folder / "out"
        options = ("--quick", "--no-report", "--output", output)
        self.assertIn(run("converge", LAYERED, *options, "--studies",
                          "mesh").returncode, (0, 4))
        table = (output / "converge.csv").read_bytes()
        for other, studies in ((self.cell_with("soft: 400, hard: 400", "soft: 400, hard: 500"),
                                "mesh"),
                               (self.cell_with("hard: 1e7", "hard: 2e7"), "mesh"),
                               (LAYERED, "time")):
            result = run("converge", other, *options, "--studies", studies, "--resume")
            self.assertEqual(result.returncode, 2)
            self.assertIn("holds another run", result.stderr)
            self.assertEqual((output / "converge.csv").read_bytes(), table)
        result = run("converge", LAYERED, *options, "--studies", "time",
                     "--overwrite")
        self.assertIn(result.returncode, (0, 4), result.stderr)
        self.assertIn("the earlier run was replaced", result.stderr)
        self.assertEqual({row["study"] for row in rows_of(output / "converge.csv")}, {"time"})

    def test_an_order_that_so_few_meshes_cannot_show_is_reported_and_open(self):
        # 7,200 triangles: with P1 three adaptive meshes have no more than 60,000 degrees of
        # freedom, and one uniform one.
        n = 60
        cell = Cell(n)
        cell.groups = [2 if min(cell.square_of(t)) >= n // 2 else 1
                       for t in range(len(cell.triangles))]
        path = cell.write(self.folder)
        output = self.folder / "out"
        result = run("converge", path, "--quick", "--studies", "adaptive", "--quiet", "--no-report",
                     "--output", output)
        claims = json.loads((output / "verdicts.json").read_text())["verdicts"]
        self.assertEqual(result.returncode, status_of(claims), result.stderr)
        rows = [row for row in rows_of(output / "converge.csv") if row["kind"] == "level"]
        n_open = 0
        for p in (1, 2):
            levels = [row for row in rows if row["order_p"] == str(p)
                      and row["quantity"].startswith("adaptive")]
            (order,) = [claim for claim in claims
                        if f": P{p}: the width of the adaptive bracket falls" in claim["claim"]]
            if len(levels) < 5:
                self.assertEqual(order["verdict"], "INCONCLUSIVE")
                self.assertIn(f"{len(levels)} levels; this order needs 5", order["limit"])
                n_open += 1
            self.assertFalse(any(f": P{p}: the adaptive bracket is narrower" in claim["claim"]
                                 for claim in claims), p)
        self.assertGreater(n_open, 0)

    def test_brackets_of_laminates_close_and_those_of_corners_fall_faster_on_adaptive_meshes(self):
        result = run("converge", LAYERED, THREE, "--quick",
                     "--studies", "adaptive", "--quiet", "--no-report", "--output", self.folder)
        claims = [{**row, "verdict": row["judgement"]} for row in self.rows("claim")]
        self.assertEqual(result.returncode, status_of(claims), result.stderr)
        self.assertNotEqual(result.returncode, 1, result.stderr)
        self.assertEqual({row["verdict"] for row in claims if row["cell"] == "layered"}, {"PASS"})
        self.assertEqual({row["verdict"] for row in claims
                          if "P2: the adaptive bracket is narrower" in row["claim"]}, {"PASS"})
        rows = self.rows("level")
        self.assertEqual({row["cell"] for row in rows}, {"three-stiffness"})
        for row in rows:
            self.assertAlmostEqual(float(row["h"]), float(row["dofs"]) ** -0.5,
                                   delta=1e-5 * float(row["h"]))

    def test_a_bent_sheet_errs_by_order_1_with_d_h_alone_and_by_2_with_all_terms(self):
        cell = Cell(4)
        result = run("converge", cell.write(self.folder), "--quick", "--studies", "bending",
                     "--no-report", "--output", self.folder / "out")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        rows = [row for row in rows_of(self.folder / "out" / "converge.csv")
                if row["kind"] == "level" and row["case"] == "cantilever-2"]
        errors = {}
        for row in rows:
            errors.setdefault(row["quantity"].split(" [")[0], []).append(float(row["error"]))
        slopes = {name: math.log(some[0] / some[-1]) / math.log(8 / 3)
                  for name, some in errors.items()}
        self.assertAlmostEqual(slopes["affine: mean error of the deflection"], 1, delta=0.2)
        self.assertAlmostEqual(slopes["full: mean error of the deflection"], 2, delta=0.5)
        self.assertLess(errors["full: mean error of the normal"][-1],
                        0.2 * errors["affine+edges: mean error of the normal"][-1])
        claims = json.loads((self.folder / "out" / "verdicts.json").read_text())["verdicts"]
        self.assertEqual(len([one for one in claims if one["id"] == "closer-when-bent"]), 10)
        self.assertEqual([one for one in claims if one["verdict"] == "FAIL"], [])

    @unittest.skipUnless(LONG, "bend_test has the terms of a cell with holes")
    def test_of_a_cell_with_holes_all_terms_are_judged(self):
        cell = Cell()
        cell.keep(lambda i, j: (i, j) != (3, 3))
        result = run("converge", cell.write(self.folder), "--quick", "--studies", "bending",
                     "--no-report", "--output", self.folder / "out")
        self.assertIn(result.returncode, (0, 4), result.stdout + result.stderr)
        levels = [row for row in rows_of(self.folder / "out" / "converge.csv")
                  if row["kind"] == "level"]
        self.assertEqual({row["quantity"].split(":")[0] for row in levels},
                         {"affine", "localized", "affine+edges", "full"})

    def claims_of(self, cell, study):
        """Of one study of a cell, its claims, and the rows of its levels."""
        result = run("converge", cell, "--quick", "--studies", study, "--no-report", "--quiet",
                     "--output", self.folder / "out", "--overwrite")
        claims = json.loads((self.folder / "out" / "verdicts.json").read_text())["verdicts"]
        self.assertEqual(result.returncode, status_of(claims), result.stderr)
        return claims, [row for row in rows_of(self.folder / "out" / "converge.csv")
                        if row["kind"] == "level"]

    def test_a_cell_of_another_size_moves_for_as_long_in_its_own_time(self):
        steps = []
        for unit in ("0.01", "2e-4"):
            cell = self.cell_with("Length unit     = 0.01", f"Length unit     = {unit}")
            claims, levels = self.claims_of(cell, "time")
            # Linearly implicit steps show their order later where a sheet is stiff for its weight.
            self.assertIn(claims[0]["verdict"], ("PASS", "INCONCLUSIVE"), claims)
            self.assertEqual([claim["verdict"] for claim in claims[1:]], ["PASS"] * 2, claims)
            steps.append([float(row["h"]) for row in levels if "Euler" in row["case"]])
        self.assertEqual(steps[0], [0.04 / n for n in (50, 100, 200, 400)] * 2)
        for large, small in zip(*steps):
            self.assertAlmostEqual(small / large, 0.02 ** 0.5, delta=1e-12)

    def test_an_error_at_edges_that_falls_faster_than_theory_is_open_a_slower_one_fails(self):
        cell = Cell(4)
        cell.groups = [1 + cell.square_of(t)[0] // 2 for t in range(len(cell.triangles))]
        cell.keys["Young's modulus"] = "soft: 1e6, hard: 1e9"
        claims, _ = self.claims_of(cell.write(self.folder), "edges")
        (closed,) = [one for one in claims if one["id"] == "edge-order.no-corners"]
        self.assertGreater(closed["value"], 1.1)
        self.assertEqual(closed["verdict"], "INCONCLUSIVE", closed)
        self.assertIn("several powers show together at 1.1 to 2.1", closed["limit"])
        (strip,) = [one for one in claims if "strip-1" in one["claim"]]
        self.assertLess(strip["value"], 0.7)
        self.assertEqual(strip["verdict"], "FAIL", strip)

    def test_where_phases_differ_in_shear_alone_orders_of_pulls_are_open_and_say_why(self):
        cell = Cell(4)
        cell.groups = [2 if max(cell.square_of(t)) < 2 else 1 for t in range(len(cell.triangles))]
        del cell.keys["Young's modulus"], cell.keys["Poisson's ratio"]
        cell.keys["Orthotropic"] = "soft: 1e6 1e6 0.3 3e5 0, hard: 1e6 1e6 0.3 6e5 0"
        claims, _ = self.claims_of(cell.write(self.folder), "strain")
        pulled = [claim for claim in claims if claim["id"] == "method-order.zero"]
        self.assertEqual(len(pulled), 6, claims)
        for claim in pulled:
            self.assertEqual(claim["verdict"], "INCONCLUSIVE", claim)
            self.assertIn("nothing fluctuates", claim["limit"])
        sheared = [claim for claim in claims if claim["id"] == "method-order"]
        self.assertEqual([claim["verdict"] for claim in sheared], ["PASS"] * 6, sheared)

    def test_an_unknown_study_is_refused_with_the_names_there_are(self):
        result = run("converge", LAYERED, "--studies", "mesh,knit", "--output",
                     self.folder)
        self.assertEqual(result.returncode, 2)
        for word in ("--studies", "knit", "edges", "scale"):
            self.assertIn(word, result.stderr)


if __name__ == "__main__":
    unittest.main()
