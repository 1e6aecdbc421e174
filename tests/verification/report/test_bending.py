# SPDX-License-Identifier: MIT
"""Tests of what the page says of bending: its units, its bars, what is not stored, and what the
inputs are worth.
"""
import json
import os
import unittest

import h5py
import numpy

import report_path  # noqa: F401
from figures import fabrics
from figures.bending import roll_figure
from figures.stiffness import directional_modulus
from made_up_run import list_again
from made_up_study import write_results
from page_case import PageTest

BENDING = numpy.array([[5e-5, 6e-6, 1e-20], [6e-6, 2e-5, 0.0], [1e-20, 0.0, 2.2e-5]])


class BendingTest(PageTest):
    def add_bending(self, D):
        def change(text):
            found = json.loads(text)
            found.update(
                D=D.tolist(),
                D_lower=(0.99 * D).tolist(),
                D_upper=D.tolist(),
                bending_bracket={
                    "width": 0.01,
                    "of": "mesh",
                    "remark": "made up",
                    "entry_bars": numpy.maximum(0.01 * numpy.abs(D), 1e-18).tolist(),
                },
                rolled={
                    "says": "D^H holds to 2 % where made up\nwarning: made up too",
                    "tolerance": 0.02,
                    "degrees_from_x": [0, 45, 90, 135],
                    "least_radius_m": [0.01, 0.02, 0.0, 0.02],
                },
                sensitivity=[
                    {
                        "phase": "soft",
                        "constant": "thickness",
                        "value": 5e-4,
                        "unit": "m",
                        "C": (numpy.array(found["C"]) / 5e-4).tolist(),
                        "D": (3.0 * D / 5e-4).tolist(),
                    }
                ],
            )
            return json.dumps(found)

        self.edit("stripes/homogenize.json", change)
        with h5py.File(os.path.join(self.folder, "stripes", "cell.h5"), "a") as file:
            file["deflection"] = 1e-6 * numpy.arange(3.0 * len(file["vertices"])).reshape(-1, 3)
        list_again(self.folder)

    def test_bending_stands_in_si_and_in_the_units_of_instruments(self):
        write_results(self.folder)
        self.add_bending(BENDING)
        figures = ("stripes-bending-stiffness", "stripes-deflections")
        self.assertEqual(self.run_report(saved=figures), (0, ""))
        page = self.page()
        # Between 49.5e-6 and 50e-6 N m: the middle, 0.507 gf cm^2/cm, and half the width.
        self.assertRegex(
            page, r"<td[^>]*>D11</td><td[^>]*>49\.75</td><td[^>]*>0\.25</td><td[^>]*>0\.507</td>"
        )
        # Zero to its bar in every unit.
        self.assertRegex(page, r"<td[^>]*>D16</td><td[^>]*>0</td><td[^>]*>[^<]*</td><td[^>]*>0</td>")
        for name in figures:
            self.assertIn(f'id="{name}"', page)
        self.assertNotIn("Outside of cloth", page)
        self.assertNotIn("bending stiffness of stripes, because", page)
        # One per cent of thickness: one of C, three of D.
        self.assertRegex(
            page, r"<td[^>]*>soft.thickness</td><td[^>]*>1 %</td><td[^>]*>C</td><td[^>]*>1\.00</td>"
        )
        self.assertRegex(
            page, r"<td[^>]*>soft.thickness</td><td[^>]*>1 %</td><td[^>]*>D</td><td[^>]*>3\.00</td>"
        )

    def test_what_is_not_stored_is_said_once(self):
        write_results(self.folder)
        self.assertEqual(self.run_report(), (0, ""))
        self.assertEqual(self.page().count("bending stiffness of stripes, because"), 1)

    def test_how_tightly_a_sheet_may_be_rolled_is_said_and_drawn(self):
        rolled = {"degrees_from_x": [0, 45, 90, 135], "least_radius_m": [0.01, 0.02, 0.0, 0.02]}
        line = roll_figure(rolled).axes[0].lines[0]
        self.assertEqual(line.get_ydata().tolist(), [1.0, 2.0, 0.0, 2.0, 1.0, 2.0, 0.0, 2.0, 1.0])
        self.assertAlmostEqual(line.get_xdata()[5], 1.25 * numpy.pi)
        write_results(self.folder)
        self.add_bending(BENDING)
        self.assertEqual(self.run_report(saved=["stripes-least-radius"]), (0, ""))
        self.assertIn("Dᴴ holds to 2 % where made up.", self.page())
        self.assertIn('"left-out">warning: made up too.', self.page())
        self.assertIn("stripes-least-radius", self.page())

    def test_bending_far_from_cloth_is_warned_of(self):
        write_results(self.folder)
        self.add_bending(1e6 * BENDING)
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn("Outside of cloth", self.page())


class UnitsTest(unittest.TestCase):
    def test_a_strip_bends_as_its_cantilever_says(self):
        # B = rho g c^3 with c the bending length: 2 cm at 0.2 kg/m^2.
        self.assertAlmostEqual(
            fabrics.bending_length(0.2 * 9.80665 * 0.02**3, 0.2), 0.02, places=12
        )
        # 1 gf cm^2/cm: 9.80665e-3 N times 1e-4 m^2 over 1e-2 m.
        self.assertAlmostEqual(fabrics.KAWABATA, 9.80665e-3 * 1e-4 / 1e-2, delta=1e-18)

    def test_strips_along_the_axes_have_the_inverse_compliance(self):
        S = numpy.linalg.inv(BENDING)
        moduli = directional_modulus(BENDING, numpy.array([0.0, numpy.pi / 2]))
        self.assertTrue(numpy.allclose(moduli, [1.0 / S[0, 0], 1.0 / S[1, 1]], rtol=1e-13))


if __name__ == "__main__":
    unittest.main()
