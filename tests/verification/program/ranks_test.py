# SPDX-License-Identifier: MIT
"""The answer does not depend on the number of ranks."""
import csv
import json
import signal
import subprocess
import sys
import time
import unittest
from xml.etree import ElementTree

import numpy

from cli import CELLS, PATIENCE, PROGRAM, InFolder, cut, rows_of, run

sys.path.append(str(CELLS.parents[1] / "verification" / "report"))
from read.vtu import read_vtu  # noqa: E402


class Ranks(InFolder):
    def stiffness(self, cell, order, ranks):
        output = self.folder / f"{cell}-{order}-{ranks}"
        result = run("homogenize", CELLS / f"{cell}.prm", "--order", order, "--refine", 1,
                     "--quiet", "--output", output, ranks=ranks)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads((output / "homogenize.json").read_text())["C"]

    def test_stiffness_agrees_on_one_two_and_four_ranks(self):
        for cell in ("layered", "three-stiffness"):
            for order in (1, 2):
                alone = self.stiffness(cell, order, 1)
                largest = max(abs(value) for row in alone for value in row)
                for ranks in (2, 4):
                    together = self.stiffness(cell, order, ranks)
                    for i in range(3):
                        for j in range(3):
                            self.assertAlmostEqual(together[i][j], alone[i][j],
                                                   delta=1e-10 * largest)

    def test_errors_of_a_study_agree_on_one_and_two_ranks(self):
        rows = {}
        for ranks in (1, 2):
            output = self.folder / f"study-{ranks}"
            result = run("strain", CELLS / "three-stiffness.prm", "--cells", 2, "--strains",
                         "0.01,0.1", "--loads", "periodic-12,strip-2", "--no-report", "--quiet",
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
        notes = (output / "notes.csv").read_text()
        self.assertIn("error budget: ", notes)
        with open(output / "strain.csv", newline="", encoding="utf-8") as file:
            self.assertEqual([row["strain"] for row in csv.DictReader(file)], ["0.01", "0.1"])


def chi_of(surface):
    return numpy.hstack([surface.point_data[f"chi_{ij} [m]"] for ij in (11, 22, 12)])


def materials_of(surface):
    """Centre and material of each triangle, sorted."""
    centres = surface.points[surface.triangles].mean(axis=1).tolist()
    return sorted((*centre, material)
                  for centre, material in zip(centres, surface.cell_data["material"]))


class Homogenize(InFolder):
    CELL = CELLS / "three-stiffness.prm"

    def stiffness(self, output):
        return numpy.array(json.loads((output / "homogenize.json").read_text())["C"])

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
        surfaces = [read_vtu(output / name) for name in names]
        arrays = {array.get("Name") for array in collection.iter("PDataArray")}
        for surface in surfaces:
            self.assertEqual(arrays, {"positions [m]", *surface.point_data, *surface.cell_data})
        return surfaces

    def test_pieces_make_up_the_refined_mesh_and_its_displacements(self):
        output = self.folder / "out"
        two, one = self.pieces(output, 2), self.pieces(output, 1)[0]
        given = read_vtu(output / "characteristic-displacements.vtu")
        self.assertEqual(sum(len(surface.triangles) for surface in two), 16 * len(given.triangles))
        for number, surface in enumerate(two):
            self.assertTrue((surface.cell_data["rank"] == number).all())
            self.assertGreater(len(surface.triangles), 4 * len(given.triangles))
        chi_at = dict(zip(map(tuple, one.points.round(9)), chi_of(one)))
        for surface in two:
            chi = chi_of(surface)
            expected = numpy.array([chi_at[tuple(point)] for point in surface.points.round(9)])
            self.assertGreater(numpy.abs(expected).max(), 1e-4)
            numpy.testing.assert_allclose(chi, expected, rtol=0,
                                          atol=1e-6 * numpy.abs(expected).max())
        # Every triangle is in one piece, with its material.
        numpy.testing.assert_allclose(sorted(materials_of(two[0]) + materials_of(two[1])),
                                      materials_of(one), rtol=0, atol=1e-12)

    def test_a_run_that_was_killed_goes_on_from_the_loads_that_are_done(self):
        study = [PROGRAM, "homogenize", self.CELL, "--refine", "5", "--order", "1", "--no-bars",
                 "--quiet", "--output"]
        whole, killed = self.folder / "whole", self.folder / "killed"
        subprocess.run([*map(str, study), str(whole)], check=True, timeout=600 * PATIENCE)
        self.assertFalse((whole / ".homespun-loads").exists())
        with subprocess.Popen([*map(str, study), str(killed)]) as process:
            first = killed / ".homespun-loads" / "load-0-rank-0-of-1"
            deadline = time.monotonic() + 600 * PATIENCE
            while not first.exists() and process.poll() is None and time.monotonic() < deadline:
                time.sleep(0.01)
            process.send_signal(signal.SIGKILL)
        self.assertTrue(first.exists(),
                        "it was killed before the first load was solved, or ended before")
        self.assertFalse((killed / "homogenize.json").exists())
        # The loads run abreast: others may have been solved in the same iteration.
        n_done = len(list(first.parent.glob("load-?-rank-0-of-1")))
        resumed = subprocess.run([*map(str, study), str(killed)], capture_output=True, text=True,
                                 check=False, timeout=600 * PATIENCE)
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        expected = self.stiffness(whole)
        numpy.testing.assert_allclose(self.stiffness(killed), expected, rtol=0,
                                      atol=1e-10 * numpy.abs(expected).max())
        self.assertEqual(json.loads((killed / "homogenize.json").read_text())["loads_taken_up"],
                         n_done)
        self.assertFalse((killed / ".homespun-loads").exists())

    def test_what_another_cell_left_is_refused_and_goes_when_it_begins_anew(self):
        study = ["--no-bars", "--quiet", "--output", self.folder]
        self.assertEqual(run("homogenize", CELLS / "three-stiffness.prm", *study).returncode, 0)
        cut(self.folder)
        left = self.folder / ".homespun-loads"
        left.mkdir()
        # As many degrees of freedom as layered has.
        (left / "load-0-rank-0-of-1").write_bytes(bytes(8 * 3034))
        refused = run("homogenize", CELLS / "layered.prm", *study, "--resume")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("holds another run", refused.stderr)
        self.assertTrue(left.exists())
        again = run("homogenize", CELLS / "layered.prm", *study, "--overwrite")
        self.assertEqual(again.returncode, 0)
        found = json.loads((self.folder / "homogenize.json").read_text())
        self.assertEqual(found["loads_taken_up"], 0)
        self.assertFalse(left.exists())


class Scaling(InFolder):
    STUDY = ["scaling", CELLS / "layered.prm", "--refine", "1,2", "--ranks", "1,2", "--repeats",
             "1", "--quiet"]

    def test_rows_of_every_mesh_and_number_of_ranks_are_written_and_kept(self):
        (self.folder / "run").mkdir()  # of the user: not the study's to remove
        result = run(*self.STUDY, "--output", self.folder)
        # Meshes as small as these are no claim on memory.
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        rows = rows_of(self.folder / "scaling.csv")
        self.assertEqual([(row["refine"], row["ranks"]) for row in rows],
                         [("1", "1"), ("1", "2"), ("2", "1"), ("2", "2")])
        self.assertTrue(all(float(row["seconds_solve"]) > 0
                            and float(row["bytes_largest_rank"]) > 1e7 for row in rows))
        verdicts = json.loads((self.folder / "verdicts.json").read_text())["verdicts"]
        self.assertEqual(verdicts[0]["verdict"], "PASS", verdicts[0])
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["run", "run.json", "scaling.csv", "scaling.json", "verdicts.json"])
        self.assertIn("Iterations lie between",
                      *json.loads((self.folder / "scaling.json").read_text())["notes"])
        again = run(*self.STUDY, "--output", self.folder, "--resume")
        self.assertEqual(again.returncode, result.returncode, again.stderr)
        self.assertEqual(rows_of(self.folder / "scaling.csv"), rows)
        table = self.folder / "scaling.csv"
        table.write_text(table.read_text().replace(rows[1]["dofs"], "12x", 1))
        cut(self.folder)
        damaged = run(*self.STUDY, "--output", self.folder, "--resume")
        self.assertEqual(damaged.returncode, 2)
        self.assertIn("scaling.csv:2: column `dofs`: found `12x`", damaged.stderr)

    def test_faults_are_told_at_once_and_a_launcher_that_does_not_run_by_what_it_said(self):
        result = run(*self.STUDY, "--ranks", "0", "--launcher", "mpirun -n 2", "--output",
                     self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("--ranks: found 0", result.stderr)
        self.assertIn("expected {ranks} where the number of ranks stands", result.stderr)
        result = run(*self.STUDY, "--launcher", "no-such-launcher {ranks}", "--output",
                     self.folder / "out")
        self.assertEqual(result.returncode, 2)
        self.assertIn("mend --launcher", result.stderr)
        result = run(*self.STUDY, "--output", self.folder / "out", ranks=2)
        self.assertEqual(result.returncode, 2)
        self.assertIn("without mpirun", result.stderr)


if __name__ == "__main__":
    unittest.main()
