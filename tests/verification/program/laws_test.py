# SPDX-License-Identifier: MIT
"""What the program says of the laws of a study: where one of them stops being elliptic."""
import unittest

from cli import CELLS, InFolder, rows_of, run


class Ellipticity(InFolder):
    def test_check_warns_of_yarns_and_of_nothing_in_cells_without(self):
        woven = run("check", CELLS / "plain-weave.prm")
        self.assertEqual(woven.returncode, 0, woven.stderr)
        # The yarn, E1/G12 = 583, and both crossings, 2333: 4 G/E / (1 - 4 G/E).
        self.assertRegex(woven.stdout, r"phase `warp` pulled along its axis 1 is not elliptic "
                                       r"under the law biot from a strain of 0.69 % on")
        self.assertRegex(woven.stdout, r"phase `warp-over` .* from a strain of 0.172 % on")
        self.assertNotIn("elliptic", run("check", CELLS / "auxetic.prm").stdout)

    def test_a_study_tells_from_which_strain_on_its_triangles_are_lost(self):
        result = run("strain", CELLS / "plain-weave.prm", "--quick", "--loads", "uniaxial-1",
                     "--references", "linear,biot,green", "--strains", "0.001,0.003,0.004",
                     "--methods", "affine,localized", "--no-budget", "--no-runtime", "--no-report",
                     "--output", self.folder / "run")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        rows = rows_of(self.folder / "run" / "ellipticity.csv")
        self.assertEqual({row["reference"] for row in rows}, {"biot", "green"})
        self.assertEqual({row["part"] for row in rows},
                         {"warp", "weft", "warp-over", "weft-over", "coarse cloth"})
        lost = {(row["reference"], row["strain"], row["part"]) for row in rows
                if int(row["not_elliptic"]) > 0}
        self.assertIn(("biot", "0.004", "coarse cloth"), lost)
        self.assertNotIn(("biot", "0.003", "coarse cloth"), lost)
        self.assertFalse({key for key in lost if key[:2] == ("biot", "0.001")})
        self.assertFalse({key for key in lost if key[0] == "green" and key[2] != "coarse cloth"})
        for row in rows_of(self.folder / "run" / "validity.csv"):
            if row["reference"] == "biot":
                self.assertGreater(float(row["elliptic_up_to"]), 0.0025)
                self.assertLess(float(row["elliptic_up_to"]), 0.003)
        notes = [row["note"] for row in rows_of(self.folder / "run" / "notes.csv")]
        self.assertTrue([note for note in notes if "are not elliptic under biot" in note], notes)
        self.assertEqual(len([note for note in notes if "of the coarse cloth are not" in note]), 1)


class Yarns(InFolder):
    def test_a_cell_without_yarns_is_refused_before_anything_runs(self):
        output = self.folder / "run"
        result = run("strain", CELLS / "layered.prm", "--quick", "--references", "biot,yarn",
                     "--output", output)
        self.assertEqual(result.returncode, 2)
        for text in ("layered.prm", "--references yarn", "alike in all directions", "Orthotropic"):
            self.assertIn(text, result.stderr)
        self.assertFalse(output.exists())

    def test_woven_cloth_is_pulled_beyond_the_loss_of_biot_and_stays_elliptic(self):
        result = run("strain", CELLS / "plain-weave.prm", "--quick", "--loads", "uniaxial-1",
                     "--references", "yarn", "--strains", "0.001,0.01,0.05",
                     "--methods", "affine,localized", "--no-budget", "--no-runtime", "--no-report",
                     "--output", self.folder / "run")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        rows = rows_of(self.folder / "run" / "strain.csv")
        self.assertEqual({row["strain"] for row in rows if row["method"] == "localized"},
                         {"0.001", "0.01", "0.05"})
        found = rows_of(self.folder / "run" / "ellipticity.csv")
        self.assertEqual({row["reference"] for row in found}, {"yarn"})
        # The coarse cloth has the law too, and says along which axes.
        coarse = [row for row in found if row["part"] == "coarse cloth"]
        self.assertEqual([row["not_elliptic"] for row in coarse], ["0", "0", "0"])
        notes = [row["note"] for row in rows_of(self.folder / "run" / "notes.csv")]
        self.assertEqual(sum("the coarse cloth has the law yarn, too" in note for note in notes), 1)


if __name__ == "__main__":
    unittest.main()
