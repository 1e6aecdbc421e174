# SPDX-License-Identifier: MIT
"""Tests that a page shows one run, or says of which runs it is made: /usr/bin/python3 -m unittest
discover -s tests/verification/report
"""
import json
import os
import unittest
from unittest import mock

import h5py
import report_path  # noqa: F401
from made_up_run import list_again, write_run
from made_up_study import write_results
from page_case import PageTest
from read import results, schema
from test_budget import write_budget


class OneRunTest(PageTest):
    """Results of another run in the same folder stay out of the page."""

    def setUp(self):
        super().setUp()
        self.folder = os.path.join(self.place, "stripes")  # named as its cell, as out/NAME is
        write_results(self.folder)

    def stray(self, name, old="", new=""):
        """A file of another run, beside those that run.json lists."""
        other = os.path.join(self.place, "other", "stripes")
        if not os.path.isdir(other):
            write_results(other)
            write_budget(other)
        with open(os.path.join(other, name), encoding="utf-8") as file:
            text = file.read()
        self.assertIn(old, text)
        path = os.path.join(self.folder, os.path.basename(name))
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace(old, new))

    def test_stiffness_of_a_cell_whose_material_was_changed_since_is_not_shown(self):
        self.stray("stripes/homogenize.json", "2839.91", "1111.11")
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        self.assertIn("<td>2810</td>", page)
        self.assertNotIn("<td>1110</td>", page)
        self.assertIn("homogenize.json is not in run.json", page)

    def test_sheets_in_the_folder_of_their_cell_are_shown_whatever_lies_above(self):
        self.stray("stripes/homogenize.json")
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn('id="stripes-sheet-shear-frame"', self.page())
        self.assertNotIn("Left out: sheets of stripes", self.page())

    def test_budget_and_run_times_of_an_earlier_run_are_not_shown(self):
        self.stray("budget.csv")
        self.stray("runtime.csv")
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        for name in ("budget", "ways"):
            self.assertNotIn(f'id="stripes-{name}"', page)
        for name in ("budget.csv", "runtime.csv"):
            self.assertIn(f"{name} is not in run.json", page)

    def test_a_table_that_was_changed_after_the_run_is_left_out_and_named(self):
        self.edit("levels.csv", lambda text: text.replace("6.5", "9.5"), listed=False)
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        self.assertIn("levels.csv was changed after the run ended", page)
        self.assertNotIn("9.50 s", page)

    def test_a_file_that_is_listed_and_gone_is_named(self):
        os.remove(os.path.join(self.folder, "uncertainty.csv"))
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn("uncertainty.csv does not exist, though run.json lists it", self.page())

    def test_a_folder_below_that_has_a_run_of_its_own_is_not_read(self):
        other = os.path.join(self.folder, "again")
        write_results(other)
        found = results.read_results([self.folder])
        self.assertEqual(list(found.cells), ["stripes"])
        self.assertFalse(
            [item for item in found.missing if os.sep + "again" in item["what"] + item["why"]]
        )
        os.rename(
            os.path.join(other, "stripes", "homogenize.json"),
            os.path.join(other, "homogenize.json"),
        )
        self.assertEqual(list(results.read_results([self.folder]).cells), ["stripes"])

    def test_a_run_that_did_not_end_shows_its_tables_and_says_so(self):
        write_run(self.folder, finished=False)
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        self.assertIn("did not come to its end", page)
        self.assertLess(page.index("did not come to its end"), page.index('<h2 id="verdicts">'))
        self.assertIn('id="stripes-error-strain"', page)
        self.assertIn("<td>2810</td>", page)
        self.assertNotIn('id="stripes-sheet-shear-frame"', page)
        self.assertIn("only its tables are known to be whole", page)

    def test_a_damaged_description_of_a_run_is_refused(self):
        for others, words in (
            ({"format_version": 2}, "found format_version 2; expected at most 1: a newer homespun"),
            ({"format_version": "1"}, "found format_version 1; expected a whole number"),
            ({"revision": None}, "key `revision` is `None`"),
            ({"files": 3}, "key `files` is `3`"),
        ):
            write_run(self.folder, **others)
            self.assert_refused("run.json", *words.split(" is "))

    def test_a_table_that_this_version_does_not_have_is_refused_by_the_revision_that_wrote_it(self):
        path = os.path.join(self.folder, "steps.csv")
        os.rename(os.path.join(self.folder, "levels.csv"), path)
        for finished in (True, False):
            write_run(self.folder, revision="0ld1234", finished=finished)
            self.assert_refused("holds steps.csv", "revision 0ld1234", "--overwrite")
        os.remove(path)
        write_run(self.folder)
        os.rename(os.path.join(self.folder, "strain.csv"), path)  # nobody's, beside a run that ended
        self.assertNotIn("steps.csv", self.run_report()[1])

    def test_a_run_that_says_no_format_is_an_older_one_and_read(self):
        path = os.path.join(self.folder, "run.json")
        with open(path, encoding="utf-8") as file:
            run = json.load(file)
        del run["format_version"]
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"format": 1, **run}, file)
        self.assertEqual(self.run_report(), (0, ""))

    def test_files_of_a_newer_format_are_refused_by_name(self):
        words = "found format_version 2; expected at most 1: a newer homespun wrote the file"
        whole = os.path.join(self.folder, "stripes", "homogenize.json")
        with open(whole, encoding="utf-8") as file:
            text = file.read()
        with open(whole, "w", encoding="utf-8") as file:
            json.dump({"format_version": 2, **json.loads(text)}, file)
        list_again(self.folder)
        self.assert_refused(f"homogenize.json: {words}")
        with open(whole, "w", encoding="utf-8") as file:
            file.write(text)
        for version, found in ((2, words), (-1, "found format_version -1; expected a"), (1, None)):
            with h5py.File(os.path.join(self.folder, "stripes", "cell.h5"), "a") as file:
                file.attrs["format_version"] = [version]  # an array, as the program writes it
            list_again(self.folder)
            if found:
                self.assert_refused(f"cell.h5: {found}")
            else:
                self.assertEqual(self.run_report(), (0, ""))

    def test_the_folder_above_runs_is_refused_with_their_names(self):
        self.folder = self.place
        self.assert_refused("holds no run.json. It holds the runs stripes: give those")

    def test_the_page_names_its_run(self):
        self.assertEqual(self.run_report(), (0, ""))
        with open(os.path.join(self.folder, "run.json"), encoding="utf-8") as file:
            self.assertIn(json.load(file)["fingerprint"], self.page())


