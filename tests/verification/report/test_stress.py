# SPDX-License-Identifier: MIT
"""Tests of the page of `homespun stress`: the stability map."""
import csv
import os
import unittest

from matplotlib import pyplot

import report_path  # noqa: F401
import page_checks
from figures.stress import limits_figure, power
from made_up_study import write_stress
from page_case import PageTest

NONE = float("nan")


class StressPageTest(PageTest):
    def test_every_axis_stands_with_its_end_and_why(self):
        write_stress(self.folder)
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        self.assertIn("5 axes: 2 did not end, 2 end where the answer is wrong, 1 where it is refused",
                      page)
        for text in ("error 2e-06 above 1e-06", "found no lower potential", "round-off",
                     "not more than 1e5 triangles", "energy against the closed form"):
            self.assertIn(text, page)
        self.assertLess(page.index("homespun stress"), page.index('id="verdicts"'))

    def test_the_map_is_drawn_with_its_numbers(self):
        write_stress(self.folder)
        self.assertEqual(self.run_report(saved=["stress-limits"]), (0, ""))
        self.assertIn('id="stress-limits"', self.page())
        table = os.path.join(self.output, "figures", "stress-limits.csv")
        self.assertEqual(page_checks.nameless_numbers(table), [])
        with open(table, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(rows[0]["axis"], "contrast")
        self.assertEqual((float(rows[0]["reached"]), float(rows[0]["end"])), (1e9, 1e10))
        self.assertEqual(rows[4]["reached"], "")

    def test_without_the_table_of_values_the_page_says_so(self):
        write_stress(self.folder)
        self.remove("stress.csv")
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn("values of the stability map", self.page())

    def test_broken_tables_are_refused(self):
        write_stress(self.folder)
        self.edit_table("limits.csv", lambda rows: rows[1].update(reached="-3"))
        self.assert_refused("limits.csv, line 3: `reached` is `-3`", "homespun stress")


class MapTest(unittest.TestCase):
    @staticmethod
    def row(axis, reached, end, ended_by="error", theory=NONE, of="stripes"):
        return {"axis": axis, "of": of, "reached": reached, "end": end, "ended_by": ended_by,
                "theory": theory}

    def test_bars_reach_what_is_right_and_crosses_stand_where_it_ends(self):
        figure = limits_figure([
            self.row("contrast", 1e9, 1e10, theory=1e11),
            self.row("time step", 0.01, 0.02, "solver", of="scene hang"),
            self.row("turned", 180.0, NONE, "ladder"),
            self.row("density", NONE, 10.0),
        ])
        self.addCleanup(pyplot.close, figure)
        axes = figure.axes[0]
        ends = [bar.get_x() + bar.get_width() for bar in axes.patches]
        self.assertEqual([round(end, 6) for end in ends], [1e9, 180.0, 0.01])
        crosses = [line.get_xdata()[0] for line in axes.lines if line.get_marker() == "X"]
        self.assertEqual(crosses, [1e10, 10.0, 0.02])
        self.assertEqual([t.get_text() for t in axes.texts], ["stripes", "scene hang"])
        self.assertEqual([t.get_text() for t in axes.get_yticklabels()],
                         ["contrast", "turned", "density", "time step"])

    def test_numbers_are_those_of_people(self):
        self.assertEqual([power(v) for v in (NONE, 0.01, 180.0, 1e9, 2.5e8)],
                         ["none", "0.01", "180", "$10^{9}$", "$2.5\\cdot10^{8}$"])

    def test_nothing_makes_no_picture(self):
        self.assertIsNone(limits_figure([]))


if __name__ == "__main__":
    unittest.main()
