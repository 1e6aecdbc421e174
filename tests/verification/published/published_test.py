# SPDX-License-Identifier: MIT
"""Every number of the front page and of the guides on results comes from a file of
verification/published, and docs/results.md is the page of these files.

A number without one is a fault.
"""
import math
import os
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
PUBLISHED = ROOT / "verification" / "published"
sys.path[:0] = [str(PUBLISHED), str(ROOT / "tests" / "verification" / "report")]

# pylint: disable=wrong-import-position
import report_path  # noqa: E402, F401
import of_strain  # noqa: E402
import published  # noqa: E402
from made_up_run import list_again, verdict, write_run, write_table, write_verdicts  # noqa: E402
from made_up_study import write_results, write_stress  # noqa: E402
from read import schema  # noqa: E402
from read.stored import BadResults  # noqa: E402
import peers_section  # noqa: E402
import results_page  # noqa: E402
from readme_numbers import faults_of, is_printed_as, read_tables  # noqa: E402

TABLES = {"errors.csv": [{"cell": "layered", "load": "strip-1", "affine": "51.27",
                          "localized": "49.71", "bar": "1.44"},
                         {"cell": "layered", "load": "strip-2", "affine": "204.9",
                          "localized": "8.8123", "bar": ""}]}
KEYS = {"errors.csv": ("cell", "load")}
MARKED = [ROOT / "README.md", *((ROOT / "guides" / f"{name}.md") for name in ("findings", "trust"))]


class ReadmeTest(unittest.TestCase):
    @unittest.skipUnless(list(PUBLISHED.glob("*.csv")), "nothing is published yet")
    def test_every_number_of_the_front_page_is_that_of_its_file(self):
        for path in MARKED:
            text = results_page.with_gains(path.read_text(encoding="utf-8"), [])
            self.assertEqual(faults_of(text, read_tables(PUBLISHED), published.KEYS), [], path)

    def test_no_line_begins_with_a_mark_which_would_end_its_paragraph(self):
        for path in MARKED:
            self.assertNotRegex(path.read_text(encoding="utf-8"), r"(?m)^\s*<!--")

    def test_the_page_of_results_and_the_table_of_the_front_page_are_those_of_the_tables(self):
        front, tables = MARKED[0].read_text(encoding="utf-8"), read_tables(PUBLISHED)
        for text, again in (
                ((ROOT / "docs" / "results.md").read_text(encoding="utf-8"),
                 results_page.page(tables)),
                (front, results_page.with_gains(front, tables["errors.csv"]))):
            self.assertEqual(text, again, "`cmake --build --preset release --target docs` writes"
                                          " both again")
        self.assertIn(results_page.gains(tables["errors.csv"]), front)

    @unittest.skipUnless(list(PUBLISHED.glob("*.csv")), "nothing is published yet")
    def test_every_published_row_says_of_which_run_and_revision_it_is(self):
        for name, rows in read_tables(PUBLISHED).items():
            self.assertTrue(rows, name)
            self.assertTrue(all(row["run"] and row["revision"] for row in rows), name)

    def test_no_tested_frame_of_a_peer_is_a_sum_of_frames_that_it_was_trained_on(self):
        rows = read_tables(PUBLISHED)["peers.csv"]
        trained = [row for row in rows if row["trained_on"]]
        self.assertTrue(all(float(row["outside_training"]) > 1e-3 for row in trained))
        self.assertEqual({row["method"] for row in trained},
                         {"learned_8", "learned_32", "pod"})

    def test_a_peer_is_nearer_by_more_than_both_bars_or_that_is_open_and_every_case_is_named(self):
        def row(cell, method, error, bar, on=""):
            return {"cell": cell, "tested": "strip-1", "law": "linear", "method": method,
                    "trained_on": on, "error": error, "error_bar": bar}
        rows = [row("dots", "full", "5.0", "1"), row("dots", "localized", "2.5", ""),
                row("dots", "smooth", "2.9", "1"), row("dots", "flat", "3.1", "1"),
                row("dots", "pod", "1.0", "0.1", "both pairs"),
                row("net", "full", "5.0", "0.5"),
                row("net", "learned_8", "4.4", "0.2", "both pairs"),
                row("holes", "full", "5.0", "0.5"),
                row("holes", "learned_8", "5.6", "0.2", "both pairs"),
                row("twill", "full", "5.0", "0.5"), row("twill", "flat", "5.8", "0.2"),
                row("twill", "smooth", "5.6", "0.2"), row("knit", "full", "5.0", "0.5"),
                row("knit", "flat", "5.8", "0.2")]
        text = "\n".join(peers_section.winners(rows)).replace(results_page.UNBROKEN, " ")
        full, paper = text.split("Against the paper's method, ")
        self.assertTrue(full.startswith(
            "Against `full`, 5 cases have error bars. A peer is nearer by more than the sum of both"
            " bars in 1 of them; `full` is nearer than every peer, by more than both bars, in 1; 3"
            " are open."), full)
        decided, is_open = full.split("A peer is nearer by less than both bars")
        self.assertIn("- `dots`, strip-1, linear: smooth 2.90 ± 1.00; against 5.00 ± 1.00.\n",
                      decided)
        self.assertIn("- `net`, strip-1, linear: learned 8 *all* 4.40 ± 0.20; against 5",
                      is_open)
        self.assertNotIn("holes", full)
        self.assertIn("0 cases have error bars", paper)  # and what has none decides nothing
        self.assertNotIn("dots", paper)

    def test_the_guides_say_in_how_many_cases_a_peer_is_nearer(self):
        found = peers_section.outcomes(read_tables(PUBLISHED)["peers.csv"], "full")
        n = {outcome: len(found[outcome]) for outcome in ("peer", "method", "open")}
        names = ("none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine",
                 "ten", "eleven", "twelve")
        for guide in ("own-method", "findings"):
            text = " ".join((ROOT / "guides" / f"{guide}.md").read_text(encoding="utf-8").split())
            self.assertRegex(text, rf"in {names[n['peer']]} of (<!--[^>]*-->)?"
                                   rf"{sum(n.values())} cases")
            self.assertIn(f"{names[n['method']]} are decided for `full`", text)
            for cell in {one[0] for one in found["peer"]}:
                self.assertRegex(text, rf"in {names[n['peer']]} of .*`{cell}`")

    def test_a_flat_surface_is_affine_written_again(self):
        for *_, its in peers_section.cases(read_tables(PUBLISHED)["peers.csv"]):
            if ("affine", "") in its:
                self.assertEqual(its["affine", ""]["error"], its["flat", ""]["error"])


