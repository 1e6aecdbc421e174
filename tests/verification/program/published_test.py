# SPDX-License-Identifier: MIT
"""Every number of the front page and of the guides on results comes from a file of
verification/published, and docs/results.md is the page of these files.

A number without one is a fault.
"""
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[3]
PUBLISHED = ROOT / "verification" / "published"
sys.path[:0] = [str(PUBLISHED), str(ROOT / "tests" / "verification" / "report")]

# pylint: disable=wrong-import-position
import report_path  # noqa: E402, F401
import published  # noqa: E402
from made_up_drape import write_drape  # noqa: E402
from made_up_run import verdict, write_run, write_table, write_verdicts  # noqa: E402
from made_up_study import write_results, write_stress  # noqa: E402
from read.stored import BadResults  # noqa: E402
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
            text = path.read_text(encoding="utf-8")
            self.assertEqual(faults_of(text, read_tables(PUBLISHED), published.KEYS), [], path)

    def test_no_line_begins_with_a_mark_which_would_end_its_paragraph(self):
        for path in MARKED:
            self.assertNotRegex(path.read_text(encoding="utf-8"), r"(?m)^\s*<!--")

    def test_the_page_of_results_is_that_of_the_tables(self):
        text = (ROOT / "docs" / "results.md").read_text(encoding="utf-8")
        self.assertEqual(text, results_page.page(read_tables(PUBLISHED)),
                         "`cmake --build --preset release --target docs` writes the page again")

    @unittest.skipUnless(list(PUBLISHED.glob("*.csv")), "nothing is published yet")
    def test_every_published_row_says_of_which_run_and_revision_it_is(self):
        for name, rows in read_tables(PUBLISHED).items():
            self.assertTrue(rows, name)
            self.assertTrue(all(row["run"] and row["revision"] for row in rows), name)


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
                               ("affine>localized:count", "2")):
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


class ResultsPageTest(unittest.TestCase):
    def test_the_page_lists_every_case_and_those_where_a_method_loses(self):
        def row(cell, **errors):
            text = {"cell": cell, "load": "strip-1", "run": "1", "revision": "a"}
            for ending in ("", "_10"):
                text |= {name + ending: str(errors.get(name, 4.)) for name, _ in
                         results_page.ERRORS}
            return text
        rows = [row("good", affine=100., localized=50., main=10., **{"localized+p2": 25.}),
                row("bad", affine=3., **{"localized+edges": ""})]
        page = results_page.page({"ladder.csv": rows, "brackets.csv": [], "claims.csv": []})
        self.assertIn("| `good` | strip-1 | 100 | 50.0 | 4.00 | 4.00 | 25.0 | 10.0 | 4.00 | 5.00 |"
                      " 2.00 | 2.50 |", page)
        self.assertIn("| `bad` | strip-1 | 3.00 | 4.00 | – |", page)
        self.assertIn("- 1 % strain, 1 of 2: `bad` strip-1 (4.00 against 3.00).", page)
        self.assertIn("| 10 % strain | total | 3.00 | 1.00 | 5.00 | 2 |", page)


class PublishTest(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = place.name

    def folder(self, name, write, **options):
        path = os.path.join(self.place, name)
        write(path, **options)
        return path

    def test_errors_are_those_of_the_table_in_thousandths_of_strain_and_side(self):
        (row,) = published.rows_of([self.folder("strain", write_results)])["errors.csv"]
        expected = {"affine": 200., "localized": 8., "reference_bar": 0.1,
                    "share_of_affine_left": 4., "share_of_fluctuation_left": 4.}
        for key, value in expected.items():
            self.assertAlmostEqual(row[key], value, places=9, msg=key)
        self.assertEqual((row["cell"], row["load"], row["revision"]),
                         ("stripes", "shear-frame", "abc1234"))

    def test_times_are_medians_and_ratios_those_of_whole_steps(self):
        (row,) = published.rows_of([self.folder("strain", write_results)])["times.csv"]
        self.assertAlmostEqual(row["coarse_ms"], 2.)
        self.assertAlmostEqual(row["ratio_most"], 6.5 / 0.0021)

    def test_a_scene_gives_its_last_frame_with_the_bar_of_its_reference(self):
        folder = self.folder("drape", write_drape, references=("biot",), frames=2,
                             variants=("biot", "nodal-warping"))
        self.assertNotIn("pull.csv", published.rows_of([folder]))  # another scene
        with mock.patch.object(published, "SCENE", "swing"):
            (row,) = published.rows_of([folder])["pull.csv"]
        self.assertEqual((row["cell"], row["time_s"], row["nodal_time_s"]), ("layered", 1., 1.))
        self.assertLess(row["localized"], row["affine"])
        self.assertEqual(row["exact_there"], row["localized"])

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
        folders = [self.folder(name, write_results) for name in ("one", "two")]
        with self.assertRaisesRegex(BadResults,
                                    "errors.csv: two runs have a row stripes/shear-frame"):
            published.rows_of(folders)

    def test_orders_stand_with_their_limits(self):
        folder = os.path.join(self.place, "converge")
        os.makedirs(folder)
        row = {"cell": "dots", "study": "mesh", "case": "uniform refinement", "kind": "level",
               "quantity": "C11 [N/m]", "order_p": 2, "h_unit": "side", "dofs": 5,
               "order": 3.01, "order_lowest": 2.9, "order_highest": 3.1, "judgement": "PASS",
               "seconds": 0.1}
        write_table(folder, "converge.csv",
                    [{**row, "level": level, "h": 0.5 ** level} for level in range(4)])
        write_run(folder, "converge")
        (found,) = published.rows_of([folder])["orders.csv"]
        self.assertEqual((found["elements"], found["order"], found["levels"]), ("P2", 3.01, 4))

    def test_what_is_published_reads_back_and_what_was_changed_is_refused(self):
        folder = self.folder("strain", write_results)
        output = os.path.join(self.place, "published")
        self.assertEqual(published.publish(output, [folder]),
                         ["claims.csv", "errors.csv", "times.csv"])
        tables = read_tables(output)
        text = "<!-- published: errors.csv stripes/shear-frame localized -->8.0"
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
