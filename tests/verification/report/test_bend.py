# SPDX-License-Identifier: MIT
"""Tests of the page of `homespun bend`, on made-up errors of bent sheets."""
import csv
import json
import math
import os
import unittest

from markupsafe import Markup

import report_path  # noqa: F401
from made_up_run import verdict, write_run, write_table, write_verdicts
from page.bend_contents import first_sentence, gain_rows, gain_sentences, losses, size_sentences
from page_case import PageTest
from read.bend_results import Bent

SIDE = 0.01
METHODS = ("flat", "affine", "localized", "affine+edges", "full")
# Errors in k eps² and k eps; bars are 0.01 of each.
GAINS = {"position": (0.5, 0.4, 0.3, 0.2, 0.1), "normal": (2.0, 0.4, 0.2, 0.2, 0.05)}
NONE = {**GAINS, "position": (0.5, 0.4, 0.404, 0.2, 0.202)}
LOSES = {**GAINS, "position": (0.5, 0.4, 0.5, 0.2, 0.4)}


def rows(load, errors, reference="linear", level=0.1, bar=0.01):
    """Rows of bend.csv under one load at one curvature."""
    # At large turns a sheet bends less than in linear theory.
    curvature = (1.0 if reference == "linear" else 0.8) * level / SIDE
    return [
        {
            "cell": "stripes", "load": load, "curvature_times_cell": level, "reference": reference,
            "method": method, "cells": 5, "cell_side_m": SIDE, "macro_triangles": 12800, "fine_triangles": 18000,
            "curvature_per_m": curvature, "deflection_mean_m": 1e-3,
            "error_mean_m": position * level * SIDE, "error_bar_m": bar * position * level * SIDE,
            "error_interior_m": 0.5 * position * level * SIDE,
            "error_edge_m": 1.5 * position * level * SIDE,
            "normal_error_mean_rad": normal * level, "normal_error_bar_rad": bar * normal * level,
            "normal_error_interior_rad": 0.5 * normal * level,
            "normal_error_edge_rad": 1.5 * normal * level,
            "seconds_methods": 0.5, "seconds_reference": 2.0,
        }
        for method, position, normal in zip(METHODS, errors["position"], errors["normal"])
    ]


def wrinkle(axis, cells, compression, bar=0.002):
    """A row of wrinkles.csv: compression by that of D^H."""
    return {
        "cell": "stripes", "axis": axis, "cells_per_wave": cells, "foundation_N_per_m3": 4e3,
        "wavelength_m": 0.97 * cells * SIDE, "wavelength_bar_m": bar * cells * SIDE,
        "homogenized_wavelength_m": cells * SIDE, "compression_N_per_m": 10.0 * compression,
        "compression_bar_N_per_m": 10.0 * bar, "homogenized_compression_N_per_m": 10.0,
        "most_compression_N_per_m": 11.0,
    }


def bent(load, errors, left_out=(), **how):
    some = rows(load, errors, **how)
    return Bent(load, {row["method"]: row for row in some if row["method"] not in left_out})


