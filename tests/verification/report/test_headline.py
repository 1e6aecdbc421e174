# SPDX-License-Identifier: MIT
"""Tests of the first sentence of a page, of its one stiffness, and of what is said of both."""
import math
import pathlib
import re
import unittest

import report_path  # noqa: F401
import numpy
from figures import style
from made_up_error import row
from page import answer, entries, plausible
from page.answer_pictures import as_homespun
from page.headline import finer_mesh_sentence, headline, infinite_line, own_methods_sentence
from read.cell_results import Cell


ROOT = pathlib.Path(__file__).resolve().parents[3]


class HeadlineTest(unittest.TestCase):
    def lines(self, **marks):
        """load -> (mark, change), as answer.line_of() has them."""
        return [
            {"load": load.replace("_", "-"), "mark": mark, "change": change, "gain": 0.5,
             "left_per_cell": 1e-3, "bar_per_cell": 2e-4, "valid": "5 %", "why_open": "",
             "lost": ""}
            for load, (mark, change) in marks.items()
        ]

    def test_one_sentence_says_in_which_sheets_it_pays_and_in_which_not(self):
        lines = self.lines(
            strip_1=("better", "−40 %"), strip_2=("better", "−60 %"), shear_frame=("worse", "+12 %"),
            periodic_11=("worse", "+99 %"),
        )
        self.assertEqual(
            headline(lines, "1 %", "full"),
            "At 1 % strain up-sampling (full) pays in strip-1 (−40 %) and strip-2 (−60 % of the error"
            " of its coarse cloth); it does not pay in shear-frame (+12 % of the error of its coarse"
            " cloth).",
        )
        undecided = self.lines(strip_1=("open", "≈ 0"), strip_2=("open", "–"))
        self.assertEqual(
            headline(undecided, "1 %", "full"),
            "At 1 % strain up-sampling (full) makes no difference that can be told in strip-1; it"
            " cannot be judged in strip-2, where no base was run.",
        )

    def test_what_nothing_decides_is_open_and_is_not_said_to_pay_or_to_make_no_difference(self):
        lines = self.lines(strip_1=("open", "≈ 0"), strip_2=("open", "open"),
                           shear_frame=("open", "open"))
        lines[1]["why_open"], lines[2]["why_open"] = "the law is lost at 4.84 %", "bars"
        self.assertEqual(
            headline(lines, "5 %", "full"),
            "At 5 % strain up-sampling (full) makes no difference that can be told in strip-1; it"
            " is open in strip-2 (the law is lost at 4.84 %) and shear-frame (bars).",
        )
        for line, load in zip(lines, ("periodic-11", "periodic-22", "periodic-12")):
            line["load"] = load
        line = infinite_line(lines)
        self.assertIn("is open in periodic-22 (the law is lost at 4.84 %) and periodic-12 (bars).",
                      line["short"])
        self.assertNotIn("pay", line["short"])
        self.assertEqual((line["change"], line["mark"]), ("≈ 0 / open", "open"))
        # What is left is said of the others alone.
        lines[1].update(lost=lines[1]["why_open"], left_per_cell=0.5)
        self.assertIn("at most 0.120 % of a cell side is left (periodic-11)",
                      infinite_line(lines)["short"])
        self.assertIn("Without edges what is left is open, because the law is lost. Up-sampling is"
                      " open in periodic-22", infinite_line(lines[1:2])["short"])

    def test_a_method_of_ones_own_stands_beside_those_of_homespun(self):
        here = [{**row(error), "load": load, "method": method}
                for load, errors in (("strip-1", (4e-3, 3e-3, 1e-3, 2e-3)),
                                     ("strip-2", (4e-3, 3e-3, 2e-3, 1e-3)),
                                     ("periodic-11", (4e-3, 1e-3, 1e-3, 9e-3)))
                for method, error in zip(("affine", "localized", "full", "mine"), errors)]
        self.assertEqual(
            own_methods_sentence(here),
            "1 of 3 (strip-1) and 0 of 3 (strip-2) methods of homespun are closer than mine, whose"
            " error is 2.00 (strip-1) and 0.500 (strip-2) times that of full.",
        )
        self.assertEqual(own_methods_sentence([r for r in here if r["method"] != "mine"]), "")
        lost = [{**r, "strain": 0.01, "law_lost_at": 0.01} for r in here]
        self.assertEqual(own_methods_sentence(lost), "")

    def test_the_infinite_cloth_has_one_line(self):
        lines = self.lines(strip_1=("better", "−40 %"), periodic_11=("better", "−50 %"),
                           periodic_12=("worse", "+9 %"))
        lines[0]["left_per_cell"], lines[1]["left_per_cell"] = 0.5, 1e-4  # of no account
        lines[1]["valid"] = "2.4 %"
        line = infinite_line(lines)
        self.assertEqual(line["load"], "periodic-11, periodic-12")
        self.assertEqual(line["change"], "−50 %")
        self.assertIn("at most 0.120 % of a cell side is left (periodic-12), error bar included.",
                      line["short"])
        self.assertEqual(line["valid"], "2.4 % / 5 %")
        lines[1]["valid"] = "5 %"
        lines[2]["bar_per_cell"] = math.nan
        line = infinite_line([*lines, {**lines[1], "load": "periodic-22", "valid": "> 10 %"}])
        self.assertEqual(line["valid"], "5 % / 5 % / > 10 %")  # one of each load
        self.assertIn("at most 0.0300 % of a cell side is left (periodic-11), error bar included,"
                      " and 0.100 % of a cell side, of an error bar that is not known, is left in"
                      " periodic-12.", line["short"])
        self.assertIn("does not pay in periodic-12", line["short"])
        self.assertIsNone(infinite_line(self.lines(strip_1=("better", "−40 %"))))

    def test_a_finer_coarse_mesh_is_spoken_of_as_the_run_measured_it(self):
        level = {"load": "strip-1", "strain": 0.01, "reference": "biot"}
        rows = [{**row(1e-2), **level, "method": "localized", "coarse_triangles": 800, "cells": 20}]

        def ways(error):
            return [
                {**level, "way": way, "error_mean_per_cell": value}
                for way, value in (("localized-10", 9e-2), ("localized-20", 2e-2), ("localized-40", error),
                                   ("affine-40", 5e-9), ("localized+p2-40", 5e-9))
            ]

        self.assertEqual(
            finer_mesh_sentence(rows, ways(1e-2), "biot"),
            "2 coarse quads per cell side would take away 50 % of the error of the paper's method"
            " (strip-1, 1 %).",
        )
        self.assertIn("would add 20 %", finer_mesh_sentence(rows, ways(2.4e-2), "biot"))
        self.assertIn("by less than 5 %", finer_mesh_sentence(rows, ways(1.96e-2), "biot"))
        self.assertEqual(finer_mesh_sentence(rows, ways(1e-2)[:1], "biot"), "")
        self.assertEqual(finer_mesh_sentence(rows, ways(1e-2), "green"), "")
        rows[0]["law_lost_at"] = 0.009
        self.assertEqual(finer_mesh_sentence(rows, ways(1e-2), "biot"), "")

    def test_curves_of_the_first_screen_have_names_that_need_no_glossary(self):
        level = {"load": "strip-1", "strain": 0.01, "reference": "biot"}
        rows = [{**row(1e-3), **level, "method": method}
                for method in ("affine", "localized", "full", "localized+p2")]
        base = [{**row(1e-3), **level, "method": "base"}]
        endless = [{**rows[0], "load": "periodic-11"}]
        shown, names = as_homespun(rows + endless, base, {"strip-1": "full"})
        self.assertEqual(names, ["coarse mesh", "paper", "coarse cloth of homespun", "homespun"])
        self.assertEqual({one["load"] for one in shown}, {"strip-1"})
        self.assertEqual(as_homespun(rows, [], {"strip-1": "localized"})[1],
                         ["coarse mesh", "paper"])
        # Each is told from the others in black and white.
        self.assertEqual(len({style.method_style(name) for name in names}), 4)