class CheckerTest(unittest.TestCase):
    def faults(self, text):
        return faults_of(text, TABLES, KEYS)

    def test_a_number_in_a_sentence_is_held_against_its_row(self):
        mark = "<!-- published: errors.csv layered/strip-2 localized -->"
        sentence = f"Across the stripes {mark} **8.8** is left"
        self.assertEqual(self.faults(sentence), [])
        self.assertEqual(self.faults(sentence.replace("8.8", "8.9")),
                         ["line 1: says 8.9; errors.csv, layered/strip-2, localized has 8.8123"])
        self.assertIn("no row", self.faults(sentence.replace("strip-2", "strip-4"))[0])
        self.assertIn("no column", self.faults(sentence.replace(" localized ", " local "))[0])
        self.assertIn("stands no number", self.faults(f"a {mark} few")[0])

    def test_a_mark_may_stand_for_several_rows(self):
        def faults(fold, number):
            mark = f"<!-- published: errors.csv 'layered/*' localized{fold} -->"
            return self.faults(mark + number)
        for fold, number in ((":min", "8.8"), (":max", "49.7"), (":count", "2"), (":sum", "58.5")):
            self.assertEqual(faults(fold, number), [])
            self.assertEqual(len(faults(fold, "7")), 1)
        self.assertIn("has 2 rows", faults("", "8.8")[0])

    def test_a_mark_may_ask_for_a_ratio_or_count_the_rows_of_a_comparison(self):
        for column, number in (("affine/localized:max", "23.3"), ("affine/bar:min", "35.6"),
                               ("localized>affine:count", "0"), ("affine>bar:count", "1"),
                               ("affine>localized:count", "2"),
                               ("load=strip-1:count", "1"), ("load=strip:count", "0")):
            mark = f'<!-- published: errors.csv "layered/*" {column} -->'
            self.assertEqual(self.faults(mark + number), [], column)
            self.assertEqual(len(self.faults(mark + "77")), 1)
        self.assertIn("no column `b`",
                      self.faults('<!-- published: errors.csv "*" affine/b:min -->1')[0])

    def test_a_number_without_a_mark_is_a_fault_outside_of_code_and_of_what_is_no_result(self):
        self.assertEqual(self.faults("\nIt is 3.7 times faster."),
                         ["line 2: 3.7 has no mark `<!-- published: FILE ROW COLUMN -->`"])
        for text in ("```sh\nsleep 20\n```", "`--strains 0.6`", "20 x 20 cells",
                     "the paper's Eq. 8", "at 1 % strain", "Debian 12", "P1, L2, C^H",
                     "Exit status: 0 all hold, 1 one failed,\n2 bad input", "[here](a/7.html)"):
            self.assertEqual(self.faults(text), [], text)

    def test_rounding_is_to_the_digits_of_the_text(self):
        for value, good, bad in (("8.8123", ("8.8", "8.81", "9"), ("8.80", "8.9", "10")),
                                 ("1183.2", ("1183", "1180", "1,183"), ("1200", "1190")),
                                 ("97.2", ("97",), ("100",)),
                                 ("9.64e-4", ("9.6e-4", "0.00096", "1e-3"), ("9.7e-4", "0.00097")),
                                 ("-0.99", ("-0.99", "−0.99"), ("0.99",)),
                                 ("0", ("0", "0.0"), ("0.1",)), ("", (), ("0",))):
            for text in good:
                self.assertTrue(is_printed_as(value, text), (value, text))
            for text in bad:
                self.assertFalse(is_printed_as(value, text), (value, text))


