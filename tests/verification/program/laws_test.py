# SPDX-License-Identifier: MIT
"""What the program says of the laws of a study: where one of them stops being elliptic."""
import json
import unittest

from cli import CELLS, LAYERED, WEAVE, InFolder, rows_of, run


def parts_and_notes(folder):
    """Rows of levels.csv that are of a part, and all remarks."""
    rows = rows_of(folder / "levels.csv")
    notes = [note for row in rows for note in row["note"].split(" | ") if note]
    return [row for row in rows if row["part"]], notes


class Ellipticity(InFolder):
    def test_check_warns_of_yarns_and_of_nothing_in_cells_without(self):
        woven = run("check", WEAVE)
        self.assertEqual(woven.returncode, 0, woven.stderr)
        # The yarn, E1/G12 = 583, and both crossings, 2333: 4 G/E / (1 - 4 G/E).
        self.assertRegex(woven.stdout, r"phase `warp` pulled along its axis 1 is not elliptic "
                                       r"under the law biot from a strain of 0.69 % on")
        self.assertRegex(woven.stdout, r"phase `warp-over` .* from a strain of 0.172 % on")
        self.assertNotIn("elliptic", run("check", CELLS / "auxetic.prm").stdout)

    def test_a_study_tells_from_which_strain_on_its_triangles_are_lost(self):
        result = run("strain", WEAVE, "--quick", "--loads", "uniaxial-1",
                     "--references", "linear,biot,green", "--strains", "0.001,0.003,0.004",
                     "--methods", "affine,localized", "--no-budget", "--no-runtime", "--no-report",
                     "--output", self.folder / "run")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        rows, notes = parts_and_notes(self.folder / "run")
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
        self.assertTrue([note for note in notes if "are not elliptic under biot" in note], notes)
        self.assertEqual(len([note for note in notes if "of the coarse cloth are not" in note]), 1)


SMALL = ["--quick", "--loads", "periodic-11", "--strains", "0.001,0.01", "--methods",
         "affine,localized", "--no-budget", "--no-runtime", "--no-report"]


class Default(InFolder):
    def test_each_cell_has_its_own_law_said_in_every_result(self):
        result = run("strain", WEAVE, LAYERED, *SMALL,
                     "--output", self.folder / "run")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        rows = rows_of(self.folder / "run" / "strain.csv")
        self.assertEqual({(row["cell"], row["reference"]) for row in rows},
                         {("plain-weave-straight", law) for law in ("linear", "yarn", "green")}
                         | {("layered", law) for law in ("linear", "biot", "green")})
        study = json.loads((self.folder / "run" / "study.json").read_text())
        said = [note for note in study["notes"] if "as none was asked for" in note]
        self.assertEqual(len(said), 2, study["notes"])
        for text, note in zip(("plain-weave-straight: the references are linear, yarn and green,",
                               "layered: the references are linear, biot and green,"), said):
            self.assertTrue(note.startswith(text), note)
            self.assertIn(note, result.stdout + result.stderr)
        self.assertIn("up to 0.172 % (E/G 2333.33)", said[0])
        inputs = (self.folder / "run" / "run.json").read_text()
        self.assertIn("references of plain-weave-straight", inputs)

    def test_load_and_stability_have_it_too(self):
        for command, table in (("periodic load --strain 11=0.1% --steps 1", "load.csv"),
                               ("periodic stability --loads periodic-11 --strains 0.1% --refine 0",
                                "stability.csv")):
            periodic, name, *options = command.split()
            result = run(periodic, name, WEAVE, LAYERED, *options,
                         "--no-report", "--output", self.folder / name)
            self.assertIn(result.returncode, (0, 1, 4), result.stderr)
            laws = {(row["cell"], row["law"]) for row in rows_of(self.folder / name / table)}
            self.assertEqual(laws - {("plain-weave-straight", "linear"), ("layered", "linear")},
                             {("plain-weave-straight", "yarn"), ("layered", "biot")})
            study = json.loads((self.folder / name / "study.json").read_text())
            said = [note for note in study["notes"] if "the law is" in note]
            self.assertEqual(len(said), 2, study["notes"])

    def test_a_law_that_is_asked_for_wins(self):
        result = run("strain", WEAVE, *SMALL, "--references", "biot",
                     "--output", self.folder / "run")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        self.assertEqual({row["reference"] for row in rows_of(self.folder / "run" / "strain.csv")},
                         {"biot"})
        study = json.loads((self.folder / "run" / "study.json").read_text())
        self.assertFalse([note for note in study["notes"] if "as none was asked for" in note])


