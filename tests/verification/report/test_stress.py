# SPDX-License-Identifier: MIT
"""Tests of the page of `homespun stress`."""
import csv
import math
import os
import unittest

from matplotlib import pyplot

import report_path  # noqa: F401
import page_checks
from figures.stress import margin, margin_figure, margin_table
from made_up_study import write_stress
from page_case import PageTest


class StressPageTest(PageTest):
    def test_stress_cases_that_do_not_hold_come_first(self):
        write_stress(self.folder)
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        self.assertIn("2 of 4 cases hold, 1 fails, 1 is open.", page)
        self.assertLess(page.index("sliver, 1e-6"), page.index("energy does not grow"))
        self.assertLess(page.index("energy does not grow"), page.index("contrast 1e12"))
        self.assertLess(page.rindex("sliver, 1e-6"), page.index("contrast 1e12"))
        self.assertLess(page.index("homespun stress"), page.index('id="verdicts"'))

    def test_stress_case_with_an_unknown_verdict_is_refused(self):
        write_stress(self.folder)
        self.edit_table("stress.csv", lambda rows: rows[1].update(verdict="BAD"))
        self.assert_refused("stress.csv, line 3: `verdict` is `BAD`", "homespun stress")

    def test_margins_and_iterations_are_drawn_and_what_gave_up_is_told(self):
        write_stress(self.folder)
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        for name in ("stress-margins", "stress-solver-iterations", "stress-solver-seconds"):
            self.assertIn(f'id="{name}"', page)
            self.assertTrue(os.path.isfile(os.path.join(self.output, "figures", name + ".svg")))
            self.assertEqual(
                page_checks.nameless_numbers(os.path.join(self.output, "figures", name + ".csv")),
                [],
            )
        with open(
            os.path.join(self.output, "figures", "stress-margins.csv"), encoding="utf-8", newline=""
        ) as file:
            self.assertEqual(
                [row["case"] for row in csv.DictReader(file)][:2], ["contrast 1e12", "sliver, 1e-6"]
            )
        self.assertIn("conjugate gradients did not reach 1e-11", page)
        self.assertIn("−0.990", page)

    def test_without_a_table_of_the_solver_the_page_says_so(self):
        write_stress(self.folder)
        self.remove("solver.csv")
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn("iterations of the solver", self.page())
        self.assertNotIn('id="stress-solver-iterations"', self.page())

    def test_a_broken_table_of_the_solver_is_refused(self):
        write_stress(self.folder)
        self.edit_table("solver.csv", lambda rows: rows[2].update(iterations="many"))
        self.assert_refused("solver.csv, line 4: `iterations` is `many`", "homespun stress")


class MarginTest(unittest.TestCase):
    @staticmethod
    def row(figure, limit, verdict="PASS", case="a case"):
        return {
            "group": "cell contrast",
            "case": case,
            "figure": figure,
            "limit": limit,
            "verdict": verdict,
        }

    def test_a_margin_is_figure_over_limit_and_a_case_without_a_number_has_none(self):
        self.assertEqual(margin(self.row(2e-10, "1e-10 relative difference [-]")), 2.0)
        self.assertEqual(margin(self.row(0.0, "1e-10 [-]")), 0.0)
        for row in (
            self.row(math.nan, "names `vertex 7`"),
            self.row(math.nan, "1e-10 [-]"),
            self.row(math.inf, "1 [-]"),
            self.row(1.0, ""),
        ):
            self.assertTrue(math.isnan(margin(row)), row)

    def test_failed_cases_stand_right_of_the_limit_and_are_named(self):
        figure = margin_figure(
            [
                self.row(2e-10, "1e-10 [-]", "FAIL", "contrast 1e12"),
                self.row(0.0, "1 [-]"),
                self.row(0.5, "1 [-]", case="holds"),
                self.row(math.nan, "1 [-]", "FAIL", "gave up"),
            ]
        )
        self.addCleanup(pyplot.close, figure)
        texts = [text.get_text() for text in figure.axes[0].texts]
        self.assertIn("contrast 1e12", texts)
        self.assertNotIn("holds", texts)
        counts = [text.get_text() for text in figure.axes[0].child_axes[0].get_yticklabels()]
        self.assertEqual(counts, ["2/4, 1 without a number"])
        crosses = [line for line in figure.axes[0].lines if line.get_marker() == "X"]
        self.assertEqual(
            [list(line.get_xdata()) for line in crosses if len(line.get_xdata())], [[2.0]]
        )

    def test_the_file_of_margins_names_each_case_and_holds_its_own_numbers(self):
        rows = [
            self.row(0.0, "1e-10 [-]", case="zero"),
            self.row(math.nan, "names `x`", case="refused"),
            self.row(2e-10, "1e-10 [-]", "FAIL"),
        ]
        header, table = margin_table(rows)
        self.assertEqual(
            [dict(zip(header, row)) for row in table],
            [
                {
                    "group": "cell contrast",
                    "case": "zero",
                    "verdict": "PASS",
                    "figure": 0.0,
                    "limit": "1e-10 [-]",
                    "figure_over_limit": 0.0,
                },
                {
                    "group": "cell contrast",
                    "case": "refused",
                    "verdict": "PASS",
                    "figure": "",
                    "limit": "names `x`",
                    "figure_over_limit": "",
                },
                {
                    "group": "cell contrast",
                    "case": "a case",
                    "verdict": "FAIL",
                    "figure": 2e-10,
                    "limit": "1e-10 [-]",
                    "figure_over_limit": 2.0,
                },
            ],
        )

    def test_nothing_but_refusals_makes_no_picture(self):
        self.assertIsNone(margin_figure([self.row(math.nan, "names `x`")]))


if __name__ == "__main__":
    unittest.main()
