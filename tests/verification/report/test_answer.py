# SPDX-License-Identifier: MIT
"""Tests of what the page answers first: what up-sampling does to the error, why, with which C^H."""
import json
import math
import os
import shutil
import unittest

import report_path  # noqa: F401
import browser
import h5py
from figures import style
from matplotlib import pyplot
from made_up_error import BAR, row
from made_up_run import list_again, write_run, write_verdicts
from made_up_study import write_results
from page import answer, entries
from page.answer_pictures import sheet_of_answer
from page.glossary import GLOSSARY
from page.run_contents import self_tests
from page_case import OnePageTest, PageTest
from read.cell_results import Cell
from read.results import read_results
from read.schema import main_method
from test_budget import write_budget


def parts(**shares):
    return {part.replace("_", "-"): {"share": value} for part, value in shares.items()}


class SentenceTest(unittest.TestCase):
    def line(self, before, after, budget=None, affine=None, base="affine", method="localized"):
        """@param before error of the base"""
        rows = (
            row(before if affine is None else affine),
            {**row(before), "method": base},
            {**row(after), "method": method, "reference": "biot"},
        )
        return answer.line_of("strip-1", *rows, budget)

    def test_a_gain_says_how_much_goes_and_why_the_rest_stays(self):
        line = self.line(1e-2, 0.26e-2, parts(rest=0.1, coarse_mesh=0.6, slip=0.3))
        self.assertEqual((line["change"], line["mark"]), ("−74 %", "better"))
        self.assertEqual(
            line["sentence"],
            "Up-sampling takes away 74 % of the error of the coarse mesh alone; 26.0 µm (0.260 % of a"
            " cell side) are left because the coarse mesh is too coarse (60 % of it) and clamped"
            " edges slip by a part of a cell, which the anchor leaves out (30 % of it).",
        )

    def test_a_loss_says_how_much_worse_and_why(self):
        line = self.line(1e-2, 1.58e-2, parts(layer=0.9, blending=-0.2, slip=0.1))
        self.assertEqual((line["change"], line["mark"]), ("+58 %", "worse"))
        self.assertIn("adds 58 % to the error of the coarse mesh alone", line["sentence"])
        self.assertTrue(line["sentence"].endswith("the cells do not repeat (90 % of it)."))

    def test_what_the_coarse_cloth_gains_is_not_said_of_up_sampling(self):
        full = {"affine": 2e-2, "base": "affine+p2", "method": "full"}
        line = self.line(1e-2, 0.5e-2, **full)
        self.assertEqual(
            [line[key] for key in ("change", "coarse", "total")], ["−50 %", "−50 %", "−75 %"]
        )
        self.assertIn("takes away 50 % of what its coarse cloth, affine+p2, leaves", line["sentence"])
        self.assertIn(
            "That coarse cloth itself changes the error of the coarse mesh alone by −50 %, both"
            " together by −75 %.",
            line["beside"],
        )
        # One material: all of it is of the coarse cloth.
        line = self.line(1e-2, 1e-2 * (1.0 - 1e-7), **full)
        self.assertEqual((line["change"], line["mark"], line["coarse"]), ("≈ 0", "open", "−50 %"))
        self.assertNotIn("takes away", line["sentence"])
        self.assertIn("adds 100 % to what", self.line(1e-2, 2e-2, **full)["sentence"])

    def test_without_a_base_nothing_is_said_of_up_sampling(self):
        best = {**row(1e-3), "method": "full", "reference": "biot"}
        line = answer.line_of("strip-1", row(1e-2), None, best, None)
        self.assertEqual((line["change"], line["mark"], line["total"]), ("–", "open", ""))
        self.assertIn("not known, because no base was among the methods (full-micro, affine+p2)",
                      line["sentence"])
        self.assertNotIn(" %", line["sentence"].replace("0.100 % of a cell side", ""))

    def test_what_the_bars_cannot_tell_is_not_called_a_gain(self):
        line = self.line(1e-2, 1e-2 - 1.5 * BAR)
        self.assertEqual(line["mark"], "open")
        self.assertIn("that the error bars of both", line["sentence"])
        self.assertEqual(self.line(1e-2, 1e-2 - 3.0 * BAR)["mark"], "better")

    def test_bars_that_bear_no_claim_bear_no_sentence(self):
        for beside, words in (({"error_bar_safety": 3.0}, "do not come together"),
                              ({"error_bar_m": math.nan}, "an error bar is not known")):
            base, best = row(1e-2), {**row(1e-3), **beside}
            change, mark, said = answer.of_upsampling({**base, "method": "affine"}, best, "left")
            self.assertEqual((change, mark), ("open", "open"))
            self.assertIn(words, said)
            self.assertIn("an amount that is open", answer.of_the_paper(answer.change_between(base, best)))

    def test_beyond_the_loss_of_the_law_nothing_is_said_to_gain_or_to_lose(self):
        for after in (1e-3, 2e-2, 1e-15):
            base, best = ({**row(error), "strain": 0.05, "law_lost_at": 0.0484, "method": "affine"}
                          for error in (1e-2, after))
            change, mark, said = answer.of_upsampling(base, best, "left")
            self.assertEqual((change, mark), ("open", "open"))
            self.assertIn("is open, because the law is lost at 4.84 %; left", said)
            self.assertEqual(answer.line_of("periodic-11", base, base, best, None)["lost"],
                             "the law is lost at 4.84 %")
            self.assertEqual(answer.change_between(base, best), "open")
            best["law_lost_at"] = 0.0501
            self.assertNotEqual(answer.of_upsampling(base, best, "left")[0], "open")

    def test_zero_is_said_to_round_off(self):
        self.assertIn("all of the error", self.line(1e-2, 1e-15)["sentence"])
        self.assertIn("nothing is to be added".capitalize(), self.line(1e-15, 1e-15)["sentence"])

    def test_without_a_budget_no_cause_is_made_up(self):
        lines = [self.line(1e-2, 5e-3), self.line(1e-2, 5e-3, parts(rest=1.0))]
        self.assertTrue(lines[0]["sentence"].endswith(" are left."), lines[0]["sentence"])
        self.assertEqual([line["has_cause"] for line in lines], [False, True])
        lines = [{**lines[0], "load": load} for load in ("strip-1", "strip-2")] + lines[1:]
        self.assertEqual(
            answer.no_cause_sentence(lines, "1 %"),
            "Why error is left was not measured in strip-1 and strip-2: the error budget did not run"
            " there at 1 %.",
        )
        self.assertEqual(answer.no_cause_sentence(lines[2:], "1 %"), "")
        self.assertEqual(answer.likely_sentence(lines, "full"), "")
        lines = [self.line(1e-2, 5e-3, {"rest": {"mean_m": 1.0}}, method="full")]
        self.assertIn("the error of full itself was not split", answer.likely_sentence(lines, "full"))
        # Parts beside the sum are no causes.
        self.assertIn("compensate", answer.why(parts(reference=0.9, cell=0.9)))

    def test_what_is_small_beside_the_error_is_no_cause_of_it(self):
        some = {"solver": {"mean_m": 1e-12}, "modes": {"mean_m": 1e-6}, "rest": {"mean_m": 1e-9}}
        self.assertIn("no part of the error budget", answer.why(some, "full", 1e-8, "biot"))
        self.assertIn("cells are not small", answer.why(some, "full", 2e-9, "biot"))

    def test_the_paper_s_method_stands_beside_with_what_it_does_to_its_own_coarse_cloth(self):
        for paper, change in ((8e-3, "−20 %"), (15e-3, "+50 %"), (1e-2 - 0.5 * BAR, "less than the bar")):
            self.assertEqual(
                answer.of_the_paper(answer.change_between(row(1e-2), row(paper))),
                " The paper's method, localized, changes the error of the coarse mesh alone by"
                f" {change}.",
            )

    def test_what_another_law_would_change_stands_beside_what_is_left(self):
        rows, forces = [], []
        for load, force in (("strip-1", 1.15), ("strip-2", 1.33), ("periodic-11", 9.0)):
            for law, error, of_law in (("biot", 5e-3, 1.0), ("green", 4e-2, force), ("linear", 1.0, 5.0)):
                level = {"load": load, "reference": law, "strain": 0.1}
                rows.append({**row(error), **level, "method": "full"})
                rows.append({**row(1.0), **level, "method": "affine"})
                for method, factor in (("resolved", 1.0), ("coarse", 7.0)):
                    forces.append(
                        {**level, "method": method, "force_per_width_N_per_m": factor * of_law}
                    )
        self.assertEqual(
            answer.law_sentence(rows, forces, "biot", 0.1),
            "What another law would change, at 10 %: with green instead of biot sheets take 1.15 to"
            " 1.33 times the force, and the error that is left is 8.00 times as large.",
        )
        for law in ("biot", "green"):  # lost in one sheet, by either law
            some = [{**r, "law_lost_at": 0.06} if (r["load"], r["reference"]) == ("strip-2", law)
                    else r for r in rows]
            self.assertIn("take 1.15 times the force, and the error that is left is 8.00 times as"
                          " large (open in strip-2, where a law is lost).",
                          answer.law_sentence(some, forces, "biot", 0.1))
        lost = [{**r, "law_lost_at": 0.06} for r in rows]
        self.assertEqual(answer.law_sentence(lost, forces, "biot", 0.1), "")
        self.assertEqual(answer.law_sentence(rows, forces, "biot", 0.01), "")
        self.assertEqual(answer.law_sentence(rows, [], "biot", 0.1), "")

    def test_the_error_bar_stands_beside_what_is_left(self):
        self.assertEqual(
            answer.beside_the_bar(row(1e-3)), " The error bar of that error is 10.0 nm."
        )
        within = answer.beside_the_bar(row(1e-3, bar=2e-3))
        self.assertIn("Its error bar, 20.0 µm, is not smaller", within)
        self.assertIn("at most 30.0 µm", within)
        self.assertEqual(answer.beside_the_bar(row(1e-3, bar=0.0)), "")
        self.assertEqual(answer.beside_the_bar(row(1e-15)), "")

    def test_the_method_of_a_page_is_the_one_with_most_terms(self):
        for methods, main in ((("affine", "localized", "localized+p2", "full"), "full"),
                              (("full-micro", "localized", "full-p2"), "full-p2"),
                              (("localized+edges", "localized+p2"), "localized+edges"),
                              (("affine", "full-micro", "unreached"), "localized")):
            self.assertEqual(main_method(methods), main, methods)

    def test_what_a_method_takes_away_of_the_budget_depends_on_the_law(self):
        edges = {"slip", "selvedge", "bulk", "layer"}
        self.assertEqual(answer.taken_away("full", "biot"), edges | {"macro-law", "modes"})
        self.assertEqual(answer.taken_away("full", "yarn"), edges | {"modes"})
        self.assertEqual(answer.taken_away("localized+p2", "biot"), set())

    def test_shares_keep_a_digit_where_none_would_say_nothing_or_all(self):
        for value, text in ((0.7412, "74"), (0.9989, "99.89"), (0.001, "0.1"), (0.5, "50")):
            self.assertEqual(answer.share(value), text)