class OneStiffnessTest(unittest.TestCase):
    """C^H is the centre of the narrowest bracket, whichever run made it."""

    def made(self, value, half, bracket_of="mesh", **others):
        C = numpy.diag([value, 900.0, 300.0])
        return {"C": (C + 0.5 * half).tolist(), "C_lower": (C - half * numpy.eye(3)).tolist(),
                "C_upper": (C + half * numpy.eye(3)).tolist(), "bracket_of": bracket_of,
                "bracket": {"width": 2.0 * half / value}, **others}

    def test_the_bar_is_half_of_the_bracket_about_its_centre(self):
        cell = Cell("a", homogenize=self.made(1115.0, 1.8), command="homogenize")
        self.assertEqual(entries.entry_texts(cell, "C")["11"], ("1115.0", "1.8"))
        self.assertEqual(entries.entry_texts(cell, "C")["12"], ("0", "1.8"))

    def test_of_several_runs_the_narrowest_counts_and_that_of_the_drawing_before_it(self):
        cell = Cell("a", homogenize=self.made(1169.0, 63.0), command="strain",
                    others=[("homogenize", self.made(1115.0, 1.8))])
        self.assertEqual(entries.entry_texts(cell, "C")["11"], ("1115.0", "1.8"))
        cell.others.append(("homogenize", self.made(1113.7, 2.5, "drawing")))
        self.assertEqual(entries.entry_texts(cell, "C")["11"], ("1113.7", "2.5"))
        self.assertIn("of the drawing", entries.bracket_words(cell))
        # What the studies computed with stands apart, and has no bar.
        used = entries.used_stiffnesses(cell)
        self.assertEqual(used["rows"][0], ["C11", "1200.5", "1115.9", "1115.0"])

    def test_a_bending_stiffness_comes_of_the_run_that_has_one(self):
        cell = Cell("a", homogenize=self.made(1000.0, 1.0),
                    others=[("homogenize", self.made(1000.0, 2.0, D=numpy.eye(3).tolist()))])
        self.assertEqual(entries.entry_texts(cell, "D", 1.0)["11"], ("1.00", "–"))


