# SPDX-License-Identifier: MIT
"""Tests of the page of `homespun converge`, on made-up series."""
import math
import os
import unittest

from matplotlib import pyplot

import report_path  # noqa: F401
from figures import converge
from figures.converge import Line
from figures.style import three
from made_up_run import verdict, write_run, write_table, write_verdicts
from page_case import PageTest
from read import converge_results

SERIES = [  # cell, study, case, quantity, p, h_unit, order, lowest, highest, judgement
    (
        "stripes",
        "mesh",
        "uniform refinement",
        "trace of C^H [N/m]",
        1,
        "cell side",
        2.0,
        1.8,
        2.2,
        "PASS",
    ),
    (
        "stripes",
        "adaptive",
        "bracket",
        "adaptive meshes: relative width of the bracket [-]",
        2,
        "1 / sqrt(DoFs)",
        4.0,
        3.6,
        4.4,
        "PASS",
    ),
    (
        "stripes",
        "scale",
        "strip-1",
        "localized: mean error per strain [sheet sides]",
        1,
        "cell sides per sheet side",
        1.2,
        0.85,
        2.15,
        "PASS",
    ),
    (
        "stripes",
        "coarse",
        "strip-1",
        "energy of the coarse sheet at 1 % strain [J]",
        1,
        "H in cell sides",
        1.5,
        0.9,
        2.1,
        "INCONCLUSIVE",
    ),
    (
        "stripes",
        "edges",
        "closed along axis 1",
        "full: mean error per strain [cell sides]",
        1,
        "cell sides per sheet side",
        0.95,
        0.9,
        1.1,
        "PASS",
    ),
    (
        "stripes",
        "bending",
        "twist",
        "full: mean error of the deflection [k L^2]",
        1,
        "cell sides per sheet side",
        2.0,
        1.5,
        2.5,
        "PASS",
    ),
    (
        "stripes",
        "strain",
        "periodic-11",
        "localized: mean error [cell sides]",
        1,
        "strain",
        2.0,
        1.9,
        2.1,
        "PASS",
    ),
    (
        "stripes",
        "time",
        "implicit Euler",
        "mean error of the positions [sheet sides]",
        1,
        "s",
        1.0,
        0.9,
        1.1,
        "PASS",
    ),
    (
        "stripes",
        "time",
        "linearly implicit Euler",
        "mean error of the positions [sheet sides]",
        1,
        "s",
        2.0,
        2.9,
        3.1,
        "FAIL",
    ),
    (
        "stripes",
        "time",
        "damped fall",
        "mean error of the positions [way that the sheet falls]",
        1,
        "s",
        1.0,
        0.9,
        1.1,
        "PASS",
    ),
]


def rows_of(series):
    cell, study, case, quantity, p, unit, order, lowest, highest, judgement = series
    for level in range(4):
        h = 0.5**level
        yield {
            "cell": cell,
            "study": study,
            "case": case,
            "kind": "level",
            "quantity": quantity,
            "order_p": p,
            "level": level,
            "h": h,
            "h_unit": unit,
            "dofs": 10 * 4**level,
            "error": 0.3 * h**order,
            "observed_order": order if level else None,
            "order": order,
            "spread": 0.01,
            "order_lowest": lowest,
            "order_highest": highest,
            "judgement": judgement,
            "seconds": 0.1,
        }


