# SPDX-License-Identifier: MIT
"""Cloth of yarns in motion, and a law that is no more."""
import json
import shutil
import unittest

from cli import CELLS, LAYERED, WEAVE, InFolder, rows_of, run
from scene_case import SCENES

HANGING = ["drape", SCENES / "hang.prm", "--unit-cells", WEAVE, "--cells", 2,
           "--duration", 0.1, "--frames", "vtu", "--methods", "affine,localized", "--no-report"]


class Moving(InFolder):
    def run_scene(self, *options, cell=None):
        study = [option if option != WEAVE or cell is None else CELLS / cell
                 for option in HANGING]
        result = run(*study, "--quick", *options, "--output", self.folder / "run")
        return result

    def cloths(self):
        return {(row["cloth"], row["variant"])
                for row in rows_of(self.folder / "run" / "motion.csv")}

    def notes(self):
        return json.loads((self.folder / "run" / "drape.json").read_text())["notes"]

    def test_a_weave_moves_as_one_by_default_beside_references_of_its_law(self):
        result = self.run_scene("--references", "shell,yarn")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        self.assertEqual(self.cloths(),
                         {("coarse", "yarn"), ("reference", "shell"), ("reference", "yarn")})
        self.assertTrue([note for note in self.notes() if "the law is yarn" in note
                         and "the moving cloth has the law yarn" in note], self.notes())
        self.assertFalse([note for note in self.notes() if "corotational cloth" in note])
        # Both references, in two codes, are one cloth, up to what their integrators differ by.
        rows = [row for row in rows_of(self.folder / "run" / "motion.csv") if not row["place"]]
        height = {name: [float(row["centre_z_m"]) for row in rows
                         if (row["cloth"], row["variant"]) == ("reference", name)]
                  for name in ("shell", "yarn")}
        self.assertEqual(len(height["shell"]), len(height["yarn"]))
        fall = max(abs(one - height["yarn"][0]) for one in height["yarn"])
        for shell, yarn in zip(height["shell"], height["yarn"]):
            self.assertAlmostEqual(shell, yarn, delta=0.1 * fall)

    def test_a_cell_whose_law_is_biot_moves_by_it(self):
        self.assertIn(self.run_scene(cell="layered.prm").returncode, (0, 1, 4))
        self.assertEqual(self.cloths(), {("coarse", "biot")})

    def test_the_law_that_is_asked_for_wins_and_what_it_loses_is_told(self):
        result = self.run_scene("--variants", "biot,yarn")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        self.assertEqual(self.cloths(), {("coarse", "biot"), ("coarse", "yarn")})
        self.assertTrue([note for note in self.notes() if "corotational cloth (law biot)" in note])
        self.assertNotIn("is called", result.stderr)

    def test_names_of_before_are_told_and_mean_the_same_run(self):
        self.assertIn(self.run_scene("--variants", "yarn,biot").returncode, (0, 1, 4))
        again = self.run_scene("--variants", "woven,corotational,biot", "--resume")
        self.assertIn(again.returncode, (0, 1, 4), again.stderr)
        for old, name in (("woven", "yarn"), ("corotational", "biot")):
            self.assertIn(f"--variants: `{old}` is called `{name}` since 0.2.0", again.stderr)

    def test_what_has_no_yarns_or_no_energy_is_refused(self):
        alike = self.folder / "alike.prm"  # C^H of one material has no axes
        alike.write_text((LAYERED).read_text().replace("1e7", "1e6"))
        shutil.copy(CELLS / "layered.msh", self.folder)
        for options, cell, texts in (
                (("--references", "yarn"), "layered.prm", ("layered.prm", "--references yarn")),
                (("--variants", "yarn"), alike,
                 ("--variants yarn: C^H of", "or the law biot")),
                (("--variants", "nodal-warping,yarn"), None, ("found `nodal-warping` first",)),
                (("--variants", "green"), None, ("biot, yarn or nodal-warping",)),
                (("--variants", "biot,triangle-warping"), None,
                 ("`triangle-warping` was removed in 0.2.0", "use nodal-warping"))):
            result = self.run_scene(*options, cell=cell)
            self.assertEqual(result.returncode, 2, result.stdout)
            for text in texts:
                self.assertIn(text, result.stderr)


class RemovedLaw(InFolder):
    def test_it_is_refused_with_what_to_take_in_its_place(self):
        hang, weave = SCENES / "hang.prm", WEAVE
        for study in (("strain", weave, "--references", "yarn-tension"),
                      ("periodic", "load", weave, "--strain", "11=1%", "--references",
                       "yarn-tension"),
                      ("periodic", "stability", weave, "--references", "yarn-tension"),
                      ("drape", hang, "--references", "yarn-tension"),
                      ("drape", hang, "--variants", "woven-tension")):
            result = run(*study, "--output", self.folder / "run")
            self.assertEqual(result.returncode, 2, study)
            self.assertIn("was removed in 0.2.0; use `yarn`: compression is marked", result.stderr)
            self.assertFalse((self.folder / "run").exists())


if __name__ == "__main__":
    unittest.main()
