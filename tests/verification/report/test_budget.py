# SPDX-License-Identifier: MIT
"""Tests of budget, run time and range of validity: /usr/bin/python3 -m unittest discover -s
tests/verification/report
"""
import math
import os
import re
import unittest

from matplotlib import pyplot

import report_path  # noqa: F401
import browser
import page_checks
from figures import budget, plot_data
from made_up_run import list_again, write_table
from made_up_study import write_results
from page import budget_contents
from page_case import PageTest
from read import budget_results

WAYS = (
    ("fine-p2", 10.0, 1e-5),
    ("fine-p1", 2.0, 1e-4),
    ("fine-corotational", 4.0, 1e-4),
    ("affine-5", 1e-4, 0.2),
    ("localized-5", 2e-4, 0.03),
    ("localized-10", 1e-3, 0.008),
    ("voigt", 1e-3, 0.1),
    ("reuss", 1e-3, math.nan),
)


def way(name, time, error, bar=1e-7):
    return {
        "way": name,
        "seconds": time,
        "error_mean_per_cell": error,
        "reference_uncertainty_m": bar,
    }


def write_budget(folder):
    """A budget whose two parts make up the total, run times, and a range of validity."""
    shares = {
        "rest": 0.7,
        "modes": 0.4,
        "blending": -0.1,
        "sum": 1.0,
        "total": 1.0,
        "unexplained": 0.0,
        "unexplained-bar": 0.05,
    }
    level = {"cell": "stripes", "load": "shear-frame", "reference": "biot"}
    write_table(
        folder,
        "budget.csv",
        [
            {
                **level,
                "strain": strain,
                "part": part,
                "region": region,
                "mean_m": abs(share) * 1e-4,
                "rms_m": abs(share) * 2e-4,
                "max_m": abs(share) * 3e-4,
                "mean_per_cell": abs(share) * 1e-2,
                "share": share,
            }
            for strain in (0.01, 0.1)
            for region in ("all", "interior", "corner")
            for part in (*budget_results.PARTS, "sum", "unexplained", "unexplained-bar", "total")
            for share in [shares.get(part, 0.0)]
        ],
    )
    write_table(
        folder,
        "cross-checks.csv",
        [
            {
                "cell": "stripes",
                "load": "shear-frame",
                "cells": 4,
                "strain": 0.01,
                "reference": "linear",
                "what": "energies",
                "energy_upper_J": 2e-6,
                "energy_lower_J": 1.98e-6,
                "energy_round_off_J": 1e-15,
                "error_bar_energy_norm": 0.1,
                "energy_p2_J": 1.99e-6,
                "p1_minus_p2_energy_norm": 0.0707,
                "work_misfit_J": 1e-16,
                "largest_work_misfit_J": 1e-14,
                "seconds": 2.0,
                "seconds_lower": 0.5,
            },
            {
                "cell": "stripes",
                "load": "strip-1",
                "cells": 4,
                "strain": 0.01,
                "reference": "linear",
                "what": "energies",
                "energy_upper_J": 2e-6,
                "fault": "stresses: the matrix is not positive definite",
            },
        ],
    )
    write_table(
        folder,
        "runtime.csv",
        [
            {
                **level,
                "strain": 0.1,
                "way": name,
                "triangles": 8,
                "error_mean_m": error * 0.01,
                "error_mean_per_cell": error,
                "reference_uncertainty_m": 1e-7,
                "seconds": time,
                "runs": 5,
                "ranks": 1,
                "threads": 1,
                "note": "a note, with a comma",
            }
            for name, time, error in WAYS
        ],
    )
    validity = [
        (
            "fluctuation",
            0.01,
            "-",
            None,
            None,
            None,
            "at strain 0.001 the error is already 3 % of the fluctuation",
        ),
        ("fluctuation", 0.1, "=", 0.0312, 0.0301, 0.0324, ""),
        ("cell side", 0.05, ">", 0.2, 0.2, 0.2, ""),
    ]
    level["method"] = "localized"
    names = (
        "measure",
        "limit",
        "relation",
        "largest_strain",
        "largest_strain_lower",
        "largest_strain_upper",
        "note",
    )
    level["least_radius_m"] = 0.0234
    write_table(folder, "validity.csv", [{**level, **dict(zip(names, row))} for row in validity])
    if os.path.isfile(os.path.join(folder, "run.json")):
        list_again(folder)


