# SPDX-License-Identifier: MIT
"""Tests of the comparison of several cells and of several versions of one."""
import json
import math
import os
import re
import unittest
from types import SimpleNamespace

import report_path  # noqa: F401
from matplotlib import pyplot
from figures.comparison import comparison_figure, drawn
from figures.plot_data import plain, rows_of
from made_up_run import verdict, write_run, write_verdicts
from made_up_study import write_results
from page.comparison import PART, claims_side_by_side, key_of, time_rows, validity_rows
from page.differences import difference, differences
from page.entries import entry_texts
from page_case import PageTest
from read import results, runs, versions
from read.results import read_results


def rows_of_strip(reference, *methods):
    return [
        {
            "load": "strip-1",
            "reference": reference,
            "method": method,
            "strain": strain,
            "error_mean_per_cell": (1.0 + k) * strain,
        }
        for k, method in enumerate(methods)
        for strain in (0.01, 0.1)
    ]


class ComparisonTest(PageTest):
    def write(self, *parts, changes=(), revision="abc1234"):
        """A result folder, with strings of its files replaced."""
        folder = os.path.join(self.place, *parts)
        write_results(folder)
        for name, old, new in changes:
            path = os.path.join(folder, name)
            with open(path, encoding="utf-8") as file:
                text = file.read()
            with open(path, "w", encoding="utf-8") as file:
                file.write(text.replace(old, new))
        # Its picture takes seconds.
        os.remove(os.path.join(folder, "stripes", "fields-shear-frame.h5"))
        write_run(folder, revision=revision)
        return folder

    def homogenized(self, *parts):
        """A run of `homespun homogenize`, whose cell lies in the folder itself."""
        folder = os.path.join(self.place, *parts)
        os.makedirs(os.path.dirname(folder), exist_ok=True)
        os.rename(os.path.join(self.write("made", *parts), "stripes"), folder)
        write_run(folder, "homogenize")
        return folder

    def verified(self, *parts):
        """The folder of a `verify`, whose parts are there."""
        folder = os.path.join(self.place, *parts)
        write_verdicts(folder, [])
        write_run(folder, "verify")
        return folder

    def test_two_versions_of_a_cell_stand_side_by_side(self):
        claim = [("verdicts.json", "slope 2", "stripes: slope 2")]
        one = self.write("old", "strain", changes=claim)
        two = self.write(
            "new",
            "strain",
            changes=claim
            + [("verdicts.json", "PASS", "FAIL"), ("stripes/homogenize.json", "2839.91", "2900.0")],
        )
        figures = [f"comparison-{name}" for name in ("error-strain", "moduli", "cells")]
        self.assertEqual(self.run_report(one, two, saved=figures), (0, ""))
        page = self.page()
        start = page.index('<h2 id="comparison">')
        claims = page.index('<h2 id="verdicts">')
        self.assertLess(start, claims)
        section = page[start:claims]
        for text in ("stripes (old)", "stripes (new)", "2812", "2842", "periodic-22", "0 (2.00)",
                     "0.0800 (2.00)"):
            self.assertIn(text, section)
        # What differs stands first, the rest in one sentence.
        rows = re.findall(r"<tr><td>([^<]*)</td>", section[: section.index("The same, to the bars")])
        self.assertEqual(rows, [])
        self.assertIn("C11, C22", section)
        for name in figures:
            self.assertIn(f'id="{name}"', section)
        # Each claim once, a column a run.
        listed = page[claims : page.index("<h2", claims + 4)]
        self.assertEqual(listed.count("…: slope 2"), 1)
        self.assertIn("verdicts differ for 1, shown first", listed)
        self.assertIn('<tr class="differs">', listed)
        self.assertIn('href="#comparison"', page)

    def test_what_differs_by_more_than_the_bars_stands_first_with_percent_and_bar(self):
        one, two = self.write("old", "strain"), self.write("new", "strain")
        path = os.path.join(two, "stripes", "homogenize.json")
        with open(path, encoding="utf-8") as file:
            value = json.load(file)
        for key in ("C", "C_lower", "C_upper"):
            value[key][1][1] *= 1.5
        with open(path, "w", encoding="utf-8") as file:
            json.dump(value, file)
        write_run(two)
        results_of_both = read_results([one, two])
        told = differences(results_of_both, results_of_both.subjects)
        # 989 ± 10 and 1484 ± 15 N/m, bars rounded upwards: half as much again, to the two per cent of both bars.
        self.assertEqual([row[0] for row in told["rows"]], ["C22 [N/m]"])
        self.assertEqual(told["rows"][0][1:3], ["989.0 ± 11", "1484 ± 16"])
        self.assertEqual(told["rows"][0][3], "+50.0 ± 3.1 %")
        self.assertIn("C11", told["same"])
        self.assertEqual(difference((100.0, 1.0), (101.5, 1.0)), "within the bars")
        self.assertEqual(difference((100.0, 0.1), (98.0, 0.1)), "−2.00 ± 0.20 %")
        self.assertEqual(difference((100.0, math.nan), (130.0, math.nan)), "+30.0 %")
        self.assertEqual(difference((100.0, 1.0), None), "–")
        for one, other, text in (((100.0, math.nan), (101.0, 3.0), "within the bars"),
                                 ((101.0, 3.0), (100.0, math.nan), "within the bars"),
                                 ((100.0, math.nan), (98.0, 0.1), "−2.00 ± 0.10 %"),
                                 ((98.0, 0.0), (98.0, math.nan), "0")):
            self.assertEqual(difference(one, other), f"{text} (one bar is not known)")
        self.assertEqual(difference((98.0, math.nan), (98.0, math.nan)), "0")
        # Of what may be zero nothing is a percentage.
        self.assertEqual(difference((1e-20, 1e-10), (40.8, 5.2)), "from zero")

    def test_rows_of_two_versions_are_not_mixed(self):
        one, two = self.write("old", "strain"), self.write(
            "new", "strain", changes=[("strain.csv", ",0.01,", ",0.02,")]
        )
        found = read_results([one, two])
        self.assertEqual(
            {row["strain"] for row in found.reached("stripes (old)")}, {0.001, 0.01, 0.1}
        )
        self.assertEqual(
            {row["strain"] for row in found.reached("stripes (new)")}, {0.001, 0.02, 0.1}
        )

    def test_times_are_of_the_law_that_the_first_screen_speaks_of(self):
        def step(reference, seconds):
            return {
                "cell": "stripes",
                "load": "strip-1",
                "reference": reference,
                "seconds_coarse_solve": 1e-3,
                "seconds_upsample": 1e-3,
                "seconds_fine_step": seconds,
            }

        of_laws = SimpleNamespace(
            steps=[step("linear", 1.0), step("biot", 3.0), step("green", 9.0)],
            reached=lambda name: [{"reference": law} for law in ("linear", "biot", "green")],
        )
        rows = dict(time_rows(of_laws, [SimpleNamespace(name="stripes")]))
        self.assertEqual(rows["full resolution over the other two"], ["1500"])

    def test_the_method_of_each_page_is_drawn_and_the_papers_beside_it(self):
        every = rows_of_strip("biot", "full", "localized", "affine", "localized+edges")
        self.assertEqual(
            {kind: method for kind, (method, _) in drawn(every, "biot").items()},
            {"spoken of": "full", "localized": "localized", "affine": "affine"},
        )
        self.assertEqual(drawn(every, "green"), {})
        paper = drawn(rows_of_strip("biot", "localized", "affine"), "biot")
        self.assertEqual(list(paper), ["spoken of", "affine"])
        self.assertEqual(paper["spoken of"][0], "localized")
        figure = comparison_figure(
            {"one": every, "two": rows_of_strip("biot", "localized")},
            {"one": "biot", "two": "biot"},
        )
        self.addCleanup(pyplot.close, figure)
        self.assertEqual(
            [line.get_label() for line in figure.axes[0].get_lines()][:4],
            ["one, full", "one, affine", "one, localized", "two, localized"],
        )

    def test_a_name_that_begins_with_an_underscore_has_its_curves(self):
        some = rows_of_strip("biot", "localized", "affine")
        names = ("one", "_try")
        figure = comparison_figure(dict.fromkeys(names, some), dict.fromkeys(names, "biot"))
        self.addCleanup(pyplot.close, figure)
        self.assertIn("_try", [plain(text.get_text()) for text in figure.legends[0].get_texts()])
        self.assertIn("_try, localized", {row[1] for row in rows_of(figure)})

    def test_the_range_is_that_of_the_method_whose_errors_stand_below(self):
        def row(method, strain):
            return {
                "cell": "stripes",
                "load": "strip-1",
                "reference": "biot",
                "method": method,
                "limit": "0.01",
                "measure": "cell side",
                "relation": "=",
                "largest_strain": strain,
                "largest_strain_lower": strain,
                "largest_strain_upper": strain,
            }

        def shown(*some):
            found = SimpleNamespace(
                validity=list(some), reached=lambda name: [{"load": "strip-1"}]
            )
            return validity_rows(found, [SimpleNamespace(name="stripes")])

        paper, best = row("localized", 0.02), row("full", 0.05)
        self.assertEqual(shown(paper, best), [("strip-1", ["5 % [2 %]"])])
        self.assertEqual(shown(paper), [("strip-1", ["2 %"])])

    def test_one_cell_is_not_compared(self):
        self.assertEqual(self.run_report(self.write("alone")), (0, ""))
        self.assertNotIn("comparison", self.page().split("</style>")[1].split("<script>")[0])

    def test_effective_stiffness_of_one_study_does_not_stand_beside_the_errors_of_another(self):
        strained = self.write("strain", changes=[("stripes/homogenize.json", "2839.91", "2900.0")])
        homogenized = self.homogenized("homog", "stripes")
        for folders in ([homogenized, strained], [strained, homogenized]):
            found = read_results(folders)
            alone, studied = found.cells["stripes (stripes)"], found.cells["stripes (strain)"]
            self.assertEqual(
                (alone.stiffness()[0, 0], studied.stiffness()[0, 0]), (2839.91, 2900.0)
            )
            self.assertEqual({row["cell"] for row in found.strain}, {"stripes (strain)"})

    def test_a_cell_whose_stiffness_was_changed_does_not_take_that_of_another_run(self):
        strained, homogenized = self.write("strain"), self.homogenized("homog", "stripes")
        with open(
            os.path.join(strained, "stripes", "homogenize.json"), "a", encoding="utf-8"
        ) as file:
            file.write(" ")
        found = read_results([homogenized, strained])
        self.assertIsNone(found.cells["stripes (strain)"].stiffness())
        self.assertTrue(
            any(
                "homogenize.json was changed after the run ended" in item["why"]
                for item in found.missing
            )
        )

    def test_a_homogenized_cell_is_called_by_its_name_whatever_its_folder_is(self):
        self.assertEqual(
            list(read_results([self.homogenized("dots", "homogenize")]).cells), ["stripes"]
        )

    def test_folder_of_verify_stands_for_its_parts(self):
        strain = self.write("verify", "strain")
        top = self.verified("verify")
        faults = []
        self.assertEqual([run.folder for run in runs.with_parts([top], faults, [])], [top, strain])
        self.assertEqual(
            [run.folder for run in runs.with_parts([top, strain], faults, [])], [top, strain]
        )
        self.assertEqual(faults, [])
        self.assertEqual(len(read_results([top]).strain), len(read_results([strain]).strain))
        self.assertFalse(
            [m for m in read_results([top]).missing if m["what"].startswith("verdicts")]
        )
        another = self.write("again", "strain")
        self.assertEqual(
            [s.name for s in read_results([top, another]).subjects],
            ["stripes (verify)", "stripes (strain)"],
        )

    def test_parts_of_a_verify_need_no_claims_of_their_own(self):
        cell = self.homogenized("verify", "cells", "layered")
        top = self.verified("verify")

        def lost(*folders):
            return [
                m["why"]
                for m in read_results(list(folders)).missing
                if m["what"].startswith("verdicts")
            ]

        self.assertEqual(lost(top), [])
        self.assertEqual(lost(cell, top), [])
        self.assertEqual(lost(cell), [])  # its checks are its claims
        checks = [v["claim"] for _, v in read_results([cell]).claims()]
        self.assertTrue(checks and all(claim.startswith("stripes: ") for claim in checks), checks)

    def test_a_homogenized_cell_stands_on_the_page_of_its_study_where_both_are_of_one_cell(self):
        strained = self.write("stripes", "strain")
        made = self.write("made", "stripes")
        beside = os.path.join(self.place, "stripes", "homogenize")
        os.rename(os.path.join(made, "stripes"), beside)
        path = os.path.join(beside, "homogenize.json")
        with open(path, encoding="utf-8") as file:
            value = json.load(file)
        value["D"] = [[5e-5, 0.0, 0.0], [0.0, 3e-5, 0.0], [0.0, 0.0, 1e-5]]
        with open(path, "w", encoding="utf-8") as file:
            json.dump(value, file)
        for key, revision, is_joined in (("12ab", "abc1234", True), ("77", "abc1234", False),
                                         ("12ab", "def5678", False)):
            write_run(strained, inputs={"cell stripes": "12ab"})
            write_run(beside, "homogenize", revision, inputs={"cell stripes": key})
            found = read_results([strained])
            self.assertEqual(list(found.cells), ["stripes"])
            D = entry_texts(found.cells["stripes"], "D")["11"][0]
            self.assertEqual(D, "5.00 × 10⁻⁵" if is_joined else "–", (key, revision))
            claims = [v["claim"] for s, v in found.claims() if s.run.command == "homogenize"]
            self.assertEqual(bool(claims), is_joined)
            # Given by name nothing is lost, in either order, nor compared with itself.
            for folders in ([strained, beside], [beside, strained]):
                both = read_results(folders)
                self.assertEqual(len(both.cells), 1 if is_joined else 2)
                self.assertEqual(len(both.strain), len(found.strain))
                if is_joined:
                    self.assertEqual(entry_texts(both.cells["stripes"], "D")["11"][0], D)

    def test_a_part_of_another_revision_is_no_part(self):
        self.write("verify", "strain", revision="def5678")
        found = read_results([self.verified("verify")])
        self.assertEqual(found.strain, [])
        self.assertTrue(
            any(
                "it is a run of revision def5678, the verify of abc1234" in item["why"]
                for item in found.missing
            )
        )

    def test_a_page_of_several_runs_says_which_and_that_their_revisions_differ(self):
        one, two = self.write("old", "strain"), self.write("new", "strain", revision="def5678")
        self.assertEqual(self.run_report(one, two), (0, ""))
        page = self.page()
        self.assertIn("old: a note", page)
        listed = page[page.index('<h2 id="verdicts">') :]
        self.assertIn("<th>old</th><th>new</th>", listed[: listed.index("slope 2")])
        for words in (
            "This page sets 2 runs side by side: old (strain, revision abc1234",
            "new (strain, revision def5678",
            "They were made by different revisions of homespun",
        ):
            self.assertIn(words, page)
        self.assertLess(page.index("different revisions"), page.index('<h2 id="verdicts">'))
        self.assertEqual(self.run_report(one), (0, ""))
        self.assertNotIn("side by side", self.page().split("</style>")[1].split("<h2")[0])

    def test_claims_are_matched_without_the_name_of_their_cell(self):
        for claim, part, key in (
            ("layered, strip-1: slope", "", "…, strip-1: slope"),
            ("layered against biot: layered is", "", "… against biot: layered is"),
            ("homogenize cells/layered: gap", PART, "homogenize cells/…: gap"),
            ("strain: layered, strip-1: slope", PART, "strain: …, strip-1: slope"),
            ("drape hang: layered against biot", PART, "drape hang: … against biot"),
            ("three-layered: slope", "", None),
            ("layered-wide: slope", "", None),
            ("dots: layered as it is", "", None),
        ):
            self.assertEqual(key_of(claim, "layered", part), key, claim)
        verdicts = [verdict(f"{cell}: slope", outcome, 2.0, limit)
                    for cell, outcome, limit in (("one", "PASS", "3"), ("two", "FAIL", "1"))]
        verdicts.append(verdict("one: alone", "PASS"))
        found = results.Results(studies=[results.Study("a", "a", place="a", verdicts=verdicts)])
        subjects = [versions.Subject(name, name, "a") for name in ("one", "two")]
        (block,) = claims_side_by_side(found, subjects)
        self.assertEqual(
            [(row["claim"], row["differs"]) for row in block["rows"]], [("…: slope", True)]
        )
        (alone,) = block["held"]  # of one run alone
        self.assertEqual((alone["claim"], alone["entries"][1]), ("…: alone", None))
        self.assertTrue(block["rows"][0]["advice"])
        self.assertEqual(block["rows"][0]["limit"], "one: 3; two: 1")

    def test_a_claim_is_of_the_cell_that_it_begins_with_whatever_other_words_it_has(self):
        text = "the homogenized sheet at rest puts each vertex where it is"
        for command, title in (("strain", ""), ("verify", "strain: ")):
            outcomes = {"dot": "FAIL", "sheet": "PASS"}.items()
            verdicts = [verdict(f"{title}{cell}: {text}", one) for cell, one in outcomes]
            run = SimpleNamespace(command=command)
            study = results.Study("a", "a", run, place="a", verdicts=verdicts)
            subjects = [versions.Subject(name, name, "a") for name in ("sheet", "dot")]
            (block,) = claims_side_by_side(results.Results(studies=[study]), subjects)
            (row,) = block["rows"]
            self.assertEqual(row["claim"], f"{title}…: {text}")
            self.assertEqual([entry["verdict"] for entry in row["entries"]], ["PASS", "FAIL"])

    def test_names_of_versions_are_short_and_differ(self):
        self.assertEqual(
            versions.tags(["/a/v1/strain", "/a/v2/strain"]),
            {"/a/v1/strain": "v1", "/a/v2/strain": "v2"},
        )
        self.assertEqual(versions.tags(["/a/one", "/b/two"]), {"/a/one": "one", "/b/two": "two"})
        self.assertEqual(len(set(versions.tags(["/a/x/1", "/a/y/1", "/a/y/2"]).values())), 3)


if __name__ == "__main__":
    unittest.main()
