# SPDX-License-Identifier: MIT
"""Tests of error against strain: whose curves stand in which figure, and what its axes show."""
import csv
import math
import os
import re
import unittest

import page_checks
import report_path  # noqa: F401
from figures import plot_data, style
from figures.run_time import step_figure
from figures.strain import BAR_LABEL, error_figure
from made_up_study import SIDE, strain_rows, write_results
from matplotlib import pyplot
from page.tables import step_rows
from page_case import PageTest
from read import schema

FIGURES = ("answer", "error-strain", "error-strain-fluctuation", "variants")


class JudgedTest(PageTest):
    def setUp(self):
        super().setUp()
        write_results(self.folder)
        self.edit_table("strain.csv", lambda rows: rows + [
            {**row, "method": name} for row in rows if row["method"] == "affine"
            for name in ("yours", "mine")])

    def drawn(self, figure):
        """{colour: dashes of its lines}"""
        path = os.path.join(self.output, "figures", f"stripes-{figure}.svg")
        found = {}
        with open(path, encoding="utf-8") as file:
            for line in re.findall(r'style="(fill: none;[^"]*)"', file.read()):
                colour = re.search(r"stroke: (#\w+)", line)
                dash = re.search(r"stroke-dasharray: ([\d.,]+)", line)
                found.setdefault(colour and colour[1], set()).add(dash and dash[1])
        return found

    def test_judged_methods_have_one_look_of_their_own_in_every_figure_of_the_error(self):
        saved = [f"stripes-{figure}" for figure in FIGURES]
        self.assertEqual(self.run_report(saved=saved), (0, ""))
        page, looks = self.page(), set()
        colours = [style.method_colour(name, ["mine", "yours"]).lower()
                   for name in ("mine", "yours")]
        for figure in FIGURES:
            path = os.path.join(self.output, "figures", f"stripes-{figure}.csv")
            with open(path, encoding="utf-8") as file:
                series = {row["series"] for row in csv.DictReader(file)}
            self.assertLessEqual({"mine against biot", "yours against biot"}, series, figure)
            dashes = self.drawn(figure)
            looks.add(tuple((colour, *dashes.pop(colour)) for colour in colours))
            others = set().union(*dashes.values())
        (look,) = looks
        self.assertEqual(len({dash for _, dash in look} - others), 2)
        for figure in ("answer", "error-strain"):
            caption = re.search(rf'id="stripes-{figure}".*?<figcaption>(.*?)</figcaption>', page,
                                re.S)[1]
            self.assertIn("<code>mine</code> (pink) and <code>yours</code> (yellow)", caption)
            self.assertIn(f"Grey: up to the {BAR_LABEL}", caption)
        in_page = {tuple(curve["dash"]) for panels in page_checks.data_of(page, "plot-data")
                   for panel in panels for curve in panel["curves"]
                   if curve.get("label") == "mine against biot"}
        self.assertEqual(in_page, {style.method_style("mine", ["mine"])[0][1]})

    def test_a_judged_method_keeps_its_dash_where_the_others_have_those_of_laws(self):
        rows = [{**row, "method": method, "reference": law} for row in strain_rows()
                if row["method"] == "affine" for method in ("affine", "mine")
                for law in ("biot", "green")]
        figure, _ = error_figure(rows, ["affine", "mine"], ["biot", "green"], SIDE)
        dashes = {}
        for line in figure.axes[0].lines:
            method = line.get_label().split(" against ")[0]
            dashes.setdefault(method, []).append(plot_data.curve_of(line, figure.axes[0]).get("dash"))
        self.assertNotEqual(*dashes["affine"])
        self.assertEqual(*dashes["mine"])
        self.assertNotIn(dashes["mine"][0], dashes["affine"])
        self.assertEqual(len({line.get_marker() for line in figure.axes[0].lines
                              if line.get_label().startswith("mine")}), 2)


