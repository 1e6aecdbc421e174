# SPDX-License-Identifier: MIT
"""The answer does not depend on the number of ranks."""
import csv
import json
import os
import subprocess
import sys
import unittest
from xml.etree import ElementTree

import meshio
import numpy

from cli import CELLS, LAYERED, PROGRAM, THREE, InFolder, cut, run

sys.path.append(str(CELLS.parents[1] / "verification" / "report"))
from read.vtu import read_vtu  # noqa: E402


class Ranks(InFolder):
    def stiffness(self, cell, order, ranks):
        output = self.folder / f"{cell.stem}-{order}-{ranks}"
        result = run("homogenize", cell, "--order", order, "--refine", 1, "--no-bars", "--quiet",
                     "--output", output, ranks=ranks)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads((output / "homogenize.json").read_text())["C"]

    def test_stiffness_agrees_on_one_two_and_four_ranks(self):
        for cell, order, numbers in ((LAYERED, 1, (2, 4)), (THREE, 2, (2,))):
            alone = self.stiffness(cell, order, 1)
            largest = max(abs(value) for row in alone for value in row)
            for ranks in numbers:
                together = self.stiffness(cell, order, ranks)
                for i in range(3):
                    for j in range(3):
                        self.assertAlmostEqual(together[i][j], alone[i][j], delta=1e-10 * largest)

    def test_errors_of_a_study_agree_on_one_and_two_ranks(self):
        rows = {}
        for ranks in (1, 2):
            output = self.folder / f"study-{ranks}"
            result = run("strain", THREE, "--cells", 2, "--strains",
                         "0.01,0.1", "--loads", "periodic-12,strip-2", "--references",
                         "linear,biot", "--no-runtime", "--no-report", "--quiet",
                         "--output", output, ranks=ranks)
            # At 10 % the budget of a sheet may be open.
            self.assertIn(result.returncode, (0, 4), result.stderr)
            with open(output / "strain.csv", newline="", encoding="utf-8") as file:
                rows[ranks] = list(csv.DictReader(file))
        self.assertEqual(len(rows[1]), len(rows[2]))
        for one, two in zip(rows[1], rows[2]):
            self.assertEqual(one["method"], two["method"])
            error = float(one["error_mean_m"])
            self.assertAlmostEqual(error, float(two["error_mean_m"]), delta=2e-5 * error + 1e-15)

    def test_a_budget_that_is_not_found_is_a_note_and_no_rank_waits(self):
        # Stripes of contrast 1e9: their coarse equilibrium at 10 % is not found by the budget,
        # which the first rank alone knows.
        cell = self.cell_with("soft: 1e6", "soft: 1e-2")
        output = self.folder / "study"
        result = run("strain", cell, "--cells", 2, "--strains", "0.01,0.1", "--loads", "strip-1",
                     "--references", "biot", "--methods", "localized", "--no-report",
                     "--no-runtime", "--quiet", "--output", output, ranks=2)
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        notes = (output / "levels.csv").read_text()
        self.assertIn("error budget: ", notes)
        with open(output / "strain.csv", newline="", encoding="utf-8") as file:
            self.assertEqual([row["strain"] for row in csv.DictReader(file)], ["0.01", "0.1"])


def chi_of(piece):
    return numpy.hstack([piece.point_data[f"chi_{ij}"][:, :2] for ij in (11, 22, 12)])


def materials_of(piece):
    """Centre and material of each triangle, sorted."""
    triangles = piece.cells_dict["triangle"]
    centres = piece.points[triangles].mean(axis=1).round(9).tolist()
    materials = piece.point_data["material"][triangles[:, 0]]
    return sorted((*centre, material) for centre, material in zip(centres, materials))