class Budget(unittest.TestCase):
    def test_the_front_is_what_no_other_way_beats(self):
        front = [w["way"] for w in budget_results.pareto_front([way(*w) for w in WAYS])]
        self.assertEqual(front, ["affine-5", "localized-5", "localized-10", "fine-p1", "fine-p2"])

    def test_of_ways_that_take_the_same_time_the_better_one_is_on_the_front(self):
        front = budget_results.pareto_front(
            [way("a", 1.0, 2.0), way("b", 1.0, 1.0), way("c", 2.0, 1.0)]
        )
        self.assertEqual([w["way"] for w in front], ["b"])

    def test_the_fastest_way_to_an_error_is_named_once_at_its_tightest_limit(self):
        sentence = budget_contents.fastest_sentence(
            [way(*w) for w in WAYS], 0.01, "shear-frame", 0.1
        )
        self.assertIn("within 5 % of the cell side localized-5", sentence)
        self.assertIn("within 1 % of the cell side localized-10", sentence)
        self.assertIn("within 0.05 % of the cell side fine-p1", sentence)
        self.assertEqual(sentence.count("localized-10"), 1)
        self.assertNotIn("voigt", sentence)

    def test_the_methods_on_the_front_are_named_and_what_beats_the_others(self):
        ways = [way(*w) for w in (*WAYS, ("full-10", 1.5e-3, 0.002), ("localized+edges-10", 2e-3, 0.004))]
        self.assertEqual(
            budget_contents.front_sentence(ways),
            "On the front of error against run time: affine-5, localized-5, localized-10, full-10."
            " Beaten in both: localized+edges-10 by full-10.",
        )
        self.assertIsNone(budget_contents.front_sentence([way(*w) for w in WAYS[:3]]))
        figure = budget.way_figure(ways, 0.01)
        self.addCleanup(pyplot.close, figure)
        self.assertIn("full", [curve["label"] for curve in plot_data.panels_of(figure)[0]["curves"]])

    def test_a_way_whose_error_bar_crosses_a_limit_is_not_said_to_keep_it(self):
        ways = [way(*w, bar=3e-5) for w in WAYS]  # 0.003 cell sides
        sentence = budget_contents.fastest_sentence(ways, 0.01, "shear-frame", 0.1)
        self.assertNotIn("localized-10", sentence)  # 0.008 + 0.003 is above 1 %
        self.assertIn("within 0.5 % of the cell side fine-p1", sentence)
        self.assertIn("within 0.05 % of the cell side fine-p2", sentence)

    def test_labels_of_ways_that_lie_close_do_not_cover_each_other(self):
        close = (("localized-5", 1.6e-4, 0.007), ("full-micro-4", 2.1e-4, 0.0087),
                 ("localized+edges-4", 1.2e-4, 0.0058), ("localized+p2-4", 0.9e-4, 0.0066))
        figure = budget.way_figure([way(*w) for w in WAYS[:5] + close], 0.01)
        self.addCleanup(pyplot.close, figure)
        boxes = [text.get_window_extent() for text in figure.axes[0].texts if text.get_text()]
        self.assertGreater(len(boxes), 6)
        self.assertEqual([(k, n) for k, box in enumerate(boxes) for n in range(k)
                          if box.overlaps(boxes[n])], [])

    def test_the_interactive_plot_of_the_ways_has_the_corners_of_the_front_and_the_error_bar(self):
        figure = budget.way_figure([way(*w, bar=3e-7) for w in WAYS[:5]], 0.01)
        self.addCleanup(pyplot.close, figure)
        (panel,) = plot_data.panels_of(figure)
        (front,) = [curve for curve in panel["curves"] if len(curve["points"]) > 2]
        self.assertEqual(
            front["points"],
            [
                [1e-4, 0.2],
                [2e-4, 0.2],
                [2e-4, 0.03],
                [2.0, 0.03],
                [2.0, 1e-4],
                [10.0, 1e-4],
                [10.0, 1e-5],
                [30.0, 1e-5],
            ],
        )
        (grey,) = [curve for curve in panel["curves"] if curve.get("fill")]
        self.assertEqual(
            (grey["label"], grey["points"]),
            ("error bar of the best reference", [[5e-5, 3e-5], [30.0, 3e-5]]),
        )
        self.assertIn(
            "error bar of the best reference", [row[1] for row in plot_data.rows_of(figure)]
        )

    def test_of_several_reference_laws_one_counts(self):
        def row(reference, mean):
            return {
                "load": "strip-1",
                "strain": 0.1,
                "region": "all",
                "part": "total",
                "reference": reference,
                "mean_m": mean,
            }

        table = budget_results.levels([row("linear", 1.0), row("biot", 2.0), row("linear", 3.0)])
        self.assertEqual(table[("strip-1", 0.1)]["all"]["total"]["mean_m"], 2.0)

    def test_what_the_parts_leave_is_told_in_parts_of_the_error(self):
        parts = {"unexplained": {"mean_m": 3.0}, "total": {"mean_m": 2.0}}
        self.assertEqual(budget_results.unexplained(parts), 1.5)
        self.assertTrue(math.isnan(budget_results.unexplained(parts, "unexplained-bar")))
        parts["total"]["mean_m"] = 0.0
        self.assertTrue(math.isnan(budget_results.unexplained(parts)))

    def test_validity_tells_a_crossing_from_an_open_end(self):
        def text(relation, strain=math.nan, low=math.nan, high=math.nan):
            return budget_contents.validity_text(
                {
                    "relation": relation,
                    "largest_strain": strain,
                    "largest_strain_lower": low,
                    "largest_strain_upper": high,
                }
            )

        self.assertEqual(text("=", 0.0312, 0.0301, 0.0324), "3.1 % (3 to 3.2)")
        self.assertEqual(text("=", 0.0312, 0.0312, 0.0312), "3.1 %")
        self.assertEqual(text("=", 0.013, high=0.099), "1.3 % (not resolved; up to 9.9 %)")
        self.assertEqual(text("=", 0.013, high=0.013), "1.3 % (not resolved)")
        self.assertEqual(text(">", 0.2, 0.2, 0.2), "> 20 %")
        self.assertEqual(text(">", 0.2, 0.05, 0.2), "> 20 % (from 5 %)")
        self.assertEqual(text(">", 0.2), "> 20 % (not resolved)")
        self.assertEqual(text("-"), "–")
        self.assertEqual(text("-", high=0.003), "– (up to 0.3 %)")


    def test_the_radius_of_rolls_is_told_where_it_is_known(self):
        def text(radius):
            return budget_contents.folds_text([{"least_radius_m": radius}])

        self.assertIn("at least 5.68 cm", text(0.05678))
        self.assertIn("2 % always", text(0.0))
        self.assertEqual(text(math.nan), "")


