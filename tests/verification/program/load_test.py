# SPDX-License-Identifier: MIT
"""homespun periodic load: curves of an infinite cloth under given stresses and strains."""
import json
import unittest

import numpy

from cli import CELLS, LAYERED, THREE, InFolder, rows_of, run

CHEVRON = CELLS / "chevron.prm"
TEXTS = ("cell", "law", "method", "stable")


class Load(InFolder):
    def load(self, *options, cell=CHEVRON, **how):
        """The rows of load.csv; numbers as numbers."""
        output = self.folder / "run"
        result = run("periodic", "load", cell, *options, "--no-report", "--overwrite", "--output",
                     output, **how)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        return [{key: value if key in TEXTS or value == "" else float(value)
                 for key, value in row.items()} for row in rows_of(output / "load.csv")]

    def test_uniaxial_stress_at_a_millionth_of_strain_is_that_of_the_compliance(self):
        rows = self.load("--strain", "11=1e-6", "--steps", "1", "--references", "biot,green")
        C = numpy.array(json.loads(
            (self.folder / "run/chevron/homogenize.json").read_text())["C"])
        compliance = numpy.linalg.inv(C)
        self.assertEqual([(row["law"], row["method"]) for row in rows],
                         [("linear", "resolved"), ("biot", "resolved"), ("biot", "coarse"),
                          ("green", "resolved"), ("green", "coarse")])
        for row in rows:
            # Laws other than linear differ by a multiple of the strain.
            limit = 1e-9 if row["law"] == "linear" else 2e-5
            self.assertAlmostEqual(row["stress_11_N_per_m"] * compliance[0, 0] / 1e-6, 1.,
                                   delta=limit, msg=row)
            self.assertAlmostEqual(row["strain_22"] / (compliance[1, 0] / compliance[0, 0] * 1e-6),
                                   1., delta=limit, msg=row)
        # The mean of both directions has no such term.
        back = self.load("--strain", "11=-1e-6", "--steps", "1", "--references", "biot,green")
        for row, other in zip(rows, back):
            mean = 0.5 * (row["stress_11_N_per_m"] - other["stress_11_N_per_m"])
            self.assertAlmostEqual(mean * compliance[0, 0] / 1e-6, 1., delta=1e-6, msg=row)

    def test_a_cloth_that_is_turned_inside_out_is_no_level(self):
        output = self.folder / "run"
        result = run("periodic", "load", CHEVRON, "--stress", "11=1e5", "--references",
                     "linear,biot", "--no-report", "--output", output)
        self.assertIn(result.returncode, (1, 4), result.stderr)
        for row in rows_of(output / "load.csv"):
            self.assertGreater(1. + float(row["strain_22"]), 0., row)
        claims = json.loads((output / "verdicts.json").read_text())["verdicts"]
        self.assertTrue(any("turned inside out" in claim["limit"] and claim["verdict"] != "PASS"
                            for claim in claims), claims)

    def test_what_is_prescribed_is_there_and_what_is_free_has_a_bar(self):
        rows = self.load("--stress", "11=20,12=0", "--strain", "22=-2%", "--steps", "4")
        last = [row for row in rows if row["law"] == "biot" and row["method"] == "resolved"][-1]
        self.assertEqual((last["step"], last["factor"]), (4, 1))
        self.assertEqual((last["stress_11_N_per_m"], last["strain_22"], last["stress_12_N_per_m"]),
                         (20., -0.02, 0.))
        self.assertEqual((last["stress_11_bar_N_per_m"], last["strain_22_bar"]), (0., 0.))
        self.assertGreater(last["strain_11_bar"], 0.)
        self.assertGreater(last["stress_22_bar_N_per_m"], 0.)

    def test_the_number_of_ranks_changes_nothing(self):
        options = ("--strain", "11=5%,22=5%", "--steps", "2")
        one = self.load(*options, cell=THREE)
        self.assertEqual(one, self.load(*options, cell=THREE, ranks=2))

    def test_a_curve_that_was_measured_stands_beside_and_its_faults_are_named(self):
        lab = self.folder / "lab.csv"
        lab.write_text("strain_11,stress_11_N_per_m\n0.01,9\n0.02,19\n", encoding="utf-8")
        rows = self.load("--strain", "11=2%", "--steps", "2", "--measured", lab, cell=LAYERED)
        self.assertEqual([row["stress_11_N_per_m"] for row in rows if row["method"] == "measured"],
                         [9., 19.])
        lab.write_text("strain_11,stress_11_N_per_m\n0.01,9\n0.02,nineteen\n", encoding="utf-8")
        result = run("periodic", "load", CHEVRON, "--strain", "11=2%", "--measured", lab,
                     "--output", self.folder / "other")
        self.assertEqual(result.returncode, 2)
        self.assertIn("lab.csv, line 3, column stress_11_N_per_m: found `nineteen`", result.stderr)

    def test_bad_input_is_refused_with_every_fault_and_nothing_is_written(self):
        for options, found in (
                (["--stress", "11=50", "--strain", "11=2%"], "11 a second time"),
                (["--stress", "33=50"], "found `33=50`; expected COMPONENT=VALUE"),
                (["--strain", "11=ten"], "component 11: found `ten`"),
                (["--strain", "11=10"], "if percent was meant, write 11=10%"),
                (["--strain", "22=-100%"], "expected more than -1"),
                (["--strain", "11=2%", "--references", "hooke"], "--references: "),
                (["--strain", "11=2%", "--axis", "3"], "--axis"),
                (["--strain", "11=2%", "--steps", "0"], "--steps"),
                ([], "found nothing but zeros")):
            output = self.folder / "refused"
            result = run("periodic", "load", CHEVRON, *options, "--output", output)
            self.assertEqual(result.returncode, 2, options)
            self.assertIn(found, result.stderr)
            self.assertFalse(output.exists())
        both = run("periodic", "load", CHEVRON, "--stress", "33=1", "--strain", "11=ten")
        self.assertIn("33=1", both.stderr)
        self.assertIn("ten", both.stderr)

    def test_old_names_go_on_and_say_what_they_are_called_now(self):
        options = ["--strain", "11=1%", "--steps", 1, "--no-report", "--quiet", "--overwrite",
                   "--output", self.folder / "run"]
        new = run("periodic", "load", LAYERED, "--references", "biot", *options)
        rows = rows_of(self.folder / "run" / "load.csv")
        self.assertNotIn("old name", new.stderr)
        old = run("load", LAYERED, "--law=biot", *options)
        self.assertEqual(old.returncode, new.returncode)
        self.assertEqual(old.stderr.count("is `homespun periodic load` now"), 1, old.stderr)
        self.assertEqual(old.stderr.count("`--law` is `--references` now"), 1, old.stderr)
        self.assertEqual([row["strain_22"] for row in rows_of(self.folder / "run" / "load.csv")],
                         [row["strain_22"] for row in rows])
        other = run("stability", CHEVRON, "--load", "none")
        self.assertEqual(other.returncode, 2)
        self.assertIn("--loads: ", other.stderr)


if __name__ == "__main__":
    unittest.main()