class Homogenize(InFolder):
    CELL = THREE

    def pieces(self, output, ranks):
        result = run("homogenize", self.CELL, "--refine", 2, "--no-bars", "--quiet", "--pieces",
                     "--output", output, ranks=ranks)
        self.assertEqual(result.returncode, 0, result.stderr)
        listing = output / "characteristic-displacements-refined.pvtu"
        collection = ElementTree.parse(listing).getroot()
        names = [piece.get("Source") for piece in collection.iter("Piece")]
        self.assertEqual(len(names), ranks)
        self.assertEqual(len(list(output.glob("characteristic-displacements-refined-*.vtu"))),
                         ranks)
        pieces = [meshio.read(output / name) for name in names]
        arrays = {array.get("Name") for array in collection.iter("PDataArray")}
        for piece in pieces:
            self.assertLessEqual({"chi_11", "chi_22", "chi_12", "material", "rank"},
                                 arrays & set(piece.point_data))
        return pieces

    def test_pieces_make_up_the_refined_mesh_and_its_displacements(self):
        output = self.folder / "out"
        two, one = self.pieces(output, 2), self.pieces(output, 1)[0]
        given = read_vtu(output / "characteristic-displacements.vtu")
        sizes = [len(piece.cells_dict["triangle"]) for piece in two]
        self.assertEqual(sum(sizes), 16 * len(given.triangles))
        for number, piece in enumerate(two):
            self.assertTrue((piece.point_data["rank"] == number).all())
            self.assertGreater(sizes[number], 4 * len(given.triangles))
        chi_at = dict(zip(map(tuple, one.points.round(9)), chi_of(one)))
        for piece in two:
            chi = chi_of(piece)
            expected = numpy.array([chi_at[tuple(point)] for point in piece.points.round(9)])
            self.assertGreater(numpy.abs(expected).max(), 1e-4)
            numpy.testing.assert_allclose(chi, expected, rtol=0,
                                          atol=1e-6 * numpy.abs(expected).max())
        # Every triangle is in one piece, with its material.
        numpy.testing.assert_allclose(sorted(materials_of(two[0]) + materials_of(two[1])),
                                      materials_of(one), rtol=0, atol=1e-8)

    def test_what_another_cell_left_is_refused_and_goes_when_it_begins_anew(self):
        study = ["--no-bars", "--quiet", "--output", self.folder]
        self.assertEqual(run("homogenize", THREE, *study).returncode, 0)
        cut(self.folder)
        left = self.folder / "cell.h5"
        self.assertTrue(left.exists())
        of_another = left.read_bytes()
        refused = run("homogenize", LAYERED, *study, "--resume")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("holds another run", refused.stderr)
        self.assertEqual(left.read_bytes(), of_another)
        again = run("homogenize", LAYERED, *study, "--overwrite")
        self.assertEqual(again.returncode, 0)
        found = json.loads((self.folder / "homogenize.json").read_text())
        self.assertEqual(found["cell"], "layered")


class Scaling(InFolder):
    def test_a_row_for_each_mesh_solver_and_number_of_ranks_and_one_stiffness_for_each_mesh(self):
        script = CELLS.parents[1] / "tests" / "benchmarks" / "scaling.py"
        found = subprocess.run(
            [sys.executable, script, PROGRAM, THREE, "--refine", "0,1",
             "--ranks", "1,2", "--solver", "multigrid,direct", "--repeats", "1", "--launcher",
             f"{os.environ['MPIEXEC']} --oversubscribe -n {{ranks}}"],
            check=True, capture_output=True, text=True, timeout=600)
        rows = list(csv.DictReader(found.stdout.splitlines()))
        self.assertEqual(len(rows), 8)
        for row in rows:
            self.assertGreater(float(row["seconds_solve"]), 0)
            self.assertGreater(float(row["bytes_largest_rank"]), 1e7)
            self.assertEqual(row["given_up"], "0")
        for refine in ("0", "1"):
            stiffnesses = [float(row["C_11"]) for row in rows if row["refine"] == refine]
            self.assertLess(max(stiffnesses) - min(stiffnesses), 1e-10 * max(stiffnesses))


if __name__ == "__main__":
    unittest.main()
