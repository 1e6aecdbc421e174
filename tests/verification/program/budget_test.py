# SPDX-License-Identifier: MIT
"""What a strain study writes beside its errors: error budget, run times, range of validity."""
import json
import math
import unittest

from broken_cells_test import Cell
from cli import LAYERED, WEAVE, InFolder, cut, rows_of, run

STUDY = ["strain", LAYERED, "--cells", "2", "--strains", "0.01,0.1", "--loads",
         "periodic-12,shear-frame", "--references", "biot", "--methods", "localized", "--no-report"]

NORMS = ("mean_m", "rms_m", "max_m", "mean_per_cell", "share")


class Budget(InFolder):
    def test_a_study_writes_budget_run_times_and_validity_and_judges_the_budget(self):
        result = run(*STUDY, "--verbose", "--output", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("what the parts leave", result.stdout)
        n = len(json.loads((self.folder / "verdicts.json").read_text())["verdicts"])
        self.assertEqual(result.stdout.splitlines()[-1],
                         f"{n} of {n} claims hold (--verbose lists those that hold)")

        budget = rows_of(self.folder / "budget.csv")
        whole = [row for row in budget if row["region"] == "all"]
        # loads, strains; fifteen parts, sum, unexplained and its bar, total
        self.assertEqual(len(whole), 2 * 2 * 19)
        for row in budget:
            is_bar = row["part"] == "unexplained-bar"
            for key in ("mean_m", "mean_per_cell") if is_bar else NORMS:
                self.assertTrue(math.isfinite(float(row[key])), row)
        total = {(row["load"], row["strain"]): float(row["mean_m"]) for row in whole
                 if row["part"] == "total"}
        for row in rows_of(self.folder / "strain.csv"):
            self.assertAlmostEqual(total[row["load"], row["strain"]] / float(row["error_mean_m"]),
                                   1., delta=1e-4)

        energies = [row for row in rows_of(self.folder / "cross-checks.csv")
                    if row["what"] == "energies"]
        self.assertEqual([row["load"] for row in energies], ["shear-frame"])
        for row in energies:
            lower, p2, upper = (float(row[f"energy_{side}_J"]) for side in ("lower", "p2", "upper"))
            self.assertTrue(0. < lower < p2 < upper, row)
            bar = float(row["error_bar_energy_norm"])
            self.assertAlmostEqual(bar, math.sqrt(1. - lower / upper), delta=1e-4 * bar)
            self.assertEqual((row["cells"], row["fault"]), ("2", ""))
            self.assertLess(float(row["seconds_lower"]), float(row["seconds"]))
        claims = [v for v in json.loads((self.folder / "verdicts.json").read_text())["verdicts"]
                  if "in linear theory on 2 x 2 cells" in v["claim"]]
        self.assertEqual([v["verdict"] for v in claims], ["PASS"] * 3)

        ways = {row["way"]: row for row in rows_of(self.folder / "runtime.csv")}
        for way in ("fine-p1", "fine-p2", "fine-corotational", "affine-5", "localized-40", "voigt",
                    "reuss", "nodal-warping"):
            self.assertGreater(float(ways[way]["error_mean_m"]), 0., way)
            self.assertGreater(float(ways[way]["seconds"]), 0., way)
            self.assertEqual(ways[way]["runs"], "5")
        # Two programs for one problem: P1 finite elements, and the cloth's own triangles at full
        # resolution.
        p1, corotational = (float(ways[way]["error_mean_m"])
                            for way in ("fine-p1", "fine-corotational"))
        self.assertAlmostEqual(p1 / corotational, 1., delta=1e-4)

        validity = rows_of(self.folder / "validity.csv")
        self.assertEqual(len(validity), 2 * 5)
        self.assertEqual({row["relation"] for row in validity} - {"=", ">", "-"}, set())
        # Of stripes in closed form at 45 degrees, see cli_test.py; the worst direction is near.
        (radius,) = {row["least_radius_m"] for row in validity}
        self.assertGreater(float(radius), 0.03 * (0.01102 / 0.02) ** 0.5)
        self.assertLess(float(radius), 0.025)
        claims = [v for v in json.loads((self.folder / "verdicts.json").read_text())["verdicts"]
                  if "the parts leave" in v["claim"]]
        self.assertEqual(len(claims), 4)
        self.assertEqual({v["verdict"] for v in claims}, {"PASS"})

    def test_levels_that_are_not_judged_have_part_two_where_its_order_is_read_off_them(self):
        result = run("strain", LAYERED, "--strains", "0.002,0.005,0.01,0.05,0.1", "--loads",
                     "periodic-12", "--references", "biot", "--methods", "localized",
                     "--no-runtime", "--no-report", "--quiet", "--output", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        parts = {}
        for row in rows_of(self.folder / "budget.csv"):
            parts.setdefault(float(row["strain"]), set()).add(row["part"])
        self.assertEqual(sorted(parts), [0.002, 0.005, 0.01, 0.1])
        self.assertEqual(parts[0.002], {"macro-law", "modes", "total"})
        self.assertLess(parts[0.002] | {"sum", "unexplained", "rest"}, parts[0.1])
        claims = json.loads((self.folder / "verdicts.json").read_text())["verdicts"]
        self.assertEqual([v["verdict"] for v in claims if v["id"].startswith("budget-slope")],
                         ["PASS"])

    def test_methods_with_coarse_cloths_of_their_own_have_run_times(self):
        methods = ("localized+edges", "localized+cubic+modes", "localized+p2", "full")
        result = run("strain", LAYERED, "--cells", "4", "--strains", "0.01",
                     "--loads", "shear-frame", "--references", "biot", "--methods",
                     ",".join(("localized",) + methods), "--no-budget", "--no-report", "--quiet",
                     "--output", self.folder)
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        ways = {row["way"]: row for row in rows_of(self.folder / "runtime.csv")}
        for method in methods:
            row = ways[f"{method}-4"]
            self.assertGreater(float(row["seconds"]), 0., method)
            self.assertEqual(row["triangles"], "8" if method in ("localized+p2", "full") else "32",
                             method)
            self.assertEqual((row["runs"], row["ranks"]), ("5", "1"), method)
        # Against P1 the same positions err by as much, to the distance between P1 and P2.
        for row in rows_of(self.folder / "strain.csv"):
            if row["method"] in methods:
                self.assertLessEqual(abs(float(ways[row["method"] + "-4"]["error_mean_m"]) -
                                         float(row["error_mean_m"])),
                                     float(ways["fine-p1"]["error_mean_m"]), row["method"])

    def test_of_a_weave_run_times_are_those_under_its_law(self):
        result = run("strain", WEAVE, "--cells", "2", "--strains", "0.01",
                     "--loads", "shear-frame", "--methods", "localized,full-cubic-modes,full",
                     "--no-budget", "--no-report", "--quiet", "--output", self.folder)
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        ways = {row["way"]: row for row in rows_of(self.folder / "runtime.csv")}
        self.assertEqual({row["reference"] for row in ways.values()}, {"yarn"})
        for way in ("fine-corotational", "nodal-warping"):
            self.assertEqual(ways[way]["error_mean_m"], "")
            self.assertIn("its law is biot", ways[way]["note"])
        p1 = float(ways["fine-p1"]["error_mean_m"])
        for row in rows_of(self.folder / "strain.csv"):
            if row["method"] == "localized":  # whose rows are at other numbers of quads
                continue
            way = ways[row["method"] + "-2"]
            self.assertGreater(float(way["seconds_step"]), 0., row)
            self.assertGreater(float(way["seconds_upsample"]), 0., row)
            self.assertLessEqual(abs(float(way["error_mean_m"]) - float(row["error_mean_m"])), p1,
                                 row)

    def test_of_a_cell_with_holes_the_way_of_reuss_is_left_out(self):
        cell = Cell(4)
        cell.keep(lambda i, j: (i, j) != (1, 1))
        result = run("strain", cell.write(self.folder), "--cells", "2", "--strains", "0.01",
                     "--loads", "shear-frame", "--references", "biot", "--methods", "localized",
                     "--no-budget", "--no-report", "--quiet", "--output", self.folder / "out")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        ways = {row["way"]: row for row in rows_of(self.folder / "out" / "runtime.csv")}
        self.assertGreater(float(ways["voigt"]["error_mean_m"]), 0.)
        self.assertEqual(ways["reuss"]["error_mean_m"], "")
        self.assertIn("holes", ways["reuss"]["note"])

    def test_a_method_that_lacks_terms_here_has_a_row_of_run_times_that_says_so(self):
        methods = ("localized+p2", "localized+cubic", "full", "localized+edges")
        result = run("strain", WEAVE, "--cells", "3", "--strains", "0.01",
                     "--loads", "shear-frame", "--methods",
                     ",".join(methods), "--no-budget", "--no-report", "--quiet",
                     "--output", self.folder)
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        ways = {row["way"]: row for row in rows_of(self.folder / "runtime.csv")}
        for method, why in zip(methods, ("without p2", "it is localized", "without p2", "")):
            row = ways[f"{method}-3"]
            self.assertIn(why, row["note"])
            self.assertEqual((row["seconds"] == "", row["note"].startswith("left out: ")),
                             (why != "", why != ""), row)

    def test_a_budget_cut_at_any_row_is_completed(self):
        study = [*STUDY, "--no-runtime", "--quiet", "--output", self.folder]
        self.assertEqual(run(*study).returncode, 0)
        path = self.folder / "budget.csv"
        text = path.read_text()
        strain = (self.folder / "strain.csv").read_text()

        def totals():
            return {(row["load"], row["strain"], row["part"], row["region"]): float(row["mean_m"])
                    for row in rows_of(path) if row["part"] in ("total", "sum")}
        expected = totals()
        path.write_text(text[:int(0.6 * len(text))])
        cut(self.folder)
        self.assertEqual(run(*study, "--resume").returncode, 0)
        found = totals()
        self.assertEqual(found.keys(), expected.keys())
        self.assertEqual(len(path.read_text().splitlines()), len(text.splitlines()))
        for key, value in expected.items():
            self.assertAlmostEqual(found[key], value, delta=1e-4 * value)
        self.assertEqual((self.folder / "strain.csv").read_text(), strain)

    def test_what_is_left_out_is_not_written(self):
        result = run(*STUDY, "--no-budget", "--no-runtime", "--quiet", "--output", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertFalse((self.folder / "budget.csv").exists())
        self.assertFalse((self.folder / "cross-checks.csv").exists())
        self.assertFalse((self.folder / "runtime.csv").exists())
        self.assertTrue((self.folder / "validity.csv").exists())


if __name__ == "__main__":
    unittest.main()