class ConvergencePage(PageTest):
    def setUp(self):
        super().setUp()
        os.makedirs(self.folder)
        # A series without an order is read and not judged.
        alone = {
            "cell": "stripes",
            "study": "strain",
            "case": "periodic-22",
            "kind": "level",
            "quantity": "localized: mean error [cell sides]",
            "order_p": 1,
            "level": 0,
            "h": 0.1,
            "h_unit": "strain",
            "dofs": 5,
            "error": 1e-16,
            "seconds": 0.1,
        }
        write_table(
            self.folder, "converge.csv", [row for one in SERIES for row in rows_of(one)] + [alone]
        )
        write_verdicts(
            self.folder,
            [
                verdict(
                    "stripes, mesh: order 2p", "PASS", 2.0, "2 +- 0.2", command="homespun converge"
                )
            ],
        )
        write_run(self.folder, "converge")

    def page_of(self, results):
        self.assertEqual(results, (0, ""))
        return self.page()

    def test_every_study_has_a_figure_and_a_table_of_orders(self):
        page = self.page_of(self.whole_report())
        for study in converge_results.STUDIES:
            self.assertIn(f'id="converge-{study}"', page)
            self.assertTrue(
                os.path.isfile(os.path.join(self.output, "figures", f"converge-{study}.svg"))
            )
        self.assertIn("8 of 10 observed orders lie within their limits, 1 outside, 1 is open", page)
        self.assertIn("3.00 ± 0.10", page)  # a two-sided limit
        self.assertIn("0.850 to 2.15", page)  # a band
        self.assertIn("homespun: convergence", page)
        self.assertNotIn("periodic-22", page)  # not judged, hence in no table

    def test_the_guide_of_a_figure_has_the_expected_order_and_not_the_observed_one(self):
        series = converge_results.read_convergence(
            self.folder, "x", os.path.join(self.folder, "converge.csv"), [], []
        ).of("time")[1]
        # Observed: 2.
        self.assertEqual([round(order, 9) for order in Line(series, "", "k").expected], [3.0])
        self.assertEqual(len(Line(series, "", "k").h), 4)

    def test_the_guide_of_a_band_has_its_ends_and_that_of_an_adaptive_bracket_the_slope_in_dofs(
        self,
    ):
        convergence = converge_results.read_convergence(
            self.folder, "x", os.path.join(self.folder, "converge.csv"), [], []
        )
        self.assertEqual(convergence.of("coarse")[0].expected(), [1.0, 2.0])
        self.assertEqual(convergence.of("mesh")[0].expected(), [1.9, 2.1])
        self.assertEqual(convergence.of("adaptive")[0].expected(), [4.0])
        axes = converge.adaptive_figure(convergence).axes[0]
        guide = [line for line in axes.lines if line.get_linestyle() == ":"][0]
        (x0, x1), (y0, y1) = guide.get_xdata(), guide.get_ydata()
        self.assertAlmostEqual(math.log(y1 / y0) / math.log(x1 / x0), -2.0)

    def test_series_of_the_time_step_differ_in_their_look_and_stand_under_their_unit(self):
        convergence = converge_results.read_convergence(
            self.folder, "x", os.path.join(self.folder, "converge.csv"), [], []
        )
        figure = converge.time_figure(convergence)
        self.addCleanup(pyplot.close, figure)
        drawn = [[line for line in axes.lines if line.get_label() != converge.THEORY]
                 for axes in figure.axes]
        looks = {(line.get_color(), line.get_marker(), line.get_linestyle())
                 for some in drawn for line in some}
        self.assertEqual(([len(some) for some in drawn], len(looks)), ([2, 1], 3))
        self.assertEqual([axes.get_ylabel() for axes in figure.axes],
                         ["mean error [sheet sides]", "mean error [way that the sheet falls]"])

    def test_a_limit_without_an_error_bar_is_not_printed(self):
        self.edit_table(
            "converge.csv",
            lambda rows: [row.update(richardson_limit="1234.5") for row in rows[:4]] and rows,
        )
        self.assertNotIn(three(1234.5), self.page_of(self.run_report()))
        self.edit_table(
            "converge.csv", lambda rows: [row.update(gci="7.5") for row in rows[:4]] and rows
        )
        self.assertIn(f"{three(1234.5)} ± 7.50", self.page_of(self.run_report()))

    def test_an_unknown_judgement_or_study_and_a_size_of_zero_are_refused(self):
        for key, value, says in (
            ("judgement", "BAD", "`judgement` is `BAD`"),
            ("study", "tome", "`study` is `tome`"),
            ("h", "0", "`h` is `0`"),
        ):
            kept = []
            self.edit_table(
                "converge.csv",
                lambda rows, key=key, value=value, kept=kept: kept.append(rows[5][key])
                or rows[5].update({key: value}),
            )
            self.assert_refused("converge.csv, line 7", says, "homespun converge")
            self.edit_table(
                "converge.csv", lambda rows, key=key, kept=kept: rows[5].update({key: kept[0]})
            )

    def test_levels_may_stand_in_any_order(self):
        page = self.page_of(self.run_report())
        self.edit(
            "converge.csv",
            lambda text: text.splitlines()[0]
            + "\n"
            + "\n".join(sorted(text.splitlines()[1:]))
            + "\n",
        )
        self.assertEqual(page.count("± 0.01"), self.page_of(self.run_report()).count("± 0.01"))


if __name__ == "__main__":
    unittest.main()
