# SPDX-License-Identifier: MIT
"""Forces as a user finds them: of clamps, an infinite cloth, pins; and what ParaView shows."""
import json
import sys
import unittest

import numpy

from cli import CELLS, LAYERED, InFolder, rows_of, run

sys.path.append(str(CELLS.parents[1] / "verification" / "report"))
from read.vtu import read_vtu  # noqa: E402

SCENES = CELLS.parent / "scenes"


def number(row, column):
    return float(row[column])


class Strain(InFolder):
    def test_forces_of_a_quick_study_are_those_of_linear_theory_and_have_a_bar(self):
        output = self.folder / "out"
        result = run("strain", LAYERED, "--quick", "--loads", "periodic-22,strip-2",
                     "--references", "linear,biot", "--strains", "0.01,0.1", "--no-budget",
                     "--no-runtime", "--no-report", "--output", output)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        rows = {(row["load"], float(row["strain"]), row["reference"], row["method"]): row
                for row in rows_of(output / "forces.csv")}
        self.assertEqual(len(rows), 2 * 2 * 2 * 3)
        stiffness = json.loads((output / "layered" / "homogenize.json").read_text())["C"]
        for strain in (0.01, 0.1):
            linear = {(load, method): rows[load, strain, "linear", method]
                      for load in ("periodic-22", "strip-2")
                      for method in ("resolved", "coarse", "affine")}
            # Homogenization is exact for an infinite cloth in linear theory.
            for method in ("resolved", "coarse"):
                row = linear["periodic-22", method]
                self.assertEqual(row["force_N"], "")
                for column, entry in (("force_per_width_N_per_m", (1, 1)),
                                      ("stress_22_N_per_m", (1, 1)), ("stress_11_N_per_m", (0, 1))):
                    expected = strain * stiffness[entry[0]][entry[1]]
                    self.assertAlmostEqual(number(row, column) / expected, 1., delta=1e-8)
            for load in ("periodic-22", "strip-2"):
                resolved, coarse, affine = (number(linear[load, method], "force_per_width_N_per_m")
                                            for method in ("resolved", "coarse", "affine"))
                self.assertGreater(affine, resolved * (1. + 1e-6))
                self.assertLess(abs(coarse - resolved), 0.1 * resolved)
            for row in linear.values():
                bar, force = (number(row, column) for column in
                              ("reference_uncertainty_N_per_m", "force_per_width_N_per_m"))
                self.assertGreaterEqual(bar, 0.)
                self.assertLess(bar, 0.2 * force)
        # Linear theory is linear, and its force is that of a clamp of the sheet's width.
        width = 4. * json.loads((output / "layered" / "homogenize.json").read_text())["area"] ** 0.5
        for method in ("resolved", "coarse", "affine"):
            small, large = (rows["strip-2", strain, "linear", method] for strain in (0.01, 0.1))
            self.assertAlmostEqual(number(large, "force_N") / number(small, "force_N"), 10.,
                                   delta=1e-6)
            self.assertAlmostEqual(number(small, "force_N")
                                   / number(small, "force_per_width_N_per_m"), width,
                                   delta=1e-9 * width)

    def test_sheets_are_left_for_paraview_near_a_tenth_and_at_the_largest_strain(self):
        output = self.folder / "out"
        result = run("strain", LAYERED, "--cells", "2", "--loads", "strip-2",
                     "--references", "linear,biot", "--strains", "0.01,0.1,0.15", "--no-budget",
                     "--no-runtime", "--no-report", "--output", output)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        folder = output / "layered"
        self.assertEqual(sorted(path.name for path in folder.glob("sheet-*.vtu")),
                         ["sheet-strip-2-0.1.vtu", "sheet-strip-2-0.15.vtu"])
        rows = {(float(row["strain"]), row["method"]): row for row in rows_of(output / "strain.csv")
                if row["reference"] == "biot"}
        for strain in (0.1, 0.15):
            sheet = read_vtu(folder / f"sheet-strip-2-{strain}.vtu")
            for method in ("affine", "full"):
                error = number(rows[strain, method], "error_mean_m")
                self.assertAlmostEqual(float(numpy.mean(sheet.point_data[f"error {method} [m]"])),
                                       error, delta=1e-5 * error)


class Cell(InFolder):
    def test_the_vtu_of_a_cell_holds_strains_and_stresses_whose_mean_is_its_stiffness(self):
        output = self.folder / "out"
        self.assertEqual(run("homogenize", LAYERED, "--no-bars", "--output",
                             output).returncode, 0)
        cell = read_vtu(output / "characteristic-displacements.vtu")
        points, triangles = cell.points, cell.triangles
        legs = points[triangles[:, 1:], :2] - points[triangles[:, :1], :2]
        areas = 0.5 * numpy.linalg.det(legs)
        stiffness = numpy.array(json.loads((output / "homogenize.json").read_text())["C"])
        for a, load in enumerate(("11", "22", "12")):
            mean = areas @ cell.cell_data[f"stress_{load} (11, 22, 12) [N/m]"] / areas.sum()
            # Single precision.
            numpy.testing.assert_allclose(mean, stiffness[a], atol=1e-6 * stiffness.max())
            mean = areas @ cell.cell_data[f"strain_{load} (11, 22, 2x12) [-]"] / areas.sum()
            numpy.testing.assert_allclose(mean, numpy.eye(3)[a], atol=1e-6)
            for field in ("strain", "stress"):
                for k in (1, 2):
                    unit = "[-]" if field == "strain" else "[N/m]"
                    self.assertEqual(
                        cell.cell_data[f"{field}_{load} principal {k} {unit}"].shape[1], 3)


class Drape(InFolder):
    def test_the_pins_of_a_hanging_sheet_carry_its_weight(self):
        output = self.folder / "out"
        scene = (SCENES / "hang.prm").read_text(encoding="utf-8").replace("../cells", str(CELLS))
        (self.folder / "scene.prm").write_text(scene + "\nset Integrator = static\n",
                                               encoding="utf-8")
        result = run("drape", self.folder / "scene.prm", "--quick", "--duration", 0.05,
                     "--references", "biot,shell", "--unit-cells", LAYERED,
                     "--no-frames", "--no-report", "--output", output)
        self.assertEqual(result.returncode, 0, result.stderr)
        cell = json.loads((output / "drape.json").read_text())["cells"][0]
        weight = 9.81 * cell["areal_density"] * 16. * cell["cell_side_m"] ** 2
        rows = [row for row in rows_of(output / "motion.csv") if row["place"]]
        self.assertEqual([(row["cloth"], row["variant"], row["place"], row["frame"])
                          for row in rows],
                         [("coarse", "biot", "top", "1"), ("reference", "biot", "top", "1"),
                          ("reference", "shell", "top", "1")])
        for row in rows:
            self.assertAlmostEqual(number(row, "force_z_N") / weight, 1., delta=1e-5)
            self.assertLess(abs(number(row, "force_y_N")), 1e-5 * weight)
            self.assertLess(abs(number(row, "force_x_N")), 1e-5 * weight)


if __name__ == "__main__":
    unittest.main()
