# SPDX-License-Identifier: MIT
"""homespun stress: its cases, where the axis of turns ends, and its table."""
import json
import unittest

from cli import CELLS, InFolder, rows_of, run, status_of

# Where the axis of turns per step ends: the largest turn that is right over the one that stretches
# the sheet by half, up to which theory speaks; 16 is the last that is tried. An end that moves
# breaks the test, in either direction. Beyond an end a sheet is thrown apart by its spin: it swells
# to many times its size and turns less than a rigid body, or triangles are crushed to a line, where
# the law in space has a kink that Newton's method does not get over; cut eight times, then refused.
ENDS_OF_SPIN = {
    f"{integrator}; {stiffness}": end
    for integrator, ends in (("linearly implicit", (16, 16, 16, 16)), ("implicit", (8, 16, 16, 16)),
                             ("conserving", (2, 2, 8, 8)))
    for stiffness, end in zip(
        ("isotropic", "laminate", "anisotropic 1e4", "anisotropic 1e4, yarn"), ends)
}


class Stress(InFolder):
    def test_every_case_is_a_row_and_holds(self):
        study = ["stress", "--quick", "--quiet", "--no-report", "--output", self.folder]
        result = run(*study)
        rows = rows_of(self.folder / "stress.csv")
        self.assertGreater(len(rows), 120)
        for row in rows:
            self.assertEqual(row["verdict"], "PASS", row)
            self.assertTrue(row["derivation"], row)
            self.assertEqual(row["outcome"], "finite", row)
        self.assertEqual({row["case"]: 1. / float(row["figure"]) for row in rows
                          if row["group"] == "spin"}, ENDS_OF_SPIN)
        verdicts = json.loads((self.folder / "verdicts.json").read_text())["verdicts"]
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.returncode, status_of(verdicts))
        for verdict in verdicts:
            self.assertEqual(verdict["kind"], "program")
            self.assertTrue(verdict["derivation"])
        study_of = json.loads((self.folder / "study.json").read_text())
        self.assertEqual((study_of["cases"], study_of["repeats"]), (len(rows), 2))
        self.assertTrue(study_of["left_out"])
        # The same once more: every row is there.
        text = (self.folder / "stress.csv").read_text()
        self.assertEqual(run(*study).returncode, result.returncode)
        self.assertEqual((self.folder / "stress.csv").read_text(), text)
        self.assertTrue(json.loads((self.folder / "study.json").read_text())["resumed"])
        # Another run is refused, with what differs; so are rows that somebody edited.
        other = run("stress", CELLS / "layered.prm", "--quick", "--no-report", "--output",
                    self.folder)
        self.assertEqual(other.returncode, 2)
        self.assertRegex(other.stderr,
                         r"holds another run \(cell layered\), .* of work; "
                         r".*--overwrite removes it")
        self.assertEqual(text, (self.folder / "stress.csv").read_text())
        (self.folder / "stress.csv").write_text(text.replace("PASS", "FAIL"))
        edited = run(*study)
        self.assertEqual(edited.returncode, 2)
        self.assertIn("stress.csv: was changed after the run ended", edited.stderr)