class BudgetReport(PageTest):
    def setUp(self):
        super().setUp()
        write_results(self.folder)
        write_budget(self.folder)

    def test_the_three_tables_make_their_figures_and_tables(self):
        self.assertEqual(self.run_report(saved=["stripes-budget", "stripes-ways"]), (0, ""))
        page = self.page()
        for name in ("budget", "ways"):
            self.assertIn(f'id="stripes-{name}"', page)
            self.assertEqual(
                page_checks.nameless_numbers(
                    os.path.join(self.output, "figures", f"stripes-{name}.csv")
                ),
                [],
            )
        for text in (
            (
                "Fastest way to a given mean error, error bar of the best solution included, under"
                " shear-frame"
            ),
            "1 rest: higher order in the cell",
            "add up to 100 % less that of <i>unexplained</i>",
            "2 geometric nonlinearity, modes",
            "On the front of error against run time: affine-5",
            "3.1 % (3 to 3.2)",
            "already 3 % of the fluctuation",
            "a note, with a comma",
            "In bending Dᴴ holds to 2 % on rolls of a radius of at least 2.34 cm",
        ):
            self.assertIn(text, page)

    def test_the_energy_of_the_reference_stands_between_its_sides(self):
        self.assertEqual(self.run_report(), (0, ""))
        cells = re.findall(r"<td[^>]*>([^<]*)</td>", self.page())
        energy = "2.00 × 10⁻⁶"
        known = ["stripes", "shear-frame", "4", energy, "99.5 %", "99.0 %", "10.0 %", "7.07 %"]
        unknown = ["stripes", "strip-1", "4", energy, "–", "–", "–", "–"]
        for row in (known, unknown):
            places = [i for i in range(len(cells)) if cells[i : i + len(row)] == row]
            self.assertEqual(len(places), 1, row)
        self.remove("cross-checks.csv")
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn("Left out: energy of the reference between two sides", self.page())
        self.assertNotIn("Prager and Synge", self.page())

    def test_of_which_method_the_budget_is_stands_outside_of_folds_and_under_its_figure(self):
        self.assertEqual(self.run_report(), (0, ""))
        open_page = re.sub(r"<details>.*?</details>", "", self.page(), flags=re.DOTALL)
        self.assertIn("<p>The error of the paper's method, <i>localized</i>, split into parts", open_page)
        self.assertIn("stripes: where the error of localized, the paper", open_page)

    def test_of_laws_that_no_coarse_cloth_has_the_first_of_the_file_has_headline_and_causes(self):
        laws = ("green", "linear")
        for file in ("strain.csv", "gains.csv"):
            self.edit_table(file, lambda rows: [{**row, "reference": law} for law in laws
                                                for row in rows if row["reference"] == "biot"])
        for law in laws:
            self.edit_table("budget.csv", lambda rows: [{**row, "reference": law} for row in rows])
            self.assertEqual(self.run_report(), (0, ""))
            page = self.page()
            self.assertIn("compared with the reference green", page)
            unknown = "Why error is left was not measured in shear-frame"
            self.assertEqual((unknown in page, "(70 % of it)" in page),
                             (law != "green", law == "green"))

    def test_what_was_left_out_is_said(self):
        self.remove("budget.csv", "runtime.csv", "validity.csv")
        self.assertEqual(self.run_report(), (0, ""))
        for text in (
            "budget.csv does not exist",
            "Left out: error budget of stripes",
            "Left out: range of validity of stripes",
        ):
            self.assertIn(text, self.page())
        # Of what the run did not make.
        for text in ("Each part is a field at the fine vertices", "read off the strain ladder"):
            self.assertNotIn(text, self.page())

    @unittest.skipUnless(browser.CHROMIUM, "needs chromium")
    def test_on_paper_no_table_is_cut(self):
        note = "3 of 5 runs: together they took more than 30 s; its error is its own error bar"
        self.edit_table("runtime.csv", lambda rows: [{**row, "note": note} for row in rows])
        names = ("affine+p2", "localized+p2", "localized+edges", "localized+cubic+modes", "full-micro",
                 "full")
        self.edit_table("strain.csv", lambda rows: rows + [
            {**row, "method": name} for row in rows if row["method"] == "localized"
            for name in names])
        self.assertEqual(self.run_report()[0], 0)
        script = """when((page) => page.querySelector("main table"), (page) => {
          for (const { media } of page.styleSheets[0].cssRules)
            if (media && media.mediaText === "print") media.mediaText = "all";
          page.querySelectorAll("details").forEach((fold) => { fold.open = true; });
          const right = (one) => one.getBoundingClientRect().right;
          const tables = [...page.querySelectorAll("table")], edge = right(page.querySelector("main"));
          send([tables.length, tables.filter((one) => right(one) > edge + 1)
            .map((one) => one.rows[0].innerText)]); });"""
        (n_tables, cut), _ = browser.ask(self.output, "report.html", script, width=733)  # A4
        self.assertGreater(n_tables, 10)
        self.assertEqual(cut, [])

    def test_a_share_may_be_negative_an_error_not(self):
        self.edit_table("budget.csv", lambda rows: rows[0].update(mean_m="-0.0001"))
        self.assert_refused("budget.csv", "mean_m", "-0.0001")


if __name__ == "__main__":
    unittest.main()
