# SPDX-License-Identifier: MIT
"""A study that was killed loses the row in progress, and ends as one that was not."""
import json
import os
import signal
import subprocess
import time
import unittest

from cli import CELLS, LAYERED, PROGRAM, InFolder, cut, rows_of, run, status_of

STUDY = ["strain", LAYERED, "--cells", "3", "--strains", "0.01,0.1", "--loads",
         "periodic-12,strip-2", "--references", "linear,biot", "--no-budget", "--no-runtime",
         "--no-report", "--quiet"]
SCENE = ["drape", CELLS.parent / "scenes" / "pull.prm", "--unit-cells", LAYERED,
         "--cells", "1", "--duration", "0.1", "--no-frames", "--no-report"]


class Resume(InFolder):
    def assert_open(self, result, output):
        """Of one cell the accuracy is open; all else holds."""
        verdicts = json.loads((output / "verdicts.json").read_text())["verdicts"]
        self.assertEqual(result.returncode, status_of(verdicts), result.stderr)
        self.assertEqual({(verdict["id"], verdict["verdict"]) for verdict in verdicts
                          if verdict["verdict"] != "PASS"}, {("error-in-scene", "INCONCLUSIVE")})

    def test_a_study_cut_at_any_row_is_completed(self):
        whole = self.folder / "whole"
        status = run(*STUDY, "--output", whole).returncode
        self.assertIn(status, (0, 4))  # on so coarse a mesh a claim may be open
        text = (whole / "strain.csv").read_text()
        expected = rows_of(whole / "strain.csv")
        for part in (0.35, 0.8):
            (whole / "strain.csv").write_text(text[:int(part * len(text))])
            refused = run(*STUDY, "--output", whole)
            self.assertEqual(refused.returncode, 2)
            self.assertIn("strain.csv: was changed after the run ended", refused.stderr)
            cut(whole)
            self.assertEqual(run(*STUDY, "--output", whole, "--resume").returncode, status)
            resumed = rows_of(whole / "strain.csv")
            (whole / "strain.csv").write_text(text)
            self.assert_same_rows(resumed, expected)
            self.assertIn("verdicts", json.loads((whole / "verdicts.json").read_text()))

    def test_rows_of_another_study_are_not_mixed_in(self):
        output = self.folder / "other"
        small = ["strain", LAYERED, "--loads", "periodic-12", "--strains", "0.01",
                 "--references", "biot", "--no-budget", "--no-runtime", "--no-report", "--quiet",
                 "--output", output]
        self.assertEqual(run(*small, "--cells", 2).returncode, 0)
        for ranks in (1, 2):
            result = run(*small, "--cells", 3, "--resume", ranks=ranks)
            self.assertEqual(result.returncode, 2)
            self.assertIn("holds another run (cells per side)", result.stderr)
        self.assertEqual(run(*small, "--cells", 2, "--resume").returncode, 0)

    def test_rows_of_another_density_are_not_mixed_in(self):
        other = self.cell_with("soft: 400, hard: 400", "soft: 400, hard: 500")
        studies = {"strain": ["--loads", "periodic-12", "--strains", "0.01", "--references", "biot",
                              "--cells", "2", "--no-budget", "--no-runtime"]}
        for name, options in studies.items():
            end = [*options, "--no-report", "--quiet", "--output", self.folder / name]
            self.assertEqual(run(name, LAYERED, *end).returncode, 0)
            result = run(name, other, *end, "--resume")
            self.assertEqual(result.returncode, 2, name)
            self.assertIn("holds another run (cell layered)", result.stderr)
        scene = [*SCENE, "--quiet", "--output", self.folder / "scene"]
        self.assertEqual(run(*scene).returncode, 0)
        result = run(*(other if word == LAYERED else word for word in scene),
                     "--resume")
        self.assertEqual(result.returncode, 2)
        self.assertIn("holds another run (cell layered)", result.stderr)

    def test_a_finished_scene_whose_tables_lost_rows_is_completed(self):
        output = self.folder / "scene"
        study = [*SCENE, "--references", "biot,shell", "--output", output]
        first = run(*study)
        self.assert_open(first, output)
        self.assertIn("error bar", first.stderr)
        whole = {name: (output / name).read_text() for name in ("drape.csv", "motion.csv")}
        expected = {name: rows_of(output / name) for name in whole}
        # Nothing is left to do, not even the error bar.
        again = run(*study)
        self.assert_open(again, output)
        self.assertNotIn("error bar", again.stderr)
        for name, text in whole.items():
            self.assertEqual((output / name).read_text(), text)
        for name, n_kept, ranks in (("drape.csv", -2, 1), ("motion.csv", -1, 2),
                                    ("drape.csv", 1, 1)):
            with self.subTest(table=name, kept=n_kept):
                lines = whole[name].splitlines(keepends=True)
                (output / name).write_text("".join(lines[:n_kept]))
                # Of a run that ended nobody may take away a row; one that was killed had not
                # written it yet.
                result = run(*study, ranks=ranks)
                self.assertEqual(result.returncode, 2, result.stdout)
                self.assertIn(f"{name}: was changed after the run ended", result.stderr)
                cut(output)
                result = run(*study, "--resume", ranks=ranks)
                self.assert_open(result, output)
                self.assertIn(f"rows of frame {2 if n_kept < 0 else 0} are missing", result.stderr)
                self.assert_same_rows(rows_of(output / name), expected[name])

    def test_a_single_level_outside_the_window_of_the_verdicts_ends_well(self):
        result = run("strain", LAYERED, "--loads", "periodic-12", "--strains", "0.2",
                     "--references", "biot", "--methods", "localized", "--no-report", "--output",
                     self.folder / "one")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("slope", result.stdout)  # which its own strains cannot decide
        self.assertNotIn("INCONCLUSIVE", result.stdout)

    def test_a_killed_study_leaves_whole_rows(self):
        output = self.folder / "killed"
        study = [CELLS / "layered.prm" if word == LAYERED else word for word in STUDY]
        with subprocess.Popen([PROGRAM, *map(str, study), "--output", str(output)],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            deadline = time.monotonic() + 60
            table = output / "strain.csv"
            while time.monotonic() < deadline and process.poll() is None:
                if table.exists() and table.read_text().count("\n") > 5:
                    break
                time.sleep(0.01)
            os.kill(process.pid, signal.SIGKILL)
        text = table.read_text()
        self.assertTrue(text.endswith("\n"))
        header, *rows = text.splitlines()
        self.assertEqual({line.count(",") for line in rows}, {header.count(",")})


if __name__ == "__main__":
    unittest.main()
