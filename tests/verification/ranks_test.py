# SPDX-License-Identifier: MIT
"""The answer does not depend on the number of ranks."""
import csv
import json
import unittest

from cli import CELLS, InFolder, run


class Ranks(InFolder):
    def stiffness(self, cell, order, ranks):
        output = self.folder / f"{cell}-{order}-{ranks}"
        result = run("homogenize", CELLS / f"{cell}.prm", "--order", order, "--refine", 1, "--quiet",
                     "--output", output, ranks=ranks)
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
                            self.assertAlmostEqual(together[i][j], alone[i][j], delta=1e-10 * largest)

    def test_errors_of_a_study_agree_on_one_and_two_ranks(self):
        rows = {}
        for ranks in (1, 2):
            output = self.folder / f"study-{ranks}"
            result = run("strain", CELLS / "three-stiffness.prm", "--cells", 2, "--strains", "0.01,0.1",
                         "--loads", "periodic-12,strip-2", "--no-report", "--quiet", "--output", output,
                         ranks=ranks)
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(output / "strain.csv", newline="", encoding="utf-8") as file:
                rows[ranks] = list(csv.DictReader(file))
        self.assertEqual(len(rows[1]), len(rows[2]))
        for one, two in zip(rows[1], rows[2]):
            self.assertEqual(one["method"], two["method"])
            error = float(one["error_mean_m"])
            self.assertAlmostEqual(error, float(two["error_mean_m"]), delta=2e-5 * error + 1e-15)

    def test_a_budget_that_is_not_found_is_a_note_and_no_rank_waits(self):
        # Stripes of contrast 1e9: their coarse equilibrium at 10 % is not found by the budget, which the first rank alone knows.
        cell = self.cell_with("soft: 1e6", "soft: 1e-2")
        output = self.folder / "study"
        result = run("strain", cell, "--cells", 2, "--strains", "0.01,0.1", "--loads", "strip-1", "--references", "biot",
                     "--methods", "localized", "--no-report", "--no-runtime", "--quiet", "--output", output, ranks=2)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        notes = (output / "notes.csv").read_text()
        self.assertIn("error budget: ", notes)
        with open(output / "strain.csv", newline="", encoding="utf-8") as file:
            self.assertEqual([row["strain"] for row in csv.DictReader(file)], ["0.01", "0.1"])


if __name__ == "__main__":
    unittest.main()
