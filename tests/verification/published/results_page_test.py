# SPDX-License-Identifier: MIT
"""What docs/results.md says of rows of errors.csv made by hand."""
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "verification" / "published"),
                str(ROOT / "tests" / "verification" / "report")]

# pylint: disable=wrong-import-position
import report_path  # noqa: E402, F401
import of_strain  # noqa: E402
import results_page  # noqa: E402
from readme_numbers import with_twins_marked, without_twins  # noqa: E402


def published_row(cell, strain, **columns):
    """A row of errors.csv; what is not given is an error of 4 ± 0.1 and a gain of 1."""
    errors = dict.fromkeys(of_strain.METHODS, "4")
    bars = {f"{name}_bar": "0.1" for name in errors}
    claims = dict.fromkeys(of_strain.CLAIMS, "INCONCLUSIVE")
    return {"set": "cells", "cell": cell, "load": "strip-1", "strain": strain, **errors, **bars,
            "base_method": "full-micro", **dict.fromkeys(results_page.GAINS, "1"), **claims,
            "bar_safety": "1.25", "law_lost_at": "", "run": "1", "revision": "a", **columns}


class ResultsPageTest(unittest.TestCase):
    def page(self, *rows):
        page = results_page.page({"errors.csv": rows, "brackets.csv": [], "claims.csv": [],
                                  "peers.csv": []})
        return page.replace(results_page.UNBROKEN, " ")

    def test_a_row_has_errors_with_bars_and_gains_and_whether_it_is_decided(self):
        page = self.page(published_row("good", "0.01", affine="100", affine_bar="1.23", base="25",
                                       full="10", full_bar="0.0312", gain_of_coarse_cloth="4",
                                       gain_of_upsampling="2.5", gain_total="10",
                                       gain_over_localized="0.4", full_against_base="PASS"))
        self.assertIn("| `good` | strip-1 | 100 ± 1 | 25.0 ± 0.1 *a* | 4.00 ± 0.10 | 10.0 ± 0.03 |"
                      " 4.00 | 2.50 | 10.0 | 0.400 | nearer |", page)

    def test_an_open_row_says_why(self):
        empty = dict.fromkeys((*of_strain.METHODS, *results_page.GAINS), "")
        page = self.page(published_row("within", "0.1"),
                         published_row("wide", "0.1", bar_safety="3"),
                         published_row("lost", "0.1", **empty, law_lost_at="0.0625"),
                         published_row("stalled", "0.1", **empty))
        for cell, why in (("within", "bars"), ("wide", "bars x 3"), ("lost", "law, 6.25 %"),
                          ("stalled", "not reached")):
            self.assertRegex(page, rf"(?m)^\| `{cell}` .*\| {why} \|$")

    def test_cells_that_were_not_run_are_named(self):
        names = results_page.names_of(ROOT)
        self.assertIn("twill-drawn-2", names)
        page = self.page(*(published_row(name, "0.01") for name in names if name != "satin"))
        self.assertIn("Not run yet at this size: `satin`.", page)
        self.assertNotIn("Not run", self.page(*(published_row(name, "0.01") for name in names)))

    def test_one_thing_changes_at_a_time(self):
        row = published_row("good", "0.01", affine="30", localized="24", localized_p2="20",
                            full_linear_base="36", full_linear="12", full="5")
        lost = published_row("lost", "0.01", law_lost_at="0.001")
        self.assertEqual(results_page.one_change([row, lost]).splitlines()[-1],
                         "| patches, stripes, holes | 1 % |" + "".join(
                             f" **{ratio}** ({ratio} to {ratio}) |"
                             for ratio in ("2.00", "4.00", "1.20", "2.40", "2.50")))

    def test_what_a_row_says_again_counts_once(self):
        rows = [published_row("good", "0.01"), published_row("good", "0.1"),
                published_row("good", "0.01", load="strip-2", full="4.03"),
                published_row("good", "0.1", load="strip-2", full="4.3"),
                *(published_row("lost", "0.1", load=load, **dict.fromkeys(of_strain.METHODS, ""))
                  for load in ("strip-1", "strip-2"))]
        self.assertEqual([row["twin"] for row in with_twins_marked(rows)], [""] * len(rows))
        rows[3]["full"] = "4.1"  # equal at one strain is not enough, and unreached no sign
        marked = with_twins_marked(rows)
        self.assertEqual([row["cell"] for row in without_twins(marked)],
                         ["good", "good", "lost", "lost"])
        self.assertEqual([line.split(" | ")[-2]
                          for line in results_page.summary(marked).splitlines()[2:]],
                         ["0 / 0 / 1", "0 / 0 / 3"])

    def test_every_row_in_which_a_method_loses_is_listed(self):
        page = self.page(published_row("good", "0.01", affine="9", base="8", full="3"),
                         published_row("bad", "0.01", affine="3", base="2.5", full="9",
                                       full_against_base="FAIL"))
        for line in ("- 1 % strain, 1 of 2: `bad` strip-1 (4.00 ± 0.10 against 3.00 ± 0.10).",
                     "- 1 % strain, 1 of 2: `bad` strip-1 (9.00 ± 0.10 against 2.50 ± 0.10,"
                     " decided).",
                     "- 1 % strain, 1 of 2: `bad` strip-1 (9.00 ± 0.10 against 4.00 ± 0.10).",
                     "- 1 % strain, 1 of 2: `bad` strip-1 (9.00 ± 0.10 against 3.00 ± 0.10,"
                     " decided)."):  # by its bars: no claim compares these two
            self.assertIn(line, page)
        self.assertNotIn("`good` strip-1 (", page)

    def test_a_loss_that_no_claim_is_on_is_decided_by_the_rules_of_claims(self):
        for columns, outcome in (({"full": "9"}, True), ({"full": "3.1"}, False),
                                 ({"full": "9", "full_bar": "6"}, False),
                                 ({"full": "9", "affine_bar": ""}, False),
                                 ({"full": "9", "bar_safety": "3"}, False),
                                 ({"full": "9", "law_lost_at": "0.005"}, False)):
            row = published_row("bad", "0.01", **{"affine": "3", **columns})
            self.assertEqual(results_page.is_decided(row, "full", "affine", None), outcome, columns)

    def test_losses_are_of_rows_with_both_errors_and_say_where_the_law_is_lost(self):
        page = self.page(published_row("bad", "0.1", affine="3", law_lost_at="0.02"),
                         published_row("stalled", "0.1", localized=""))
        self.assertIn("- 10 % strain, 1 of 1: `bad` strip-1 (4.00 ± 0.10 against 3.00 ± 0.10,"
                      " law).", page)
        self.assertIn("- 10 % strain, 0 of 2: none.", page)

    def test_the_table_counts_losses_of_the_paper_that_are_decided_and_all(self):
        rows = [published_row(cell, "0.1", affine="3", localized_against_affine=outcome)
                for cell, outcome in (("a", "FAIL"), ("b", "INCONCLUSIVE"))]
        rows.append(published_row("c", "0.1", affine="3", law_lost_at="0.02"))
        header, _, line = results_page.summary(rows).splitlines()
        self.assertRegex(header, r"\| paper loses, decided/all \|$")
        self.assertRegex(line, r"\| 0 / 0 / 3 \| 1/3 \|$")

    def test_medians_are_of_one_set_and_strain_and_of_rows_in_which_the_law_holds(self):
        rows = [published_row(cell, strain, set=its, gain_of_upsampling=gain, law_lost_at=lost)
                for its, cell, strain, gain, lost in (
                    ("cells", "a", "0.01", "2", ""), ("cells", "b", "0.01", "3", ""),
                    ("cells", "c", "0.01", "7", "0.02"), ("cells", "a", "0.1", "9", "0.1"),
                    ("weaves", "d", "0.01", "1.5", ""),
                    ("drawn weaves", "d-drawn-1", "0.01", "0.5", ""))]
        page = self.page(*rows)
        for row in ("patches, stripes, holes | 1 % | 1.00 (1.00 to 1.00) | 3.00 (2.00 to 7.00) |",
                    "patches, stripes, holes | 10 % | – | – | – | – | 0 / 0 / 1 | 0/0 |",
                    "weaves | 1 % | 1.00 (1.00 to 1.00) | 1.50",
                    "weaves drawn by chance | 1 % | 1.00 (1.00 to 1.00) | 0.500"):
            self.assertIn(f"| {row}", page.replace("**", ""))
        self.assertIn("In 1 of 1 cases `full` is not shown to be nearer than its base:"
                      " `d-drawn-1` strip-1 at 1 % (bars).", page)
        self.assertIn("far: 1 of the 6.", page)


if __name__ == "__main__":
    unittest.main()