class Supercell(InFolder):
    def test_cells_that_repeat_together_have_the_errors_of_one_where_it_is_stable(self):
        study = ["strain", LAYERED, "--quick", "--strains", "0.001,0.01", "--methods",
                 "affine,localized", "--loads", "periodic-12,uniaxial-2",
                 "--references", "biot", "--no-runtime", "--no-report", "--output"]
        for name, more in (("one", []), ("two", ["--supercell", "1x2"])):
            result = run(*study, self.folder / name, *more)
            self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        one, two = (rows_of(self.folder / name / "strain.csv") for name in ("one", "two"))
        self.assertEqual(len(one), len(two))
        for a, b in zip(one, two):
            self.assertEqual((a["load"], a["strain"], a["method"], 2 * int(a["fine_triangles"])),
                             (b["load"], b["strain"], b["method"], int(b["fine_triangles"])))
            # The mean counts vertices on an outline more than once; both solvers leave 1e-9.
            self.assertLess(abs(float(a["error_max_m"]) - float(b["error_max_m"])),
                            1e-8 * float(a["strain"]) * 0.02)
        # The second code and the budget are those of one cell.
        self.assertEqual(rows_of(self.folder / "two" / "budget.csv"), [])
        self.assertTrue(rows_of(self.folder / "one" / "budget.csv"))
        notes = json.loads((self.folder / "two" / "study.json").read_text())["notes"]
        self.assertEqual(sum("1 x 2 cells repeat" in note for note in notes), 1)

    def test_what_is_no_supercell_is_refused(self):
        for text, load, found in (("0x2", "periodic-12", "expected N1xN2"),
                                  ("2x", "periodic-12", "expected N1xN2"),
                                  ("1x1", "periodic-12", "expected N1xN2"),
                                  ("2x2", "strip-1", "beside no periodic load")):
            result = run("strain", LAYERED, "--supercell", text, "--loads", load,
                         "--output", self.folder / "run")
            self.assertEqual(result.returncode, 2)
            self.assertIn("--supercell", result.stderr)
            self.assertIn(found, result.stderr)
            self.assertFalse((self.folder / "run").exists())


class Stop(InFolder):
    def test_a_path_that_the_law_ends_names_the_triangle(self):
        result = run("strain", LAYERED, "--cells", "4", "--loads", "shear-frame",
                     "--references", "green,biot", "--strains", "0.05,0.2", "--methods",
                     "affine,localized", "--no-budget", "--no-runtime", "--no-report",
                     "--output", self.folder / "run")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        notes = [row for row in rows_of(self.folder / "run" / "levels.csv")
                 if "no equilibrium" in row["note"]]
        self.assertEqual([(row["reference"], row["strain"]) for row in notes], [("green", "0.2")])
        # In a corner of the frame, where the soft stripe is pressed.
        self.assertRegex(notes[0]["note"],
                         r"the law ends there, not the solver: .* of phase soft, at "
                         r"\((0\.0|0\.9)\d*, (0\.0|0\.9)\d*\) of the sides of the sheet, is "
                         r".*pressed .* is not elliptic under green \(least wave -")


class Yarns(InFolder):
    def test_a_cell_without_yarns_is_refused_before_anything_runs(self):
        output = self.folder / "run"
        result = run("strain", LAYERED, "--quick", "--references", "biot,yarn",
                     "--output", output)
        self.assertEqual(result.returncode, 2)
        for text in ("layered.prm", "--references yarn", "alike in all directions", "Orthotropic"):
            self.assertIn(text, result.stderr)
        self.assertFalse(output.exists())

    def test_woven_cloth_is_pulled_beyond_the_loss_of_biot_and_stays_elliptic(self):
        result = run("strain", WEAVE, "--quick", "--loads", "uniaxial-1",
                     "--references", "yarn", "--strains", "0.001,0.01,0.05",
                     "--methods", "affine,localized", "--no-budget", "--no-runtime", "--no-report",
                     "--output", self.folder / "run")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        rows = rows_of(self.folder / "run" / "strain.csv")
        self.assertEqual({row["strain"] for row in rows if row["method"] == "localized"},
                         {"0.001", "0.01", "0.05"})
        found, notes = parts_and_notes(self.folder / "run")
        self.assertEqual({row["reference"] for row in found}, {"yarn"})
        # The coarse cloth has the law too, and says along which axes.
        coarse = [row for row in found if row["part"] == "coarse cloth"]
        self.assertEqual([row["not_elliptic"] for row in coarse], ["0", "0", "0"])
        self.assertEqual(sum("the coarse cloth has the law yarn, too" in note for note in notes), 1)


if __name__ == "__main__":
    unittest.main()
