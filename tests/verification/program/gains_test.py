# SPDX-License-Identifier: MIT
"""What a study says of up-sampling where there is nothing to gain by it, and of levels that it does
not reach.
"""
import json
import re
import shutil
import unittest

from broken_cells_test import Cell
from cli import COARSE, LAYERED, InFolder, page_of, rows_of, run

SMALL = ["--cells", "4", "--no-budget", "--no-runtime"]


class Gains(InFolder):
    def study(self, cell, *options, load="strip-1"):
        """(exit status, {claim of kind method, and of levels: its verdict})"""
        output = self.folder / "run"
        result = run("strain", cell, *SMALL, "--loads", load, *options, "--no-report", "--output",
                     output)
        verdicts = json.loads((output / "verdicts.json").read_text())["verdicts"]
        return result.returncode, {
            verdict["claim"].split(": ", 1)[1]: verdict for verdict in verdicts
            if verdict["kind"] == "method" or "levels without" in verdict["claim"]}

    def page(self):
        text = page_of(self.folder / "run")
        return re.sub("<[^>]*>", " ", text[text.index("<h1>"):text.index("<nav")])

    def test_no_bar_is_known_where_the_reference_left_the_state_that_bars_are_of(self):
        cell = Cell()  # a checkerboard whose soft squares buckle under shear
        cell.points = [[i / 4, j / 4, 0.] for j in range(5) for i in range(13)]
        squares = [(i, j) for j in range(4) for i in range(12)]
        corners = [(13 * j + i, 13 * j + i + 1, 13 * j + i + 14, 13 * j + i + 13)
                   for i, j in squares]
        cell.triangles = [[a, *rest] for a, b, c, d in corners for rest in ((b, c), (c, d))]
        cell.groups = [1 + (i // 2 + j // 2) % 2 for i, j in squares for _ in range(2)]
        cell.keys |= {"Lattice vectors": "3 0; 0 1", "Young's modulus": "soft: 1e6, hard: 1e9"}
        result = run("strain", cell.write(self.folder), "--cells", 4, "--references", "biot",
                     "--loads", "periodic-12", "--methods", "affine,localized", "--strains",
                     "0.001,0.05,0.1", "--no-runtime", "--no-report", "--output",
                     self.folder / "run")
        self.assertEqual(result.returncode, 4, result.stderr)
        left = {row["strain"]: row["reference_stability"]
                for row in rows_of(self.folder / "run" / "levels.csv") if not row["part"]}
        self.assertEqual(left["0.05"], "left")
        for row in rows_of(self.folder / "run" / "strain.csv"):
            for bar in ("error_bar_m", "reference_uncertainty_m"):
                self.assertEqual(row[bar] == "", row["strain"] != "0.001", row)
        again = run("strain", self.folder / "cell.prm", "--cells", 4, "--references", "biot",
                    "--loads", "periodic-12", "--methods", "affine,localized", "--strains",
                    "0.001,0.05,0.1", "--no-runtime", "--no-report", "--output",
                    self.folder / "run", "--resume")
        self.assertEqual(again.returncode, 4, again.stderr)

    def one_material(self):
        text = LAYERED.read_text().replace("hard: 1e7", "hard: 1e6")
        (self.folder / "one.prm").write_text(text)
        shutil.copy(COARSE / "layered.msh", self.folder)

    def test_of_one_material_no_sheet_is_said_to_be_closer(self):
        self.one_material()
        result = run("converge", self.folder / "one.prm", "--quick", "--studies", "scale",
                     "--no-report", "--output", self.folder / "run")
        verdicts = json.loads((self.folder / "run" / "verdicts.json").read_text())["verdicts"]
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertEqual(len(verdicts), 9)
        for verdict in verdicts:
            self.assertEqual(verdict["verdict"], "INCONCLUSIVE", verdict)

    def test_of_one_material_nothing_is_claimed_of_up_sampling(self):
        self.one_material()
        status, claims = self.study(self.folder / "one.prm", "--references", "biot", "--strains",
                                    "0.01,0.1")
        self.assertEqual(status, 4)
        for strain in ("0.01", "0.1"):
            for pair in ("full is closer to biot than its base", "localized is closer to biot than "
                                                                 "affine"):
                claim = claims[f"{pair} at strain {strain} (ratio of errors)"]
                self.assertEqual(claim["verdict"], "INCONCLUSIVE", claim)
                self.assertAlmostEqual(claim["value"], 1., delta=1e-6)
        for gain in rows_of(self.folder / "run" / "gains.csv"):
            if gain["method"] == "full":
                self.assertAlmostEqual(float(gain["gain_of_upsampling"]), 1., delta=1e-6)
                self.assertGreater(float(gain["gain_of_coarse_cloth"]), 1.5)
        page = self.page()
        self.assertIn("makes no difference that can be told in strip-1", page)
        self.assertNotRegex(page, "[Uu]p-sampling (takes|adds)")
        self.assertIn("strip-1   ≈ 0", re.sub(" +", lambda gap: " " * min(3, len(gap[0])), page))

    def test_a_run_at_ten_per_cent_alone_has_method_claims(self):
        _, claims = self.study(LAYERED, "--references", "biot", "--strains", "0.1")
        for pair in ("full is closer to biot than its base",
                     "full is closer to biot than localized",
                     "localized is closer to biot than affine"):
            self.assertEqual(claims[f"{pair} at strain 0.1 (ratio of errors)"]["kind"], "method")

    def test_a_run_that_reaches_nothing_says_so(self):
        status, claims = self.study(LAYERED, "--references", "green",
                                    "--strains", "60%", load="shear-frame")
        self.assertEqual(status, 4)
        for claim in claims.values():
            self.assertEqual((claim["verdict"], claim["value"]), ("INCONCLUSIVE", 1.0), claim)
        self.assertIn("no level was reached", self.page())


if __name__ == "__main__":
    unittest.main()
