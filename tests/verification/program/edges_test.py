# SPDX-License-Identifier: MIT
"""Edges as a user finds them: in cell.h5, as a method of strain, and where there are none."""
import json
import sys
import unittest

import h5py
import numpy

from cli import CELLS, LAYERED, LONG, THREE, WEAVE, InFolder, rows_of, run


class Edges(InFolder):
    def test_cell_files_hold_edges_with_units_and_say_which_is_which(self):
        output = self.folder / "out"
        result = run("homogenize", LAYERED, "--order", "1", "--no-bars", "--quiet",
                     "--output", output)
        self.assertEqual(result.returncode, 0, result.stderr)
        summary = json.loads((output / "homogenize.json").read_text())["edges"]
        self.assertTrue(summary["stored"])
        with h5py.File(output / "cell.h5") as file:
            edges = file["edges"]
            n_vertices = len(file["vertices"])
            for name, shape, unit in (("slip", (4, 2, 3), "m"), ("tension", (4, 3), "N"),
                                      ("bulk", (2, 3, 3), "N")):
                self.assertEqual(edges[name].shape, shape)
                self.assertEqual(edges[name].attrs["unit"].decode(), unit)
            for side, known in enumerate(summary["sides"]):
                n_cells = edges["n_cells"][side]
                self.assertEqual(known["cells"], n_cells)
                for kind in ("clamped", "free"):
                    self.assertEqual(edges[f"{kind}_{side}"].shape, (n_cells, n_vertices, 2, 3))
            # Stripes: (E_h - E_s) t (1/8 - s/2) x the cell, a full soft stripe outermost.
            stiffness = numpy.array(file["C"])
            strain = numpy.linalg.inv(stiffness)[:, 0]
            tension = edges["tension"][2] @ strain / strain[0]
            self.assertAlmostEqual(tension / (9e6 * 5e-4 * 0.01), -1. / 8., delta=1e-9)

    def test_edges_that_would_take_longer_than_all_else_are_left_out_with_an_estimate(self):
        sys.path.insert(0, str(CELLS.parents[1] / "tests" / "benchmarks" / "pareto"))
        import answered_cells  # pylint: disable=import-outside-toplevel,import-error
        answered_cells.write_cell_file(answered_cells.make_cell("laminate", 180),
                                       self.folder / "fine")
        output = self.folder / "out"
        result = run("homogenize", self.folder / "fine.prm", "--order", "1", "--no-bars", "--quiet",
                     "--output", output)
        self.assertEqual(result.returncode, 0, result.stderr)
        summary = json.loads((output / "homogenize.json").read_text())
        self.assertEqual(summary["second_order"], {"laws": ["biot", "green"]})
        self.assertFalse(summary["edges"]["stored"])
        self.assertRegex(summary["edges"]["why_not"],
                         r"^they would take about 1[0-9] s on this mesh, more than 10: strain")
        # The closed form of the laminate: what is left out touches nothing else.
        for found, known in zip(summary["C"], answered_cells.laminate_stiffness()):
            for entry, answer in zip(found, known):
                self.assertAlmostEqual(entry, answer, delta=1e-6)

    def test_edges_that_would_not_belong_to_chi_are_left_out(self):
        output = self.folder / "out"
        result = run("homogenize", THREE, "--refine", "1", "--quiet", "--output", output)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        summary = json.loads((output / "homogenize.json").read_text())
        self.assertFalse(summary["edges"]["stored"])
        self.assertIn("belong to the chi of the mesh as given", summary["edges"]["why_not"])
        with h5py.File(output / "cell.h5") as file:
            self.assertNotIn("edges", file)

    @unittest.skipUnless(LONG, "of edges that would take longer the same is said")
    def test_modes_that_would_take_longer_than_all_else_are_left_out_with_an_estimate(self):
        sys.path.insert(0, str(CELLS.parents[1] / "tests" / "benchmarks" / "pareto"))
        import answered_cells  # pylint: disable=import-outside-toplevel,import-error
        answered_cells.write_cell_file(answered_cells.make_cell("laminate", 112),
                                       self.folder / "finer")
        output = self.folder / "out"
        result = run("homogenize", self.folder / "finer.prm", "--order", "1", "--refine", "2",
                     "--no-bars", "--output", output)
        self.assertEqual(result.returncode, 0, result.stderr)
        summary = json.loads((output / "homogenize.json").read_text())
        why_not = r"they would take about 1[0-9] s on this mesh, more than 10: studies make them"
        self.assertEqual(summary["second_order"]["laws"], [])
        self.assertRegex(summary["second_order"]["why_not"], "^" + why_not)
        self.assertRegex(result.stdout, "No quadratic modes and no cubic energy: " + why_not)
        for found, known in zip(summary["C"], answered_cells.laminate_stiffness()):
            for entry, answer in zip(found, known):
                self.assertAlmostEqual(entry, answer, delta=1e-6)

    def test_strain_holds_the_method_against_the_resolved_sheet(self):
        output = self.folder / "out"
        result = run("strain", LAYERED, "--quick", "--loads",
                     "periodic-12,strip-1,shear-frame", "--references", "linear,biot", "--strains",
                     "0.01,0.1", "--methods", "affine,localized,localized+edges,localized+p2,full",
                     "--no-budget", "--no-runtime", "--no-report", "--output", output)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        error = {(row["load"], row["reference"], float(row["strain"]), row["method"]):
                 float(row["error_mean_m"]) for row in rows_of(output / "strain.csv")}
        self.assertNotIn("periodic-12", {key[0] for key in error
                                         if key[3] in ("localized+edges", "localized+p2")})
        # In linear theory and without edges it is the paper's.
        self.assertEqual({key[1] for key in error if key[0] == "periodic-12" and key[3] == "full"},
                         {"biot"})
        # Of four cells a side the coarse mesh leaves most of the error.
        for load in ("strip-1", "shear-frame"):
            for reference in ("linear", "biot"):
                for strain in (0.01, 0.1):
                    self.assertLess(error[load, reference, strain, "localized+edges"],
                                    error[load, reference, strain, "localized"],
                                    (load, reference, strain))
                    self.assertLess(error[load, reference, strain, "full"],
                                    0.9 * error[load, reference, strain, "localized+edges"],
                                    (load, reference, strain))
        notes = [row["note"] for row in rows_of(output / "levels.csv")]
        self.assertTrue(any("axis 2, near end" in note and "clamped" in note for note in notes))
        left_out = {row["what"]
                    for row in json.loads((output / "study.json").read_text())["left_out"]}
        self.assertIn("p2 and edges of the method full under periodic loads", left_out)
        self.assertIn("cubic and modes of the method full against the reference linear", left_out)
        self.assertIn("localized+edges, localized+p2, full under periodic loads, against the "
                      "reference linear", left_out)

    def test_a_weave_has_all_but_second_order_and_pages_speak_of_it(self):
        output = self.folder / "out"
        result = run("strain", WEAVE, "--cells", "6", "--loads", "strip-1,shear-frame",
                     "--references", "yarn", "--strains", "0.001", "--methods",
                     "localized,localized+edges,localized+p2,full", "--no-budget", "--no-runtime",
                     "--no-report", "--output", output)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        error = {(row["load"], row["reference"], row["method"]): float(row["error_mean_m"])
                 for row in rows_of(output / "strain.csv")}
        for load in ("strip-1", "shear-frame"):
            for less in ("localized+edges", "localized+p2"):
                self.assertLess(error[load, "yarn", "full"], error[load, "yarn", less], load)
        self.assertEqual({row["method"] for row in rows_of(output / "validity.csv")
                          if row["reference"] == "yarn"}, {"localized", "full"})
        self.assertIn("cubic of the method full against the reference yarn",
                      {row["what"] for row in json.loads((output / "study.json").read_text())
                       ["left_out"]})

    def test_an_odd_number_of_cells_has_no_six_node_triangles_and_says_so(self):
        output = self.folder / "out"
        result = run("strain", LAYERED, "--quick", "--cells", "3", "--loads",
                     "strip-1", "--references", "biot", "--strains", "0.01", "--methods",
                     "localized,localized+p2", "--no-budget", "--no-runtime", "--no-report",
                     "--output", output)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        rows = {row["method"]: row["error_mean_m"] for row in rows_of(output / "strain.csv")}
        self.assertEqual(rows["localized+p2"], rows["localized"])
        notes = [row["note"] for row in rows_of(output / "levels.csv")]
        self.assertTrue(any("method localized+p2" in note and "odd number of cells" in note
                            for note in notes))


if __name__ == "__main__":
    unittest.main()
