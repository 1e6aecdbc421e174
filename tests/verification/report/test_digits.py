# SPDX-License-Identifier: MIT
"""Tests of numbers on the page: digits end where bars say no more, and bars cover what is printed."""
import math
import unittest

import numpy

import report_path  # noqa: F401
from figures import style
from made_up_study import LAMINATE
from page import entries, tables
from read.cell_results import Cell


class DigitsTest(unittest.TestCase):
    def test_digits_end_where_the_bar_says_no_more(self):
        for value, bar, text in (
            (1001.5633, 11.05, "1002"),
            (1001.5633, 0.31, "1001.56"),
            (1001.5633, 1e-9, "1001.56"),
            (222.034, 1.67, "222.0"),
            (-4.3e-5, 2.5, "0"),
            (0.00179, 0.096, "0.002"),
            (0.0, 2.5, "0"),
            (-12.345, 0.2, "−12.35"),
            (2839.91, math.nan, "2840"),
            (1.5e7, 10.0, "1.50 × 10⁷"),
        ):
            self.assertEqual(style.beside_bar(value, bar), text, (value, bar))

    def test_a_guaranteed_bar_covers_what_is_printed(self):
        """The printed value ± the printed bar holds the value ± its bar."""
        for value, bar in (
            (1001.5633, 11.05),
            (503.32912, 0.2525),
            (2839.91009, 9.6e-10),
            (-4.3e-5, 2.505),
            (22.339, 0.0599),
            (7.36e-5, 9.96e-7),
            (1.23e7, 4.5e4),
        ):
            text = style.beside_bar(value, bar)
            printed = style.number_of(style.bar_beside(text, value, bar))
            off = abs(style.number_of(text) - value)
            self.assertGreaterEqual(printed, (bar + off) * (1.0 - 1e-9), (value, bar))
            self.assertLessEqual(printed, 1.11 * (bar + off), (value, bar))

    def test_all_six_entries_have_one_name_and_a_bar(self):
        bars = numpy.full((3, 3), 0.3).tolist()
        cell = Cell("a", homogenize={"C": LAMINATE.tolist(), "bracket": {"entry_bars": bars}})
        rows = entries.stiffness_rows(cell)
        self.assertEqual([one[0] for one in rows], ["11", "22", "12", "66", "16", "26"])
        self.assertEqual(rows[0][1:3], ["2839.91", "0.30"])
        self.assertEqual(rows[0][3:], ["–", "–"])  # no bending

    def test_a_step_of_an_endless_cloth_is_not_called_faster(self):
        step = {
            "cell": "a",
            "load": "periodic-11",
            "reference": "biot",
            "seconds_coarse_solve": 0.0,
            "seconds_upsample": 1e-7,
            "seconds_fine_step": 1.0,
            "coarse_iterations": 0,
            "fine_iterations": 3,
            "fine_dofs": 100,
            "ranks": 1,
        }
        self.assertEqual(tables.step_rows([step])[0][7], "–")
        sheet = {**step, "load": "strip-1", "seconds_coarse_solve": 1e-3}
        self.assertEqual(tables.step_rows([sheet])[0][7], "1000")


if __name__ == "__main__":
    unittest.main()