class PlausibleTest(unittest.TestCase):
    def cell(self, C11, angles=(0.0, 90.0), D11=5e-5):
        phases = [{"E1": 1e9, "E2": 1e7, "angle": angle} for angle in angles]
        D = numpy.diag([D11, 5e-5, 1e-5])
        return Cell("weave", homogenize={"C": numpy.diag([C11, 1000.0, 50.0]).tolist(),
                                         "D": D.tolist()}, phases=phases)

    def test_what_is_outside_of_measured_cloth_is_named_with_both_numbers(self):
        sentence = plausible.plausible_sentences(self.cell(9.0e4))[0]
        self.assertIn("C11 = 90000 N/m, 44.2 times the largest measured (2035", sentence.replace("2040", "2035"))
        self.assertIn("within: C22, C66, D11", sentence)
        self.assertTrue(
            plausible.plausible_sentences(self.cell(500.0, (0.0,)))[0].startswith("Within measured")
        )
        self.assertIn("D11 = 0.500", plausible.plausible_sentences(self.cell(500.0, D11=5e-7))[0])

    def test_of_crossing_yarns_three_sentences_say_what_is_left_out(self):
        woven = plausible.plausible_sentences(self.cell(500.0))
        self.assertEqual(len(woven), 4)
        self.assertIn("glues", woven[1])
        for angles in ((0.0,), (0.0, 10.0), (0.0, 180.0), (175.0, 5.0)):
            self.assertEqual(len(plausible.plausible_sentences(self.cell(500.0, angles))), 1, angles)

    def test_crimped_yarns_and_crossings_without_a_stiffer_direction_are_yarns(self):
        shipped = {}
        for name in ("plain-weave", "twill", "satin", "plain-weave-straight", "printed-patch"):
            text = (ROOT / "meshes" / "cells" / f"{name}.prm").read_text(encoding="utf-8")
            listed = re.search(r"set Orthotropic +=([^#\n]*)", text)[1].split(",")
            phases = [dict(zip(("E1", "E2", "nu12", "G12", "angle"),
                               map(float, one.split(":")[1].split()))) for one in listed]
            shipped[name] = plausible.crossing(Cell(name, phases=phases))
        self.assertIsNone(shipped.pop("printed-patch"))  # a knit
        self.assertEqual(set(shipped.values()), {(0.0, 90.0)})
        paper = {"E1": 3e9, "E2": 3e9, "nu12": 0.3, "G12": 3e9 / 2.6}
        self.assertFalse(plausible.is_yarn(paper))
        self.assertTrue(plausible.is_yarn({**paper, "G12": 3e8 / 2.6}))

    def test_the_bias_is_held_against_the_yarns_however_the_cell_is_turned(self):
        D = numpy.array([[5e-5, 1e-5, 0.0], [1e-5, 8e-5, 0.0], [0.0, 0.0, 1e-5]])
        S = numpy.linalg.inv(D)
        e = numpy.array([0.5, 0.5, 0.5])
        bias = 1.0 / (e @ S @ e)
        for turn in (0.0, 45.0, 100.0):
            c, s = numpy.cos(numpy.radians(turn)), numpy.sin(numpy.radians(turn))
            R = numpy.array([[c * c, s * s, -2 * c * s], [s * s, c * c, 2 * c * s],
                             [c * s, -c * s, c * c - s * s]])
            cell = self.cell(500.0, (turn, turn + 90.0))
            cell.homogenize["D"] = (R @ D @ R.T).tolist()
            measures = {name.partition(" at ")[2]: value
                        for name, value, _, _ in plausible.measures_of(cell) if "bias" in name}
            for angle, k in ((turn, 0), ((turn + 90.0) % 180.0, 1)):
                self.assertAlmostEqual(measures[f"{angle:g}°"], bias * S[k, k], msg=turn)


if __name__ == "__main__":
    unittest.main()
