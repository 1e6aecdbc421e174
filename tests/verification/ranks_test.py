# SPDX-License-Identifier: MIT
"""The answer does not depend on the number of ranks."""
import csv
import json
import unittest

from cli import CELLS, InFolder, rows_of, run


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


class Scaling(InFolder):
    STUDY = ["scaling", CELLS / "layered.prm", "--refine", "1,2", "--ranks", "1,2", "--repeats", "1", "--quiet"]

    def test_rows_of_every_mesh_and_number_of_ranks_are_written_and_kept(self):
        result = run(*self.STUDY, "--output", self.folder)
        # Meshes as small as these are no claim on memory.
        self.assertIn(result.returncode, (0, 1), result.stderr)
        rows = rows_of(self.folder / "scaling.csv")
        self.assertEqual([(row["refine"], row["ranks"]) for row in rows], [("1", "1"), ("1", "2"), ("2", "1"), ("2", "2")])
        self.assertTrue(all(float(row["seconds_solve"]) > 0 and float(row["bytes_largest_rank"]) > 1e7 for row in rows))
        verdicts = json.loads((self.folder / "verdicts.json").read_text())["verdicts"]
        self.assertEqual(verdicts[0]["verdict"], "PASS", verdicts[0])
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["inputs.json", "scaling.csv", "scaling.json", "verdicts.json"])
        again = run(*self.STUDY, "--output", self.folder, "--resume")
        self.assertEqual(again.returncode, result.returncode, again.stderr)
        self.assertEqual(rows_of(self.folder / "scaling.csv"), rows)

    def test_faults_are_told_at_once_and_a_launcher_that_does_not_run_by_what_it_said(self):
        result = run(*self.STUDY, "--ranks", "0", "--launcher", "mpirun -n 2", "--output", self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("--ranks: found 0", result.stderr)
        self.assertIn("expected {ranks} where the number of ranks stands", result.stderr)
        result = run(*self.STUDY, "--launcher", "no-such-launcher {ranks}", "--output", self.folder / "out")
        self.assertEqual(result.returncode, 2)
        self.assertIn("mend --launcher", result.stderr)
        result = run(*self.STUDY, "--output", self.folder / "out", ranks=2)
        self.assertEqual(result.returncode, 2)
        self.assertIn("without mpirun", result.stderr)


if __name__ == "__main__":
    unittest.main()
