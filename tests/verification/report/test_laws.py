# SPDX-License-Identifier: MIT
"""Tests of the figure of laws: its curves solve the equations of the first loss, and the page says
where a cell stands.
"""
import json
import re
import unittest

import numpy

import report_path  # noqa: F401
from figures import laws
from figures.fabrics import STRETCH
from made_up_run import list_again
from made_up_study import write_results
from page_case import PageTest


class Curves(unittest.TestCase):
    def test_they_solve_the_equations_of_the_first_loss(self):
        for ratio in (4.5, 20.0, 583.0):
            stretch = 1.0 + float(laws.loss_pulled(ratio))
            self.assertAlmostEqual(ratio * (stretch - 1.0) / (4.0 * stretch), 1.0, 12)
            for law, stress in (
                ("biot", lambda l, r=ratio: r * (l - 1.0) * (l + 2.0) / 4.0),
                ("green", lambda l, r=ratio: r * (l * l - 1.0) / 2.0),
                ("yarn", lambda l, r=ratio: r * (l - 1.0) * l),
            ):
                shorter = 1.0 - float(laws.loss_pressed(law, ratio))
                self.assertAlmostEqual(stress(shorter), -1.0, 9, law)
        self.assertTrue(numpy.isinf(laws.loss_pulled([0.5, 4.0])).all())
        self.assertEqual(laws.loss_pressed("yarn", 3.0), 1.0)
        # Figures of the law's first publication here: 0.69 % at 583, 25 % at 20.
        self.assertAlmostEqual(float(laws.loss_pulled(583.0)), 0.0069, 4)
        self.assertAlmostEqual(float(laws.loss_pulled(20.0)), 0.25, 12)

    def test_the_ratio_does_not_depend_on_how_a_cloth_lies(self):
        C = STRETCH["11oz-black-denim"]
        straight = laws.anisotropy(C)
        self.assertAlmostEqual(straight, (1014.0 - 10.2**2 / 205.0) / 53.4, 9)
        c, s = numpy.cos(0.4), numpy.sin(0.4)
        turn = numpy.array(
            [[c * c, s * s, -2 * c * s], [s * s, c * c, 2 * c * s], [c * s, -c * s, c * c - s * s]]
        )
        self.assertAlmostEqual(laws.anisotropy(turn @ C @ turn.T) / straight, 1.0, 4)
        for name, matrix in STRETCH.items():
            self.assertGreater(numpy.linalg.eigvalsh(matrix).min(), 0.0, name)


class LawOnThePage(PageTest):
    def test_the_page_says_where_the_cell_stands(self):
        write_results(self.folder)

        def stiff(text):
            found = json.loads(text)
            for key in ("C", "C_lower", "C_upper"):
                found[key] = numpy.diag([100.0, 50.0, 0.1]).tolist()
            return json.dumps(found)

        self.edit("stripes/homogenize.json", stiff)
        list_again(self.folder)
        self.assertEqual(self.run_report(saved=["stripes-which-law"]), (0, ""))
        page = self.page()
        self.assertIn("Which law for which cloth", page)
        # 4 / (1000 - 4) = 0.40 %
        said = re.search(r"E/G = 1000\) the law (.{0,90})pulled along its stiff axis", page)
        self.assertIsNotNone(said)
        self.assertIn("is lost at 0.402 %", said.group(1))


if __name__ == "__main__":
    unittest.main()
