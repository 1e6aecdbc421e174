# SPDX-License-Identifier: MIT
"""Tests of the page of `homespun periodic load`, on made-up curves."""
import json
import os
import re
import unittest

import report_path  # noqa: F401
from figures.load import load_figure, panels
from made_up_run import verdict, write_run, write_table, write_verdicts
from page.load_contents import coarse_sentence, end_row, pressed_sentence
from page_case import PageTest
from read.load_results import LoadRun, Path


def row(law, method, step, stress_per_strain, bar=0.01):
    """A pull along axis 1: strain prescribed, sides free."""
    e = 0.02 * step
    return {
        "cell": "stripes",
        "law": law,
        "method": method,
        "step": step,
        "factor": step / 5,
        "strain_11": e,
        "strain_22": -0.3 * e,
        "strain_12": 1e-19,
        "stress_11_N_per_m": stress_per_strain * e,
        "stress_22_N_per_m": 0.0,
        "stress_12_N_per_m": 0.0,
        "strain_11_bar": 0.0,
        "strain_22_bar": 0.3 * e * bar,
        "strain_12_bar": 1e-19,
        "stress_11_bar_N_per_m": stress_per_strain * e * bar,
        "stress_22_bar_N_per_m": 0.0,
        "stress_12_bar_N_per_m": 0.0,
        "energy_N_per_m": 0.5 * stress_per_strain * e * e,
        "stable": step < 5,
    }


ROWS = [
    row(law, method, step, modulus)
    for law, method, modulus in (
        ("linear", "resolved", 1000.0),
        ("biot", "resolved", 1100.0),
        ("biot", "coarse", 1000.0),
        ("green", "resolved", 1200.0),
        ("green", "coarse", 1205.0),
    )
    for step in range(1, 6)
]


MEASURED = [
    {"cell": "lab", "law": "measured", "method": "measured", "stable": False, **point}
    for point in (
        {"step": 1, "strain_11": 0.03, "stress_11_N_per_m": 31.0},
        {"step": 2, "strain_11": 0.06, "strain_22": -0.02},
    )
]