def write_answered(test):
    """Results with a budget and without a picture of the sheet."""
    write_results(test.folder)
    write_budget(test.folder)
    test.remove("stripes/fields-shear-frame.h5")


class AnswerPageTest(PageTest):
    def setUp(self):
        super().setUp()
        write_answered(self)

    def test_the_answer_comes_first_and_words_are_explained(self):
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        first = page[page.index("<h1>") : page.index("<nav")]
        for words in (
            "At 1 % strain up-sampling (localized) pays in shear-frame (−96 % of the error of its"
            " coarse cloth).",
            "−96 %",
            "because cells are not small beside the sheet and its corners (70 % of it)",
            'id="stripes-answer"',
            "C<sup>H</sup> [N/m]",
            "program: ",
            "method: ",
        ):
            self.assertIn(words, first)
        for word, meaning in GLOSSARY:
            self.assertTrue(meaning, word)
        for word in ("anchor", "lift", "localized", "linear, biot, green, yarn"):
            self.assertIn(f"<dt>{word}</dt>", page)

    def test_the_answer_is_open_where_the_range_says_that_the_law_is_lost(self):
        self.edit_table("validity.csv",
                        lambda rows: [{**row, "elliptic_up_to": "0.009"} for row in rows])
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn("At 1 % strain up-sampling (localized) is open in shear-frame (the law is"
                      " lost at 0.900 %).", self.page())

    def test_the_picture_is_of_the_load_that_leaves_most_and_says_whose_sheet_it_is(self):
        made = os.path.join(self.place, "made")
        write_results(made)
        one = os.path.join(made, "stripes", "fields-shear-frame.h5")
        other = os.path.join(made, "stripes", "fields-strip-1.h5")
        shutil.copy(one, other)
        with h5py.File(other, "a") as file:
            file.attrs["load"] = "strip-1"
        cell = Cell("stripes", field_files=[one, other])
        added = []

        class Shown:
            def add(self, figure, name, caption, **others):
                added.append((caption, [axes.get_title(loc="left") for axes in figure.axes[:3]]))
                pyplot.close(figure)

        for most in ("strip-1", "shear-frame"):
            lines = [{"load": load, "left_per_cell": 2.0 if load == most else 1.0}
                     for load in ("strip-1", "shear-frame")]
            sheet_of_answer(cell, lines, Shown())
            self.assertTrue(added[-1][0].startswith(f"{most} at "), added)
            self.assertIn("by the paper's method, localized,", added[-1][0])
            self.assertEqual(added[-1][1], ["reference", "paper", "error"])
        self.assertIsNone(sheet_of_answer(Cell("stripes"), [], Shown()))

    def test_a_cell_without_a_study_answers_with_its_stiffness(self):
        alone = os.path.join(self.place, "homogenize")
        os.rename(os.path.join(self.folder, "stripes"), alone)
        write_run(alone, "homogenize")
        self.assertEqual(self.run_report(alone), (0, ""))
        page = self.page()
        first = page[page.index("<h1>") : page.index("<nav")]
        self.assertIn("C<sup>H</sup> [N/m]", first)
        self.assertIn("<code>homespun strain</code> makes them", first)
        self.assertIn("One period of a cloth, homogenized", first)
        for name in ("cell", "directional-modulus"):
            self.assertIn(f'id="stripes-{name}"', first)
            self.assertEqual(page.count(f'id="stripes-{name}"'), 1)
        self.assertNotIn('id="validity"', page)  # nothing of a study is there to be left out
        self.assertIn('id="stiffness"', page)

    def test_a_cell_that_is_not_cut_as_it_is_drawn_says_so_on_the_first_screen(self):
        self.assertEqual(self.run_report(), (0, ""))
        self.assertNotIn("The cell is not the one that is drawn", self.page())
        path = os.path.join(self.folder, "stripes", "homogenize.json")
        with open(path, encoding="utf-8") as file:
            value = json.load(file)
        value["shift"] = {"parts": [0.25, 0], "metres": [0.0025, 0], "remark": "cut <0.25 a1> away"}
        with open(path, "w", encoding="utf-8") as file:
            json.dump(value, file)
        list_again(self.folder)
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        first = page[page.index("<h1>") : page.index("<nav")]
        self.assertIn("The cell is not the one that is drawn: cut &lt;0.25 a1&gt; away.", first)

    def test_two_stiffnesses_of_one_cell_are_both_shown_and_named(self):
        whole = os.path.join(self.place, "verify")
        os.makedirs(os.path.join(whole, "cells"))
        os.rename(self.folder, os.path.join(whole, "strain"))
        alone = os.path.join(whole, "cells", "stripes")
        write_results(os.path.join(self.place, "made"))
        os.rename(os.path.join(self.place, "made", "stripes"), alone)
        path = os.path.join(alone, "homogenize.json")
        with open(path, encoding="utf-8") as file:
            value = json.load(file)
        value["C"][0][0], value["order"] = 2700.0, 1
        with open(path, "w", encoding="utf-8") as file:
            json.dump(value, file)
        write_run(alone, "homogenize")
        write_verdicts(whole, [])
        write_run(whole, "verify")
        results = read_results([whole])
        cell = results.cells["stripes"]
        missing = [item["what"] for item in results.missing]
        self.assertNotIn("error against strain", missing, "the study beside it has it")
        self.assertNotIn("time per load step", missing)
        found = entries.used_stiffnesses(cell)
        self.assertEqual(
            found["names"], ["homogenize, linear triangles", "strain, quadratic triangles"]
        )
        shown = entries.entry_texts(cell, "C")
        self.assertEqual(shown["11"], ("2812", "29"))  # the centre of 0.98 and 1 times 2839.9
        self.assertEqual(found["rows"][0], ["C11", "2700", "2840"])
        self.assertEqual(found["rows"][1], ["C22", "999.0", "999.0"])

    def test_self_tests_of_the_same_revision_are_linked_and_no_others(self):
        whole = os.path.join(self.place, "stripes", "verify")
        os.makedirs(os.path.dirname(whole))
        os.rename(self.folder, whole)
        tests = os.path.join(self.place, "verify")
        os.makedirs(tests)
        write_verdicts(tests, [])
        with open(os.path.join(tests, "report.html"), "w", encoding="utf-8") as file:
            file.write("<h1>self-tests</h1>")
        found = read_results([whole])
        for inputs, revision, is_linked in (
            ({"parts": ["converge", "stress"]}, "abc1234", True),
            ({"parts": ["converge", "stress"]}, "def5678", False),
            ({"parts": ["converge"], "cell stripes": "0"}, "abc1234", False),
        ):
            write_run(tests, "verify", revision, inputs=inputs)
            told = self_tests(found, whole)
            self.assertEqual(told["link"], "../../verify/report.html" if is_linked else "")
            self.assertEqual("made once by `homespun verify`" in told["sentence"], not is_linked)