def write_strain(folder, cell="dots", law="biot"):
    """A run of `strain` with one sheet: reached at 1 % strain, not at 10 %, where the law is lost.
    """
    os.makedirs(folder)
    errors = {"affine": 0.2, "full-micro": 0.1, "affine+p2": 0.12, "localized": 0.08, "full": 0.05}
    of_case = {"cell": cell, "load": "strip-1", "reference": law}
    level = {**of_case, "cells": 20, "coarse_triangles": 8, "fine_triangles": 32}
    write_table(folder, "strain.csv", [
        {**level, "strain": strain, "method": method, "error_mean_m": error * strain * 0.03,
         "error_mean_per_cell": error * strain, "error_bar_m": 0.01 * strain * 0.03,
         "error_bar_safety": 3.0 if method == "full-micro" else 1.25}
        for strain in (0.01, 0.02) for method, error in errors.items()
    ] + [{**level, "strain": 0.1, "method": "unreached"},
         {**level, "load": "periodic-11", "strain": 0.01, "method": "affine"}])
    write_table(folder, "gains.csv", [
        {**of_case, "strain": 0.01, "method": "full", "base": "full-micro",
         "gain_of_coarse_cloth": 2.0, "gain_of_upsampling": 2.0, "gain_total": 4.0},
        {**of_case, "strain": 0.01, "method": "localized", "base": "affine",
         "gain_of_coarse_cloth": 1.0, "gain_of_upsampling": 2.5, "gain_total": 2.5}])
    write_table(folder, "validity.csv", [
        {**of_case, "method": "full", "measure": "cell side", "limit": 0.01, "relation": "-",
         "elliptic_up_to": 0.0625}])
    write_verdicts(folder, [
        verdict(schema.claims()[claim]["claim"].format(**of_case, method=method, strain=strain),
                outcome if strain == "0.01" else "INCONCLUSIVE", kind="method")
        for strain in ("0.01", "0.1")
        for (claim, method), outcome in zip(of_strain.CLAIMS.values(),
                                            ("PASS", "FAIL", "INCONCLUSIVE"))])
    write_run(folder)