class LegendTest(unittest.TestCase):
    def test_the_base_is_named_as_that_of_no_certain_method(self):
        rows = [{**row, "method": method} for row in strain_rows() if row["method"] == "localized"
                for method in ("localized+p2", "base")]
        figure, _ = error_figure(rows, ["localized+p2", "base"], ["biot"], SIDE)
        self.addCleanup(pyplot.close, figure)
        texts = [one.get_text() for one in figure.legends[0].get_texts()]
        self.assertIn("base: coarse cloth of the page's method, not up-sampled", texts)

    def test_each_law_of_a_load_step_has_a_shade_of_its_own(self):
        steps = [{"load": "strip-1", "reference": law, "seconds_coarse_solve": 1e-3,
                  "seconds_upsample": 1e-3, "seconds_fine_step": 1.0} for law in schema.laws()]
        figure = step_figure(steps)
        self.addCleanup(pyplot.close, figure)
        colours = {bar.get_facecolor() for bar in figure.axes[0].patches}
        self.assertEqual(len(colours), 2 + len(schema.laws()))

    def test_a_full_step_is_held_against_the_coarse_steps_of_its_own_law(self):
        steps = [{"cell": "a", "load": "strip-1", "reference": law, "seconds_coarse_solve": coarse,
                  "seconds_upsample": upsample, "seconds_fine_step": 1.0, "coarse_iterations": 3,
                  "fine_iterations": 3, "fine_dofs": 100, "ranks": 1}
                 for law, times in (("biot", (1e-3, 2e-3, 4e-3)), ("green", (0.01, 0.02, 0.04)))
                 for coarse, upsample in zip(times, (1e-3, 5e-3, 2e-3))]
        figure = step_figure(steps)
        self.addCleanup(pyplot.close, figure)
        told = [text.get_text() for text in figure.axes[0].texts]
        self.assertEqual(told, [f"{row[7]} ×" for row in step_rows(steps)])
        self.assertEqual(told, ["250 ×", "45.5 ×"])


class AxesTest(unittest.TestCase):
    def figure(self, strains, factor, bar=1e-3):
        rows = [{"load": "strip-1", "strain": strain, "reference": "biot", "method": method,
                 "error_mean_m": value * SIDE, "error_mean_per_cell": value,
                 "error_bar_m": bar * value * SIDE}
                for strain in strains for method, value in (("affine", factor * strain),
                                                            ("localized", 0.9 * strain))]
        return error_figure(rows, ["affine", "localized"], ["biot"], SIDE)[0]

    def ticks(self, figure):
        figure.canvas.draw()
        return [label.get_text() for label in (*figure.axes[0].get_xticklabels(minor=False),
                                               *figure.axes[0].get_xticklabels(minor=True))
                if label.get_text()]

    def test_few_strains_are_all_named(self):
        for strains, texts in (((0.01, 0.02), ["1", "2"]), ((0.003, 0.01, 0.1), ["0.3", "1", "10"]),
                               ((0.001, 0.002, 0.005, 0.01, 0.1), ["0.1", "1", "10"])):
            figure = self.figure(strains, 1.0)
            (panel,) = plot_data.panels_of(figure)
            self.assertLessEqual(set(texts), set(self.ticks(figure)))
            self.assertEqual(panel["x"].get("ticks"),
                             [100 * s for s in strains] if len(strains) < 5 else None)

    def test_a_bar_below_the_axis_is_told(self):
        for bar, text in ((0.9, "error bar of the smallest error"),
                          (1e-3, "error bar of the smallest error, below the axis")):
            (legend,) = self.figure((0.01, 0.1), 1.0, bar).legends
            self.assertIn(text, [one.get_text() for one in legend.get_texts()])

    def test_the_range_of_errors_is_close_to_them_and_names_two_powers_of_ten(self):
        for strains, factor in (((0.01, 0.1), 8.0), ((0.01, 0.02), 1.0), ((0.001, 0.2), 300.0)):
            figure = self.figure(strains, factor)
            low, high = figure.axes[0].get_ylim()
            least, most = 0.9 * strains[0], factor * strains[1]
            self.assertTrue(low <= least and most <= high)
            whole = [k for k in range(-9, 9) if low * 0.999 <= 10.0**k <= 1.001 * high]
            self.assertGreaterEqual(len(whole), 2)
            if factor > 1.0:
                self.assertLess(math.log10(least / low) + math.log10(high / most), 0.9)


if __name__ == "__main__":
    unittest.main()
