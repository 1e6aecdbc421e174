# SPDX-License-Identifier: MIT
"""A cell that is neither square nor rectangular: the side of a cell is the root of its area,
wherever an error is given in sides of the cell."""
import math
import unittest

from broken_cells_test import Cell
from cli import rows_of, run
from scene_case import SceneCase

SIDE = 0.002 * math.sqrt(math.sqrt(0.75))  # a rhombus of 2 mm and 60 degrees [m]


class Oblique(SceneCase):
    def setUp(self):
        super().setUp()
        cell = Cell(4)
        cell.points = [[x + 0.5 * y, math.sqrt(0.75) * y, 0.] for x, y, _ in cell.points]
        cell.groups = [2 if {*cell.square_of(t)} <= {1, 2} else 1
                       for t in range(len(cell.triangles))]
        cell.keys["Length unit"] = "0.002"
        self.cell = cell.write(self.folder)

    def assert_sides(self, file, mean, per_cell):
        """Of all rows that have both columns filled."""
        sides = [float(row[mean]) / float(row[per_cell]) for row in rows_of(file)
                 if row[mean] and row[per_cell] and float(row[per_cell]) > 0.]
        self.assertGreater(len(sides), 0, file.name)
        for side in sides:
            self.assertAlmostEqual(side / SIDE, 1., delta=1e-9, msg=file.name)

    def test_errors_in_sides_of_the_cell_are_over_the_root_of_its_area(self):
        strain, scale = self.folder / "strain", self.folder / "scale"
        result = run("strain", self.cell, "--cells", 2, "--strains", 0.01, "--loads", "shear-frame",
                     "--references", "linear,biot", "--methods", "localized", "--no-report",
                     "--output", strain)
        self.assertEqual(result.returncode, 0, result.stderr)
        for table, mean, per_cell in (("strain", "error_mean_m", "error_mean_per_cell"),
                                      ("runtime", "error_mean_m", "error_mean_per_cell"),
                                      ("budget", "mean_m", "mean_per_cell")):
            self.assert_sides(strain / f"{table}.csv", mean, per_cell)

        # The other study says the same of this sheet, in its own words.
        result = run("converge", self.cell, "--studies", "scale", "--quick", "--no-report",
                     "--output", scale)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        per_strain = [float(row["error"]) for row in rows_of(scale / "converge.csv")
                      if row["quantity"] == "localized: mean error per strain [cell sides]"
                      and row["case"] == "shear-frame" and row["h"] == "0.5"]
        known = [float(row["error_mean_per_cell"]) / 0.01
                 for row in rows_of(strain / "strain.csv")
                 if row["reference"] == "linear" and row["method"] == "localized"]
        self.assertEqual((len(per_strain), len(known)), (1, 1))
        self.assertAlmostEqual(per_strain[0] / known[0], 1., delta=1e-6)

    def test_so_are_those_of_a_scene(self):
        scene = self.scene({"Cells": str(self.cell)})
        result = run("drape", scene, "--cells", 2, "--duration", 0.05, "--references", "shell",
                     "--no-report", "--no-frames", "--output", self.folder / "out")
        self.assertIn(result.returncode, (0, 4), result.stderr)
        self.assert_sides(self.folder / "out" / "drape.csv", "error_mean_m", "error_mean_per_cell")


if __name__ == "__main__":
    unittest.main()
