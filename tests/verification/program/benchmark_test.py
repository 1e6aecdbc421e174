# SPDX-License-Identifier: MIT
"""homespun benchmark: the form of its table, its units, and what its figures must agree in. Times
are told and not judged.
"""
import json
import math

from cli import InFolder, rows_of, run

LIMITS = {"step: assembly": "dgemm", "step: factor": "dgemm",
          "step: substitution": "copy of the factor",
          "up-sampling": "copy of the fine positions"}
UNITS = {"copy": "B moved", "triad": "B moved", "dgemm": "flop", "homogenize": "DoF",
         "homogenize: assembly": "DoF", "homogenize: factor or multigrid": "DoF",
         "homogenize: solve": "DoF", "step": "triangle", "step: assembly": "flop",
         "step: factor": "flop", "step: substitution": "B moved", "copy of the factor": "B moved",
         "copy of the fine positions": "B moved", "up-sampling": "B moved"}


class Benchmark(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.results = {}

    def measured(self, ranks):
        if ranks not in self.results:
            result = run("benchmark", "--refine", 0, "--runs", 2, "--output", "out", ranks=ranks,
                         cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.results[ranks] = (
                result.stdout, {row["part"]: row for row in rows_of(self.folder / "out"
                                                                    / "benchmark.csv")},
                json.loads((self.folder / "out" / "benchmark.json").read_text(encoding="utf-8")))
        return self.results[ranks]

    def test_every_part_has_its_unit_and_the_share_of_its_limit(self):
        told, rows, _ = self.measured(1)
        self.assertEqual({part: row["unit"] for part, row in rows.items()}, UNITS)
        for part, row in rows.items():
            with self.subTest(part=part):
                self.assertIn(part, told)
                self.assertEqual(row["limit"], LIMITS.get(part, ""))
                self.assertEqual(row["threads_per_rank"], "1")
                self.assertLessEqual(float(row["seconds"]), float(row["seconds_95"]))
                if row["limit"]:
                    def rate(of):
                        return float(of["work"]) / float(of["seconds"])
                    self.assertAlmostEqual(float(row["of_limit"]),
                                           rate(row) / rate(rows[row["limit"]]), places=9)
                else:
                    self.assertEqual(row["of_limit"], "")

    def test_work_is_that_of_the_papers_sheet(self):
        _, rows, info = self.measured(1)
        self.assertEqual((info["coarse_triangles"], info["fine_triangles"], info["steps"]),
                         (800, 288000, 100))
        self.assertEqual(float(rows["step"]["work"]), 800.)
        self.assertEqual(rows["step"]["runs"], "200")  # all steps of both runs
        self.assertEqual(float(rows["step: assembly"]["work"]), 800. * 2. * 498.)
        # Read and written, three numbers of four bytes: vertices of the torus, closed to a sheet.
        self.assertEqual(float(rows["up-sampling"]["work"]), 2. * 12. * 144761.)
        self.assertEqual(float(rows["copy of the fine positions"]["work"]), 2. * 12. * 144761.)
        self.assertEqual(rows["copy of the factor"]["work"], rows["step: substitution"]["work"])
        self.assertEqual(float(rows["triad"]["work"]), 24. * 2 ** 23)
        self.assertEqual(float(rows["dgemm"]["work"]), 2. * 256. ** 3)
        self.assertGreaterEqual(info["factorizations_per_step"], 1.)

    def test_it_says_on_what_it_ran(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                _, rows, info = self.measured(ranks)
                self.assertEqual(rows["homogenize"]["ranks"], str(ranks))
                self.assertEqual(rows["step"]["ranks"], "1")
                self.assertEqual(info["provenance"]["ranks"], ranks)
                self.assertTrue(info["provenance"]["blas"])
                self.assertGreaterEqual(info["processors"], 1)
                self.assertTrue(math.isfinite(info["load_of_machine"]))

    def test_a_number_out_of_range_is_refused(self):
        self.assertEqual(run("benchmark", "--runs", 0).returncode, 2)
        self.assertEqual(run("benchmark", "--refine", 9).returncode, 2)
