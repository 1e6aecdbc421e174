# SPDX-License-Identifier: MIT
"""The published table of sheets that bend, and its section of docs/results.md; and what texts say
of all tables in words: how many cases, which, of which revision.
"""
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
PUBLISHED = ROOT / "verification" / "published"
sys.path[:0] = [str(PUBLISHED),
                str(ROOT / "tests" / "verification" / "report")]

# pylint: disable=wrong-import-position
import report_path  # noqa: E402, F401
import bent_section  # noqa: E402
import of_bend  # noqa: E402
import peers_section  # noqa: E402
import published  # noqa: E402
import results_page  # noqa: E402
from made_up_run import verdict, write_run, write_table, write_verdicts  # noqa: E402
from read import schema  # noqa: E402
from readme_numbers import read_tables  # noqa: E402

SIDE = 0.02
ERRORS = {"affine": 0.2, "localized": 0.25, "affine+edges": 0.1, "full": 0.05}


def write_bend(folder):
    """Two curvatures of which the errors are proportional, and one sheet at large turns."""
    os.makedirs(folder)
    of_case = {"cell": "dots", "load": "twist", "cells": 10, "cell_side_m": SIDE,
               "macro_triangles": 8, "fine_triangles": 32, "curvature_per_m": 1.}
    write_table(folder, "bend.csv", [
        {**of_case, "curvature_times_cell": k, "reference": reference, "method": method,
         "error_mean_m": error * k * SIDE * factor, "error_bar_m": 0.01 * k * SIDE,
         "normal_error_mean_rad": 2. * error * k * factor, "normal_error_bar_rad": 0.02 * k}
        for reference, factor in (("linear", 1.), ("biot", 7.))
        for k in (0.01, 0.1) for method, error in ERRORS.items()])
    write_verdicts(folder, [
        verdict(schema.claims()[claim]["claim"].format(cell="dots", load="twist", what=what,
                                                       method=method), outcome, kind="method")
        for what in of_bend.QUANTITIES
        for (claim, method), outcome in zip(of_bend.CLAIMS.values(), ("PASS", "FAIL"))])
    write_run(folder, "bend")


class PublishedBendTest(unittest.TestCase):
    def rows(self):
        with tempfile.TemporaryDirectory() as place:
            folder = os.path.join(place, "bend")
            write_bend(folder)
            return published.rows_of([folder])["bending.csv"]

    def test_errors_are_in_thousandths_of_curvature_and_cell_once_for_all_curvatures(self):
        position, normal = self.rows()
        self.assertEqual([(row["what"], row["full_against_base"], row["localized_against_affine"])
                          for row in (position, normal)],
                         [("position", "PASS", "FAIL"), ("normal", "PASS", "FAIL")])
        for method, error in ERRORS.items():
            self.assertAlmostEqual(position[method], 1000. * error)
            self.assertAlmostEqual(normal[method], 2000. * error)
        self.assertAlmostEqual(position["full_bar"], 10.)
        self.assertAlmostEqual(normal["full_bar"], 20.)
        self.assertTrue(math.isnan(position["flat"]))

    def test_the_section_has_the_gain_over_the_better_base_and_names_losses(self):
        rows = [{name: published.field(value) for name, value in row.items()}
                for row in self.rows()]
        text = "\n".join(bent_section.section(rows, ["dots", "net"])).replace("\u00a0", " ")
        self.assertIn("| `dots` | twist | – | 200 ± 10 | 250 ± 10 | 100 ± 10 | 50.0 ± 10 | 2.00 |"
                      " nearer |", text)
        self.assertIn("Not run yet: `net`.\n", text)
        self.assertIn("Positions, 1 cases: `full` is nearer than its base in 1, farther in 0", text)
        self.assertIn("is farther than D^H alone in 1: `dots` twist.", text)


class TextsTest(unittest.TestCase):
    """What texts say of the tables in words."""

    def test_every_revision_is_in_the_history(self):
        def git(*words):
            return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True,
                                  check=False)

        if git("rev-parse", "--is-shallow-repository").stdout.strip() != "false":
            self.skipTest("no history here")
        for name, rows in read_tables(PUBLISHED).items():
            for revision in {row["revision"] for row in rows if row.get("revision")}:
                self.assertEqual(git("merge-base", "--is-ancestor", revision, "HEAD").returncode,
                                 0, f"{name}: {revision}")

    def test_the_front_page_counts_operators_in_every_case_that_is_clamped_as_in_training(self):
        nearer = {True: 0, False: 0}  # by more than both bars, or not
        for _, tested, _, its in peers_section.cases(read_tables(PUBLISHED)["peers.csv"]):
            own = its.get(("full", ""))
            some = [row for (method, on), row in its.items() if method.startswith("learned")
                    and (on == "both pairs" or tested == "strip-1")]
            for by_bars in nearer if own else ():
                nearer[by_bars] += any(peers_section.is_nearer(row, own, by_bars) for row in some)
        words = dict(enumerate("no one two three four five six seven eight nine ten".split()))
        text = re.sub(r"<!--.*?-->", "", (ROOT / "README.md").read_text(encoding="utf-8"))
        self.assertIn(f"beat `full` in {words[nearer[False]]} of 24 cases,"
                      f" {words[nearer[True]]} beyond both bars", text)

    def test_every_level_and_scene_that_no_run_got_right_is_named(self):
        tables = read_tables(PUBLISHED)
        text = (ROOT / "guides" / "findings.md").read_text(encoding="utf-8")
        _, _, reached = text.partition("At the size of the results")
        of_loads, _, of_frames = reached.partition("under all three loads")
        named = {(cell, load) for part, loads in (
                     (of_loads, ("strip-1", "strip-2", "shear-frame")),
                     (of_frames.partition("in shear frames")[0], ("shear-frame",)))
                 for cell in re.findall("`([a-z0-9-]+)`", part) for load in loads}
        self.assertEqual(named, {(row["cell"], row["load"]) for row in tables["errors.csv"]
                                 if not row["full"]})
        limits = (ROOT / "guides" / "limits.md").read_text(encoding="utf-8")
        for row in tables["limits.csv"]:
            scene, _, cell = row["of"].partition(", ")
            if (row["axis"], scene, row["reached"]) == ("time step", "scene pull", ""):
                self.assertIn(f"`{cell}`", limits)
                self.assertIn(f"its error is {float(row['error']):.3g}", limits)


if __name__ == "__main__":
    unittest.main()