@unittest.skipUnless(browser.CHROMIUM, "needs chromium")
class ShownAnswerTest(OnePageTest):
    """The page as browsers show it."""

    def made(self):
        write_answered(self)
        return [self.folder]

    def test_the_answer_is_on_the_first_screen_and_the_page_is_short_until_it_is_opened(self):
        script = """when((page) => page.querySelector("main h1"), (page) => {
          const top = (id) => page.getElementById(id).getBoundingClientRect().top;
          const bottom = (id) => page.getElementById(id).getBoundingClientRect().bottom;
          const folds = page.querySelectorAll("details:not([open])").length;
          const answer = [top("short"), page.querySelector("#stripes-answer img")
            .getBoundingClientRect().bottom, page.querySelector(".entries table")
            .getBoundingClientRect().bottom];
          const height = page.body.scrollHeight;
          const ground = page.defaultView.getComputedStyle(page.querySelector("div.claim"))
            .backgroundColor;
          page.defaultView.location.hash = "#provenance";
          setTimeout(() => send({ answer, height, folds, ground,
            open: page.getElementById("provenance").closest("details").open }), 500); });"""
        found, _ = browser.ask(self.made_in, "report.html", script, width=1280)
        self.assertLess(max(found["answer"]), 900)
        self.assertLess(found["height"], 12 * 900)
        self.assertGreater(found["folds"], 5)
        self.assertEqual(found["ground"], "rgba(0, 0, 0, 0)")  # what is open can be read
        self.assertTrue(found["open"])  # a link opens what it leads to

    def test_on_a_phone_nothing_is_covered_hidden_or_cut_and_figures_are_framed_when_it_is_dark(self):
        script = """when((page) => page.querySelector("button.theme"), (page, their) => {
          const box = (one) => page.querySelector(one).getBoundingClientRect();
          const style = (one) => their.getComputedStyle(page.querySelector(one));
          const button = box("button.theme"), text = page.createRange();
          text.selectNodeContents(page.querySelector("h1"));
          const apart = [...text.getClientRects()].every((line) =>
            line.right <= button.left || line.top >= button.bottom || line.bottom <= button.top);
          const nav = page.querySelector("nav ol");
          send({ apart, position: style("button.theme").position, row: style(".lines tr").display,
            names: their.getComputedStyle(page.querySelector(".lines td:last-child"), "::before").content,
            links: nav.scrollHeight <= nav.clientHeight + 1, wide: page.documentElement.scrollWidth,
            frame: style("#stripes-answer img").padding }); });"""
        found, _ = browser.ask(self.made_in, "report.html?theme=dark", script, width=390)
        self.assertTrue(found["apart"] and found["links"], found)
        self.assertEqual((found["position"], found["row"]), ("absolute", "block"))  # scrolls away
        self.assertIn("up to a strain of", found["names"])
        self.assertLessEqual(found["wide"], 390)
        self.assertEqual(found["frame"], "8px")


if __name__ == "__main__":
    unittest.main()
