# SPDX-License-Identifier: MIT
"""homespun periodic stability: where the cells start to buckle in their plane."""
import json
import unittest

from cli import CELLS, LAYERED, InFolder, cut, rows_of, run

HONEYCOMB = CELLS / "honeycomb.prm"
TEXTS = ("kind", "cell", "law", "load", "way", "mesh", "outcome", "wave", "waves", "scale",
         "long_waves")


class Stability(InFolder):
    def stability(self, *options, cell=LAYERED, **how):
        """Levels and losses of stability.csv; numbers as numbers."""
        self.output = self.folder / "run"
        result = run("periodic", "stability", cell, *options, "--no-report", "--overwrite",
                     "--output", self.output, **how)
        self.assertIn(result.returncode, (0, 4), result.stderr + result.stdout)
        return [[{key: value if key in TEXTS or value == "" else float(value)
                  for key, value in row.items()} for row in self.rows(kind)]
                for kind in ("level", "loss")]

    def rows(self, kind):
        return [row for row in rows_of(self.output / "stability.csv") if row["kind"] == kind]

    def test_layered_localizes_where_two_other_programs_found_it(self):
        levels, losses = self.stability("--loads", "periodic-11", "--strains=-1%,-5%,-10%,-20%")
        given = {row["strain"]: row for row in levels if row["mesh"] == "given"}
        for strain, beta in ((-0.01, 0.9297), (-0.05, 0.6429), (-0.1, 0.2719), (-0.2, -0.5157)):
            self.assertAlmostEqual(given[strain]["beta"], beta, delta=1e-3)
            self.assertEqual((given[strain]["waves"], given[strain]["angle_deg"]), ("long", 0.))
        self.assertEqual([given[s]["outcome"] for s in (-0.1, -0.2)],
                         ["stable-up-to-mesh", "unstable-proved"])
        for row in levels:  # the mesh of a laminate changes nothing
            self.assertAlmostEqual(row["beta"], given[row["strain"]]["beta"], delta=1e-6)
        for row in losses:
            self.assertEqual((row["outcome"], row["scale"], row["way"]),
                             ("lost", "macro", "pressed"))
            self.assertLessEqual(abs(row["held_to"] - row["lost_at"]), 1e-4)
            self.assertLess(row["lost_at"], row["strain"])
            self.assertLess(row["strain"], row["held_to"])
        notes = json.loads((self.output / "study.json").read_text())["notes"]
        self.assertIn("layered, biot, periodic-11, pressed: lost first at -13.", notes[0])
        self.assertIn("the macroscopic law localizes", notes[0])
        verdicts = json.loads((self.output / "verdicts.json").read_text())["verdicts"]
        self.assertEqual({v["verdict"] for v in verdicts}, {"PASS"})
        self.assertTrue(any("beta at rest is 1" in v["claim"] for v in verdicts))
        self.assertEqual(len(self.rows("wave")), 49)
        self.assertEqual(len(self.rows("mode")), 45)

    def test_honeycomb_forms_a_pattern_of_two_by_two_cells(self):
        levels, losses = self.stability("--loads", "uniaxial-1", "--strains=-8%,-12%", "--refine",
                                        "0", cell=HONEYCOMB)
        for row, beta in zip(levels, (0.488, 0.285)):
            self.assertAlmostEqual(row["beta"], beta, delta=1e-3)
            self.assertEqual((row["scale"], row["k1"], row["k2"]), ("micro", 0.5, 0.5))
            self.assertEqual((row["cells_1"], row["cells_2"]), (2, 2))
        self.assertEqual([(row["outcome"], row["held_to"], row["mesh"]) for row in losses],
                         [("held", -0.12, "given")])

    def test_the_pattern_beyond_the_first_loss_is_followed_to_less_energy(self):
        levels, losses = self.stability("--loads", "periodic-22", "--strains=-10%,-16%", "--refine",
                                        "0", cell=HONEYCOMB)
        self.assertEqual([row["outcome"] for row in levels],
                         ["stable-up-to-mesh", "unstable-proved"])
        self.assertAlmostEqual(losses[0]["strain"], -0.135, delta=0.002)
        self.assertEqual((losses[0]["k1"], losses[0]["k2"]), (0., 0.5))
        pattern, = self.rows("pattern")
        self.assertEqual([pattern[key] for key in ("cells_1", "cells_2", "outcome", "wave")],
                         ["1", "2", "found", "k = (0, 1/2)"])
        self.assertGreater(float(pattern["less_energy"]), 1e-3)
        self.assertLess(float(pattern["energy_N_per_m"]), float(pattern["energy_periodic_N_per_m"]))
        self.stability("--loads", "periodic-22", "--strains=-16%", "--refine", "0", "--supercell",
                       "2x2", cell=HONEYCOMB)
        pattern, = self.rows("pattern")
        self.assertEqual([pattern[key] for key in ("cells_1", "cells_2", "outcome")],
                         ["2", "2", "found"])

    def test_strains_of_both_signs_are_two_ways_and_ranks_change_nothing(self):
        options = ("--loads", "periodic-11,uniaxial-2", "--strains=2%,-2%", "--refine", "0")
        one = self.stability(*options)
        self.assertEqual([(row["load"], row["way"]) for row in one[1]],
                         [("periodic-11", "pressed"), ("periodic-11", "pulled"),
                          ("uniaxial-2", "pressed"), ("uniaxial-2", "pulled")])
        self.assertEqual(one, self.stability(*options, ranks=2))

    def test_a_run_that_was_killed_goes_on(self):
        options = ("--loads", "periodic-11,periodic-22", "--strains=-5%", "--refine", "0")
        levels, losses = self.stability(*options)
        # Killed in the second path: its level is there, its loss, the last row, is not.
        path = self.output / "stability.csv"
        text = path.read_text(encoding="utf-8")
        path.write_text(text[:text.rindex("loss,layered") + 30], encoding="utf-8")
        cut(self.output)
        result = run("periodic", "stability", LAYERED, *options, "--no-report", "--resume",
                     "--output", self.output)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(path.read_text(encoding="utf-8"), text)
        self.assertEqual(len(self.rows("level")), len(levels))
        self.assertTrue(json.loads((self.output / "study.json").read_text())["resumed"])
        other = run("periodic", "stability", LAYERED, "--loads", "periodic-11", "--strains=-5%",
                    "--resume", "--output", self.output)
        self.assertEqual(other.returncode, 2)
        self.assertIn("holds another run", other.stderr)

    def test_bad_input_is_refused_with_every_fault_and_nothing_is_written(self):
        for options, found in (
                (["--loads", "strip-1"], "--loads: found `strip-1`; expected periodic-11"),
                (["--references", "hooke"], "--references: "),
                (["--strains", "ten"], "--strains: found `ten`"),
                (["--strains", "0"], "--strains: found 0; expected strains that are not zero"),
                (["--strains=-100%"], "expected more than -100%"),
                (["--strains=-5"], "if percent was meant, write -5%"),
                (["--supercell", "0x2"], "--supercell: found `0x2`; expected N1xN2"),
                (["--supercell", "1x1"], "two cells at least"),
                (["--supercell", "2x2x2"], "--supercell: found `2x2x2`"),
                (["--supercell", "two"], "--supercell: found `two`"),
                (["--refine", "2"], "--refine")):
            output = self.folder / "refused"
            result = run("periodic", "stability", LAYERED, *options, "--output", output)
            self.assertEqual(result.returncode, 2, options)
            self.assertIn(found, result.stderr)
            self.assertFalse(output.exists())
        both = run("periodic", "stability", LAYERED, "--loads", "strip-1", "--strains", "ten")
        self.assertIn("strip-1", both.stderr)
        self.assertIn("ten", both.stderr)


if __name__ == "__main__":
    unittest.main()
