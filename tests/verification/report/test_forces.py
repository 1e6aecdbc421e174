# SPDX-License-Identifier: MIT
"""Tests of forces on the page: /usr/bin/python3 -m unittest discover -s tests/verification/report
"""
import csv
import math
import os
import unittest

from matplotlib import pyplot

import report_path  # noqa: F401
from figures import forces, plot_data
from made_up_study import force_rows, write_results
from page import force_contents
from page_case import PageTest


class PartTest(unittest.TestCase):
    def test_differences_are_relative_to_the_resolved_sheet_and_have_a_sign(self):
        rows = force_rows()
        for strain, part, bar in forces.differences(rows, "shear-frame", "biot", "coarse"):
            self.assertAlmostEqual(part, 0.02, places=12)
            self.assertAlmostEqual(bar, 0.005, places=12)
            self.assertIn(strain, (0.001, 0.01, 0.1))
        for row in rows:
            if row["method"] == "coarse":
                row["force_per_width_N_per_m"] *= 0.9
        ((_, part, _), *_) = forces.differences(rows, "shear-frame", "biot", "coarse")
        self.assertAlmostEqual(part, 0.9 * 1.02 - 1.0, places=12)

    def test_sentences_say_which_way_and_whether_the_bar_is_larger(self):
        words = force_contents.difference_words
        self.assertEqual(
            words(0.01, -0.0123, 0.004),
            "1.23 % less force at 1 % strain (bar of the resolved sheet 0.400 %)",
        )
        self.assertIn("more force", words(0.01, 0.0123, 0.004))
        self.assertIn("not less than the difference", words(0.01, 0.0123, 0.02))
        self.assertNotIn("not less than the difference", words(0.01, 0.0123, 0.004))
        self.assertIn("not known", words(0.01, 0.0123, math.nan))
        self.assertEqual(words(0.1, 1e-10, 0.01), "the same force at 10 % strain")
        sentences = force_contents.force_sentences(force_rows(), "biot", (0.01, 0.1))
        self.assertEqual(len(sentences), 2)
        self.assertIn("the same force at 1 % strain; the same force at 10 %", sentences[0])
        self.assertIn("2.00 % more force at 10 % strain", sentences[1])

    def test_the_table_prints_as_many_digits_as_the_bar_allows(self):
        rows = force_contents.force_rows(force_rows(), "biot", (0.1,))
        self.assertEqual(rows[1][:2], ["shear-frame", "10 %"])
        self.assertEqual(rows[1][2:], ["100.00", "0.50", "102", "+2.00 %", "+200 %"])
        self.assertEqual(rows[0][5], "0")

    def test_the_curves_of_the_figure_are_the_rows(self):
        figure = forces.force_figure(force_rows(), "biot")
        points = {
            (panel, series, x): y for panel, series, _, _, x, _, y in plot_data.rows_of(figure)
        }
        pyplot.close(figure)
        self.assertAlmostEqual(points["shear-frame", "coarse, biot", 10.0], 102.0)
        self.assertAlmostEqual(points["shear-frame", "resolved, biot", 1.0], 10.0)
        self.assertAlmostEqual(points["periodic-22", "affine, biot", 10.0], 300.0)

    def test_without_forces_there_is_no_figure(self):
        self.assertIsNone(forces.force_figure([], "biot"))
        self.assertIsNone(forces.force_figure(force_rows(), "green"))


class ForcePageTest(PageTest):
    def test_the_page_has_the_figure_its_numbers_and_the_sentences(self):
        write_results(self.folder)
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        self.assertIn("Force against strain", page)
        self.assertIn("2.00 % more force at 10 % strain", page)
        path = os.path.join(self.output, "figures", "stripes-force-strain.csv")
        with open(path, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertTrue(any(row["y_quantity"] == "force per width [N/m]" for row in rows))

    def test_a_run_without_forces_says_so(self):
        write_results(self.folder)
        self.remove("forces.csv")
        status, errors = self.run_report()
        self.assertEqual(status, 0, errors)
        self.assertIn("Left out: force against strain of stripes", self.page())


if __name__ == "__main__":
    unittest.main()
