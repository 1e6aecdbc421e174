# SPDX-License-Identifier: MIT
"""homespun bend: error of an up-sampled sheet that bends, against its curvature."""
import json
import pathlib
import shutil
import tempfile
import unittest

from broken_cells_test import Cell
from cli import InFolder, cut, rows_of, run

LOADS = ["roll", "cantilever-2", "twist"]
OPTIONS = ["--curvatures", "0.1,0.01", "--loads", ",".join(LOADS)]


class Bend(InFolder):
    @classmethod
    def setUpClass(cls):
        """A study of stripes on 4 x 4 squares, from which several tests read."""
        folder = tempfile.TemporaryDirectory(prefix="homespun-")
        cls.addClassCleanup(folder.cleanup)
        cls.cell = Cell(4).write(pathlib.Path(folder.name))
        cls.study = pathlib.Path(folder.name) / "out"
        result = run("bend", cls.cell, "--cells", "4", *OPTIONS, "--no-report", "--output",
                     cls.study)
        assert result.returncode in (0, 1, 4), result.stdout + result.stderr

    def bend(self, cell, *options, cells=4, statuses=(0, 1, 4)):
        """The rows of bend.csv and the verdicts."""
        output = self.folder / "out"
        result = run("bend", cell, "--cells", cells, *options, "--no-report", "--output", output)
        self.assertIn(result.returncode, statuses, result.stdout + result.stderr)
        self.assertNotIn("nan", result.stdout)
        claims = json.loads((output / "verdicts.json").read_text())["verdicts"]
        return rows_of(output / "bend.csv"), [one for one in claims
                                              if one["id"].startswith("bent-closer")]

    def test_rows_are_proportional_to_the_curvature_and_full_is_the_closest_with_bars(self):
        rows = rows_of(self.study / "bend.csv")
        claims = [one for one in json.loads((self.study / "verdicts.json").read_text())["verdicts"]
                  if one["id"].startswith("bent-closer")]
        self.assertEqual(list(dict.fromkeys(row["load"] for row in rows)), LOADS)
        errors = {(row["load"], row["method"], float(row["curvature_times_cell"])): row
                  for row in rows}
        self.assertEqual(len(errors), len(LOADS) * 2 * 5)
        for (load, method, bending), row in errors.items():
            other = errors[load, method, 0.1]
            for name in ("error_mean_m", "error_bar_m", "normal_error_mean_rad"):
                self.assertAlmostEqual(float(row[name]) / float(other[name]), bending / 0.1,
                                       delta=1e-9, msg=(load, method, name))
            closest = errors[load, "full", bending]
            for name, bar in (("error_mean_m", "error_bar_m"),
                              ("normal_error_mean_rad", "normal_error_bar_rad")):
                self.assertLess(float(closest[name]),
                                float(row[name]) + float(row[bar]) + float(closest[bar]),
                                (load, method, name))
        self.assertEqual(len(claims), len(LOADS) * 2 * 3)
        for one in claims:
            if one["id"] == "bent-closer.affine" and "position" in one["claim"]:
                self.assertEqual(one["verdict"], "PASS", one)

    def test_at_large_turns_cantilevers_bend_and_the_turned_clamp_is_closer(self):
        rows, claims = self.bend(self.cell, "--references", "biot", "--loads",
                                 "cantilever-2,twist", "--curvatures", "0.05,0.4")
        self.assertEqual({(row["load"], row["reference"]) for row in rows},
                         {("cantilever-2", "biot")})
        self.assertEqual(len(rows), 2 * 5)
        error = {(row["curvature_times_cell"], row["method"]): float(row["error_mean_m"])
                 for row in rows}
        for bending in ("0.05", "0.4"):
            self.assertLess(error[bending, "full"], 0.2 * error[bending, "affine"], error)
        # Less than proportional, as the sheet comes to hang.
        self.assertLess(error["0.4", "affine"], 0.8 * 8 * error["0.05", "affine"])
        self.assertEqual({"at large turns" in one["claim"] for one in claims}, {True})
        self.assertIn("PASS", {one["verdict"] for one in claims
                               if one["id"] == "bent-closer.affine"})
        left_out = json.loads((self.folder / "out/study.json").read_text())["left_out"]
        self.assertTrue([one for one in left_out if "twist" in one["what"]
                         and "stretch" in one["why"]], left_out)
        self.assertTrue(all(one["why"] for one in left_out), left_out)

    def test_of_one_material_nothing_is_claimed(self):
        cell = Cell(4)
        cell.keys["Young's modulus"] = "soft: 1e6, hard: 1e6"
        rows, claims = self.bend(cell.write(self.folder), "--loads", "pressure", cells=2,
                                 statuses=(4,))
        self.assertEqual({one["verdict"] for one in claims}, {"INCONCLUSIVE"})
        size = {row["method"]: float(row["error_mean_m"]) for row in rows}
        self.assertAlmostEqual(size["affine"] / size["localized"], 1., delta=1e-9)
        for row in rows_of(self.folder / "out/wrinkles.csv"):
            for what in ("wavelength_m", "compression_N_per_m"):
                self.assertAlmostEqual(float(row[what]) / float(row["homogenized_" + what]), 1.,
                                       delta=2e-3, msg=row)

    def test_wrinkles_of_d_h_err_by_more_than_order_one_in_cells_per_wave(self):
        off = {}
        for row in rows_of(self.study / "wrinkles.csv"):
            for what in ("wavelength_m", "compression_N_per_m"):
                off[row["axis"], what, row["cells_per_wave"]] = \
                    float(row[what]) / float(row["homogenized_" + what]) - 1.
        for axis in "12":
            for what in ("wavelength_m", "compression_N_per_m"):
                ratio = off[axis, what, "4"] / off[axis, what, "6"]
                self.assertGreater(ratio, 1.2 * 6 / 4, (axis, what, off))
        # The differential equation of stripes, here on 4 squares across.
        self.assertAlmostEqual(off["2", "compression_N_per_m", "4"], -0.043, delta=0.003)
        self.assertAlmostEqual(off["2", "wavelength_m", "4"], -0.027, delta=0.003)

    def test_of_a_cell_with_holes_all_terms_are_known(self):
        cell = Cell()
        cell.keep(lambda i, j: (i, j) != (3, 3))
        rows, _ = self.bend(cell.write(self.folder), "--loads", "roll", "--curvatures", "0.1",
                            cells=2)
        errors = {row["method"]: float(row["normal_error_mean_rad"]) for row in rows}
        self.assertLess(max(errors["full"], 0.8 * errors["affine+edges"]), 0.8 * errors["affine"])

    def test_terms_of_edges_that_reach_too_far_are_missing_and_that_is_said(self):
        cell = Cell()
        cell.keys["Young's modulus"] = "soft: 1e4, hard: 1e9"
        rows, claims = self.bend(cell.write(self.folder), "--loads", "roll", cells=2)
        self.assertEqual({row["method"] for row in rows}, {"affine", "localized", "flat"})
        self.assertIn("no terms of edges", " ".join(one["limit"] for one in claims))
        left_out = json.loads((self.folder / "out/study.json").read_text())["left_out"]
        self.assertTrue([one for one in left_out if "terms of edges" in one["what"]
                         and "along axis 1" in one["why"]], left_out)

    def test_a_run_is_taken_up_where_it_ended(self):
        first = rows_of(self.study / "bend.csv")
        shutil.copytree(self.study, self.folder / "out")
        path = self.folder / "out/bend.csv"
        lines = path.read_text().splitlines(keepends=True)
        path.write_text("".join(line for line in lines if ",twist," not in line))
        cut(self.folder / "out")
        again, _ = self.bend(self.cell, *OPTIONS)
        key = lambda row: [row[name] for name in row if not name.startswith("seconds")]
        self.assertEqual([key(row) for row in again], [key(row) for row in first])
        self.assertEqual([row["seconds_reference"] for row in again if row["load"] == "roll"],
                         [row["seconds_reference"] for row in first if row["load"] == "roll"])

    def test_bad_options_are_refused_each_with_its_name(self):
        result = run("bend", self.cell, "--loads", "roll,fold", "--curvatures", "0.1,-1",
                     "--references", "green", "--output", self.folder / "out")
        self.assertEqual(result.returncode, 2)
        for word in ("--loads", "fold", "cantilever-1", "--curvatures", "-1", "--references",
                     "biot"):
            self.assertIn(word, result.stderr)
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