class Sentences(unittest.TestCase):
    BENT = "Bent to a radius of 10 cm (10 cell sides, linear theory), positions "

    def test_the_first_says_that_positions_gain_nothing_from_the_deflection_of_the_cell(self):
        self.assertEqual(
            first_sentence([bent("roll", NONE), bent("twist", NONE)]),
            self.BENT + "gain nothing beyond the error bars from the deflection of the cell under"
            " any load.",
        )

    def test_it_names_the_loads_where_they_do_and_where_they_lose(self):
        self.assertEqual(
            first_sentence([bent("roll", NONE), bent("twist", GAINS)]),
            self.BENT + "gain nothing beyond the error bars from the deflection of the cell under"
            " roll; elsewhere it makes their error 2.00 (twist) times smaller.",
        )
        self.assertEqual(
            first_sentence([bent("roll", NONE), bent("twist", LOSES)]),
            self.BENT + "gain nothing beyond the error bars from the deflection of the cell under"
            " any load; with all terms their error is 2.00 (twist) times that of the better of the"
            " sheets without it.",
        )

    def test_where_all_gain_it_says_what_is_left(self):
        self.assertEqual(
            first_sentence([bent("roll", GAINS), bent("twist", GAINS)]),
            self.BENT + "are 100.0 ± 1.0 µm (roll) off with all terms, and normals 0.2865 ± 0.0029°"
            " (roll).",
        )

    def test_a_gain_is_none_within_both_bars_and_one_beyond_them(self):
        for bar, says_nothing in ((0.34, True), (0.32, False)):  # 0.1 and 0.2: 0.1 apart, bars 0.3 bar
            words = first_sentence([bent("roll", GAINS, left_out=("localized",), bar=bar)])
            self.assertEqual("gain nothing" in words, says_nothing, words)

    def test_without_error_bars_nothing_is_said_to_gain_or_not(self):
        sheets = [bent("roll", GAINS, bar=math.nan)]
        self.assertNotIn("nothing", first_sentence(sheets))
        self.assertIn("smaller or larger under roll, which no error bar tells", gain_sentences(sheets)[0])
        self.assertEqual(gain_rows(sheets)[0][2], "2.00 (no bar)")

    def test_what_the_first_sentence_leaves_out_stands_in_that_of_the_gains(self):
        sheets = [bent("roll", NONE), bent("twist", GAINS, bar=math.nan), bent("pressure", GAINS)]
        self.assertIn("roll; elsewhere it makes their error 2.00 (pressure)", first_sentence(sheets))
        self.assertIn("terms of edges make it 2.00 (roll) times smaller, smaller or larger under twist,"
                      " which no error bar tells; the deflection of the cell makes what is left"
                      " smaller or larger under twist", gain_sentences(sheets)[0])

    def test_the_two_gains_stand_apart_and_the_base_is_the_better_sheet(self):
        edges_lose = {**GAINS, "position": (0.5, 0.2, 0.2, 0.4, 0.1)}
        table = gain_rows([bent("roll", GAINS), bent("twist", edges_lose)])
        self.assertEqual(table[0], ["roll", "2.00", "2.00", "with edges", "2.00", "4.00", "with edges"])
        self.assertEqual(table[1][:4], ["twist", "0.500", "2.00", "homogenized sheet"])

    def test_a_cell_without_terms_of_edges_has_the_gain_of_its_deflection_alone(self):
        sheets = [bent("roll", GAINS, left_out=("affine+edges", "full"))]
        self.assertEqual(gain_rows(sheets)[0][:4], ["roll", "–", "1.33", "homogenized sheet"])
        self.assertIn("the deflection of the cell makes it 1.33 (roll) times smaller",
                      gain_sentences(sheets)[0])
        self.assertIn("What clamps and free edges add is not known", gain_sentences(sheets)[-1])
        self.assertNotIn("not known", gain_sentences([bent("roll", GAINS)])[-1])
        self.assertTrue(size_sentences(sheets)[0].endswith(
            "with the deflection of the cell by 300.0 ± 3.0 µm (roll)."), size_sentences(sheets))

    def test_a_sheet_of_one_material_has_nothing_to_restore(self):
        nothing = {"position": (0.5, 1e-9, 1e-9, 1e-9, 1e-9), "normal": GAINS["normal"]}
        self.assertEqual(gain_rows([bent("roll", nothing)])[0][1:3], ["–", "–"])

    def test_where_the_deflection_of_the_cell_alone_loses_is_said(self):
        self.assertEqual(losses([bent("roll", GAINS), bent("twist", NONE)]), [])
        self.assertIn("of positions by 25 % (twist).", losses([bent("twist", LOSES)])[0])