class LoadPage(PageTest):
    def setUp(self):
        super().setUp()
        os.makedirs(self.folder)
        write_table(self.folder, "load.csv", MEASURED + ROWS)
        with open(os.path.join(self.folder, "study.json"), "w", encoding="utf-8") as file:
            json.dump({"command": "homespun periodic load x.prm", "control": "strain 11 = 0.1"}, file)
        write_verdicts(self.folder, [verdict("stripes: every level has an equilibrium", "PASS")])
        write_run(self.folder, "load")

    def test_the_page_has_curves_and_says_what_the_coarse_cloth_makes_of_them(self):
        self.assertEqual(self.whole_report(), (0, ""))
        page = self.page()
        self.assertIn("homespun: stripes", page)
        self.assertIn("Given stresses and strains", page)
        self.assertIn("Prescribed: strain 11 = 0.1.", page)
        self.assertIn("At 100 % of the load (biot): strain 11 = 10.0 %, strain 22 = ", page)
        self.assertIn(", stress 11 = 110 N/m.<", page)
        self.assertIn("biot: stress 11 of the coarse cloth is 9.09 % smaller than that of the cell",
                      page)
        self.assertIn("green: stress 11 of the coarse cloth differs from that of the cell by less"
                      " than the mesh may (0.417 %, the mesh 1.00 %)", page)
        self.assertIn("110.0 ± 1.1", page)
        self.assertIn("measured: lab", page)
        self.assertTrue(os.path.isfile(os.path.join(self.output, "figures", "load-stripes.csv")))

    def test_what_is_printed_of_an_end_holds_its_value_and_bar(self):
        end = row("biot", "resolved", 5, 1000.0)
        path = Path("a", "biot", "resolved", [end])
        for value, bar, shown in ((12.345, 0.001, "12.3450 ± 0.0010"),
                                  (35.195809, 2.78e-12, "35.1958 ± 9.1 × 10⁻⁶"),
                                  (2.0, 3.0, "2.0 ± 3.0")):
            end.update(stress_11_N_per_m=value, stress_11_bar_N_per_m=bar,
                       strain_22=value / 100.0, strain_22_bar=bar / 100.0)
            self.assertEqual([end_row(path)[k] for k in (4, 6)], [shown, shown])

    def test_a_stress_of_another_sign_is_not_called_smaller(self):
        paths = [Path("a", "biot", method, [row("biot", method, 5, modulus)])
                 for method, modulus in (("resolved", 1000.0), ("coarse", -350.0))]
        self.assertIn("biot: stress 11 of the coarse cloth is −35.0 N/m, of another sign than that"
                      " of the cell, 100.0 ± 1.0 N/m.", coarse_sentence(paths))
        self.assertFalse([one for one in coarse_sentence(paths) if "135 %" in one])
        free = [Path("a", "biot", method, [{**row("biot", method, 5, 1000.0), "strain_22": strain}])
                for method, strain in (("resolved", -0.03), ("coarse", 0.01))]
        self.assertIn("strain 22 of the coarse cloth is 1.00 %, of another sign than that of the"
                      " cell, −3.000 ± 0.030 %.", coarse_sentence(free)[1])

    def test_a_name_with_a_tag_in_it_is_shown_as_it_is(self):
        for file in ("load.csv", "study.json"):
            self.edit(file, lambda it: it.replace("stripes,", "warp<b>2,").replace("lab,", "<i>,"))
        self.assertEqual(self.run_report(), (0, ""))
        figure = re.search(r"<figure.*?</figure>", self.page(), re.S)[0]
        self.assertIn("An infinite cloth of <code>warp&lt;b&gt;2</code>", figure)
        self.assertIn("measured (&lt;i&gt;)", figure)
        self.assertIn('alt="An infinite cloth of warp&lt;b&gt;2.', figure)

    def test_what_lies_within_its_bar_or_round_off_has_no_panel(self):
        paths = {}
        for one in ROWS:
            key = (one["cell"], one["law"], one["method"])
            paths.setdefault(key, Path(*key)).rows.append(one)
        shown = panels(list(paths.values()))
        self.assertEqual([(x, y) for x, _, y, _ in shown],
                         [("strain_11", "stress_11_N_per_m"), ("strain_11", "strain_22")])
        figure = load_figure(LoadRun("x", "x", "", list(paths.values())), "stripes")
        first = figure.axes[0]
        self.assertEqual(len(first.lines), 6)  # five paths and the line of zero
        self.assertEqual([line.get_xdata()[0] for line in first.lines[:5]], [0.0] * 5)
        self.assertEqual(len(first.collections), 2)  # bars of the resolved biot and green

    def test_a_cloth_that_is_pressed_in_its_plane_wrinkles_and_the_sentence_says_so(self):
        def paths(modulus):
            return [Path("a", "biot", "resolved", [row("biot", "resolved", k, modulus) for k in (1, 2)])]

        self.assertEqual(pressed_sentence(paths(1000.0)), "")
        self.assertIn("smallest principal stress of −40.0 N/m (biot, resolved): a free sheet wrinkles"
                      " at once", pressed_sentence(paths(-1000.0)))
        shear = paths(1000.0)
        for one in shear[0].rows:
            one.update(stress_11_N_per_m=0.0, stress_12_N_per_m=30.0)
        self.assertIn("−30.0 N/m", pressed_sentence(shear))
        for one in shear[0].rows:  # round-off is no compression
            one.update(stress_11_N_per_m=1000.0, stress_22_N_per_m=-1e-9, stress_12_N_per_m=0.0)
        self.assertEqual(pressed_sentence(shear), "")

    def test_a_page_without_up_sampling_does_not_judge_it(self):
        write_verdicts(self.folder, [verdict("a level has an equilibrium", "PASS", kind="method")])
        write_run(self.folder, "load")
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn("(nothing is up-sampled here) (method)", self.page())
        self.assertNotIn("The method does what it is for", self.page())

    def test_a_damaged_row_is_refused_by_line_and_column(self):
        self.edit("load.csv", lambda text: text.replace("linear,resolved,2,", "linear,resolved,x,"))
        status, errors = self.run_report()
        self.assertEqual(status, 2)
        self.assertIn("load.csv, line 5", errors)


if __name__ == "__main__":
    unittest.main()