class SchemaTest(PageTest):
    def test_without_the_schema_the_report_says_what_to_do(self):
        write_results(self.folder)
        with mock.patch.dict(os.environ, HOMESPUN_SCHEMA=os.path.join(self.place, "nowhere.json")):
            self.assert_refused("schema.json is missing", "build homespun, or set HOMESPUN_SCHEMA")
        path = os.path.join(self.place, "schema.json")
        for text in (
            "{",
            "[1]",
            '{"strain.csv": {"keys": 1, "columns": [{"name": "a", "domain": "odd"}]}}',
        ):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            schema.read.cache_clear()
            with mock.patch.dict(os.environ, HOMESPUN_SCHEMA=path):
                self.assert_refused("is not the schema.json of this version")

    def test_fields_are_what_their_domains_say(self):
        for domain, good, bad in (
            ("name", ("a",), ("",)),
            ("text", ("", "a"), ()),
            ("real", ("", "-1e-3", "0"), ("nan", "inf", "x")),
            ("not negative", ("", "0", "2"), ("-1",)),
            ("positive", ("1e-9",), ("", "0", "-1", "inf")),
            ("needed not negative", ("0", "1"), ("", "-1")),
            ("flag", ("true", "false"), ("", "1")),
            ("outcome", ("", "PASS", "FAIL", "INCONCLUSIVE"), ("open",)),
        ):
            column = schema.Column("x", domain)
            self.assertEqual([column.read(field)[1] for field in good], [""] * len(good), domain)
            self.assertTrue(all(column.read(field)[1] for field in bad), domain)
        self.assertEqual(schema.Column("x", "real").read("-0.1"), (-0.1, ""))
        self.assertEqual(
            [schema.Column("x", "flag").read(field)[0] for field in ("true", "false")],
            [True, False],
        )


if __name__ == "__main__":
    unittest.main()