class BendPage(PageTest):
    def write(self, table, wrinkles=()):
        os.makedirs(self.folder, exist_ok=True)
        write_table(self.folder, "bend.csv", table)
        write_table(self.folder, "wrinkles.csv", wrinkles)
        with open(os.path.join(self.folder, "study.json"), "w", encoding="utf-8") as file:
            json.dump({"command": "homespun bend x.prm", "notes": ["a note"]}, file)
        write_verdicts(self.folder, [verdict("stripes, roll: closer", "PASS", kind="method")])
        write_run(self.folder, "bend")

    def figure(self, name):
        path = os.path.join(self.output, "figures", name)
        if not os.path.isfile(path):
            return None
        with open(path, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_the_answer_stands_first_and_errors_in_figure_and_table_are_those_of_bend_csv(self):
        self.write(rows("roll", NONE) + rows("twist", GAINS) + rows("roll", NONE, level=0.2)
                   + rows("twist", GAINS, level=0.2),
                   [wrinkle(1, 4, 1.001), wrinkle(2, 6, 0.99), wrinkle(2, 4, 0.957)])
        self.assertEqual(self.run_report(saved=["bend-stripes"]), (0, ""))
        page = self.page()
        self.assertIn("<h1>homespun: stripes</h1>", page)
        self.assertIn(
            '<p class="headline">Bent to a radius of 10 cm (10 cell sides, linear theory), positions'
            " gain nothing beyond the error bars from the deflection of the cell under roll; elsewhere", page)
        self.assertIn("Bent sheets", page)
        self.assertIn("The method does what it is for", page)
        self.assertIn("At a radius of 10 cm, k ε² is 1.00 mm and k ε 5.73°.", page)
        text = " ".join(Markup(page.replace("</td>", " | ")).striptags().split())
        self.assertIn("flat triangles | 500.0 ± 5.0 | 250 | 750 | 2000 ± 20 |", text)
        self.assertIn("Pressed along axis 1, where Dᴴ has waves of 4 cells, a sheet begins to wrinkle:"
                      " its compression is that of Dᴴ within the error bar and its wavelength is", page)
        self.assertIn("its compression is 4.30 ± 0.20 % smaller than by Dᴴ and its wavelength is"
                      " 3.00 ± 0.20 % shorter than by Dᴴ.", page)
        self.assertIn("| 10.0 | 9.570 ± 0.020 | −4.30 ± 0.20 % |", text)
        dots = self.figure("bend-stripes.csv")
        self.assertEqual(len(dots), 2 * 2 * len(METHODS))
        full = [dot for dot in dots if (dot["load"], dot["method"]) == ("twist", "full")]
        self.assertEqual([(dot["quantity"], float(dot["error"]), dot["unit"]) for dot in full],
                         [("position", 0.1, "k ε²"), ("normal", 0.05, "k ε")])
        # Errors that are proportional to the curvature make no second figure.
        self.assertIsNone(self.figure("bend-stripes-curvature.csv"))

    def test_large_turns_have_curves_beside_linear_theory_and_come_first(self):
        def grown(level):
            return {name: [(1.0 + level) * error for error in errors]
                    for name, errors in GAINS.items()}

        table = []
        for level in (0.1, 0.5):
            table += rows("roll", GAINS, level=level)
            table += rows("roll", grown(level), reference="biot", level=level)
        table += rows("twist", GAINS)  # which the nonlinear reference did not reach
        self.write(table)
        os.makedirs(os.path.join(self.folder, "stripes"))
        with open(os.path.join(self.folder, "stripes", "homogenize.json"), "w", encoding="utf-8") as file:
            json.dump({"cell": "stripes", "rolled": {"least_radius_m": [0.0, 0.05]}}, file)
        write_run(self.folder, "bend")
        self.assertEqual(self.run_report(saved=["bend-stripes-curvature"]), (0, ""))
        page = self.page()
        self.assertIn("At large turns (biot), under loads that in linear theory bend to a radius of"
                      " 10 cm (10 cell sides), positions are 110.0 ± 1.1 µm", page)
        self.assertIn("No error is known at this radius under twist.", page)
        self.assertIn("Under loads that in linear theory bend to a radius of 2 cell sides, position"
                      " errors over the load are 1.36 (roll) times those at 10 cell sides.",
                      page)
        self.assertIn("down to a radius of 50.0 mm: curvatures × cell side from 0.500 are tighter",
                      page)
        self.assertIn("tighter than 50.0 mm", page)
        self.assertIn("under the law biot, at large turns", page)
        curves = self.figure("bend-stripes-curvature.csv")
        self.assertEqual({row["panel"] for row in curves}, {"roll"})  # linear theory is a guide
        self.assertEqual([float(row["y"]) for row in curves if row["panel"] == "roll"
                          and row["series"] == "all terms" and "position" in row["y_quantity"]],
                         [0.11, 0.15])

    def test_without_a_row_the_page_says_what_is_missing(self):
        self.write([])
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn("bend.csv has no row with an error", self.page())

    def test_a_damaged_row_is_refused_by_line_and_column(self):
        self.write(rows("roll", GAINS))
        self.edit("bend.csv", lambda text: text.replace("linear,localized,5,", "linear,localized,x,"))
        self.assert_refused("bend.csv, line 4", "`cells`")


if __name__ == "__main__":
    unittest.main()