class PublishTest(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = place.name

    def folder(self, name, write, **options):
        path = os.path.join(self.place, name)
        write(path, **options)
        return path

    def test_errors_and_bars_are_in_thousandths_of_strain_and_side_and_gains_those_of_the_run(self):
        small, large = published.rows_of([self.folder("strain", write_strain)])["errors.csv"]
        for key, value in {"affine": 200., "base": 100., "localized": 80., "full": 50.,
                           "full_bar": 10., "base_bar": 10., "gain_of_coarse_cloth": 2.,
                           "gain_of_upsampling": 2., "gain_total": 4., "gain_over_localized": 1.6,
                           "bar_safety": 3., "law_lost_at": 0.0625}.items():
            self.assertAlmostEqual(small[key], value, places=9, msg=key)
        self.assertEqual([small[key] for key in ("set", "cell", "load", "strain", "base_method",
                                                 "revision", *of_strain.CLAIMS)],
                         ["cells", "dots", "strip-1", "0.01", "full-micro", "abc1234", "PASS",
                          "FAIL", "INCONCLUSIVE"])
        self.assertEqual((large["strain"], large["base_method"], large["full_against_base"],
                          large["law_lost_at"]), ("0.1", "", "INCONCLUSIVE", 0.0625))
        for key in ("affine", "base", "full", "full_bar", "gain_total", "bar_safety"):
            self.assertTrue(math.isnan(large[key]), key)

    def test_cells_weaves_and_drawn_weaves_are_sets_of_their_own(self):
        rows = published.rows_of([
            self.folder(f"{cell}/strain", write_strain, cell=cell, law=law)
            for cell, law in (("dots", "biot"), ("twill", "yarn"), ("twill-drawn-2", "yarn"))
        ])["errors.csv"]
        self.assertEqual([row["set"] for row in rows if row["strain"] == "0.01"],
                         ["cells", "weaves", "drawn weaves"])

    def test_a_run_without_the_claim_on_a_row_is_refused(self):
        folder = self.folder("strain", write_strain)
        write_verdicts(folder, [])
        list_again(folder)
        with self.assertRaisesRegex(BadResults, "has no claim `dots, strip-1: full is"):
            published.rows_of([folder])

    def test_a_bracket_has_its_width_as_the_report_shows_it(self):
        folder = self.folder("strain", write_results)
        write_run(folder, "homogenize")
        (row,) = published.rows_of([folder])["brackets.csv"]
        self.assertAlmostEqual(row["width"], 0.02, places=12)

    def test_claims_are_counted_by_kind_and_amount_to_an_exit_status(self):
        folder = self.folder("dots/stress-quick", write_stress)
        for verdicts, status in (([verdict("a", "PASS")], 0), ([verdict("a", "INCONCLUSIVE")], 4),
                                 ([verdict("a", "INCONCLUSIVE"),
                                   verdict("b", "FAIL", kind="method")], 1)):
            write_verdicts(folder, verdicts)
            write_run(folder, "stress")
            (row,) = published.rows_of([folder])["claims.csv"]
            self.assertEqual((row["exit_status"], row["claims"]), (status, len(verdicts)))
            self.assertEqual((row["command"], row["of"]), ("stress --quick", "dots"))
        self.assertEqual((row["method_fail"], row["program_open"], row["program_fail"]), (1, 1, 0))

    def test_two_runs_of_one_cell_are_refused(self):
        folders = [self.folder(name, write_strain) for name in ("one", "two")]
        with self.assertRaisesRegex(BadResults,
                                    "errors.csv: two runs have a row cells/dots/strip-1/0.01"):
            published.rows_of(folders)

    def test_what_is_published_reads_back_and_what_was_changed_is_refused(self):
        folder = self.folder("strain", write_strain)
        output = os.path.join(self.place, "published")
        self.assertEqual(published.publish(output, [folder]),
                         ["claims.csv", "errors.csv"])
        tables = read_tables(output)
        text = "<!-- published: errors.csv cells/dots/strip-1/0.01 localized -->80.0"
        self.assertEqual(faults_of(text, tables, published.KEYS), [])
        with open(os.path.join(folder, "strain.csv"), "a", encoding="utf-8") as file:
            file.write("\n")
        with self.assertRaisesRegex(BadResults, "strain.csv was changed after the run ended"):
            published.rows_of([folder])
        write_run(folder, finished=False)
        with self.assertRaisesRegex(BadResults, "did not come to its end"):
            published.rows_of([folder])


if __name__ == "__main__":
    unittest.main()
