# SPDX-License-Identifier: MIT
"""What a run says is what it did: exit statuses, folders that are one run, notes of what ran."""
import json
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest

from cli import CELLS, LAYERED, PATIENCE, PROGRAM, InFolder, cut, rows_of, run

SMALL = ["--cells", "2", "--loads", "periodic-12", "--strains", "0.01", "--references", "biot",
         "--no-budget", "--no-runtime", "--no-report"]
SMALL_SHEET = ["--cells", "2", "--loads", "shear-frame", "--strains", "0.01",
               "--references", "biot", "--no-budget", "--no-report"]


class OneRun(InFolder):
    def tree(self, folder):
        return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*")
                if path.is_file()}

    def test_a_load_of_which_no_level_has_an_equilibrium_is_open_on_two_ranks_too_with_a_page(self):
        result = run("strain", LAYERED, "--cells", "2", "--loads", "shear-frame", "--references",
                     "green", "--strains", "60%,80%", "--no-budget", "--no-runtime",
                     "--output", self.folder / "run", ranks=2)
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertRegex(result.stdout, "INCONCLUSIVE +program +layered, shear-frame, green: .*"
                                        "each of 2 levels .levels without; none from strain "
                                        "0.6 on; the law is lost at .*: 2 ")
        self.assertIn("no equilibrium found", result.stderr)
        self.assertIn("no level was reached",
                      (self.folder / "run" / "report.html").read_text(encoding="utf-8"))

    def test_every_claim_has_a_kind_and_a_limit_that_says_where_it_comes_from(self):
        output = self.folder / "run"
        # At 10 % the budget of a sheet may be open.
        self.assertIn(run("strain", LAYERED, "--cells", "2", "--loads", "periodic-12,strip-1",
                          "--no-runtime", "--no-report", "--output", output).returncode, (0, 4))
        verdicts = json.loads((output / "verdicts.json").read_text())["verdicts"]
        # Those of the kind `input` are about brackets and meshes that `homogenize` refines.
        self.assertEqual({verdict["kind"] for verdict in verdicts}, {"program", "method"})
        for verdict in verdicts:
            self.assertTrue(verdict["derivation"], verdict)
            # What the settings cannot decide is no claim.
            self.assertIsNotNone(verdict["value"], verdict)

    def test_notes_speak_of_what_ran(self):
        def notes(*options):
            output = self.folder / "-".join(["run", *options])
            self.assertEqual(run("strain", LAYERED, *SMALL, *options, "--output",
                                 output).returncode, 0)
            study = json.loads((output / "study.json").read_text())
            return " ".join(study["notes"]), {item["what"] for item in study["left_out"]}
        text, left_out = notes()
        for word in ("budget", "Run times", "plane"):
            self.assertNotIn(word, text)
        self.assertIn("error budget", left_out)
        self.assertIn("load strip-1", left_out)
        # Which was not asked for.
        self.assertFalse([what for what in left_out if "linear" in what], left_out)

    def test_default_places_keep_commands_and_sizes_apart(self):
        for options in ([], ["--quick"]):
            result = run("strain", LAYERED, *SMALL, *options, cwd=self.folder)
            self.assertEqual(result.returncode, 0)
        self.assertEqual(run("homogenize", LAYERED, "--quiet", cwd=self.folder).returncode, 0)
        places = {path.name for path in (self.folder / "out" / "layered").iterdir()}
        self.assertEqual(places, {"strain", "strain-quick", "homogenize"})

    def test_work_of_another_run_is_refused_or_replaced_by_how_long_it_took(self):
        output = self.folder / "run"
        study = ["strain", LAYERED, *SMALL, "--output", output]
        self.assertEqual(run(*study).returncode, 0)
        description = json.loads((output / "run.json").read_text())
        description["seconds"] = 4000
        (output / "run.json").write_text(json.dumps(description))
        before = self.tree(output)
        other = [*study, "--methods", "affine,localized"]
        for options, words in (([], "66 min of work"),
                               (["--resume"], "expected the same to --resume")):
            result = run(*other, *options)
            self.assertEqual(result.returncode, 2)
            self.assertIn("holds another run (methods)", result.stderr)
            self.assertIn(words, result.stderr)
            self.assertEqual(self.tree(output), before)
        self.assertEqual(run(*study).returncode, 0)  # the same is taken up
        result = run(*other, "--overwrite")
        self.assertEqual(result.returncode, 0)
        self.assertIn("the earlier run was replaced (methods)", result.stderr)
        self.assertEqual({row["method"] for row in rows_of(output / "strain.csv")},
                         {"affine", "localized"})

    def test_a_changed_cell_is_another_run(self):
        output = self.folder / "run"
        self.assertEqual(run("strain", LAYERED, *SMALL, "--output", output).returncode, 0)
        other = self.cell_with("hard: 1e7", "hard: 2e7")
        result = run("strain", other, *SMALL, "--resume", "--output", output)
        self.assertEqual(result.returncode, 2)
        self.assertIn("holds another run (cell layered)", result.stderr)

    def test_a_folder_with_something_else_or_a_damaged_row_is_not_touched(self):
        output = self.folder / "run"
        study = ["strain", LAYERED, *SMALL, "--output", output]
        output.mkdir()
        (output / "thesis.txt").write_text("years")
        result = run(*study, "--overwrite")
        self.assertEqual(result.returncode, 2)
        self.assertIn("holds thesis.txt", result.stderr)
        self.assertEqual(self.tree(output).keys(), {(output / "thesis.txt").relative_to(output)})
        shutil.rmtree(output)
        self.assertEqual(run(*study).returncode, 0)
        cut(output)
        path = output / "strain.csv"
        path.write_text(path.read_text().replace("layered,periodic-12,0.01,",
                                                 "layered,periodic-12,0.x1,", 1))
        before = path.read_bytes()
        result = run(*study)
        self.assertEqual(result.returncode, 2)
        self.assertIn("strain.csv:2: column `strain`: found `0.x1`; expected a number above zero",
                      result.stderr)
        self.assertEqual(path.read_bytes(), before)

    def test_two_at_once_do_not_mix(self):
        output = self.folder / "run"
        study = [PROGRAM, "strain", str(CELLS / "layered.prm"), "--quick", "--no-report", "--quiet",
                 "--output", str(output)]
        with subprocess.Popen(study, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as first:
            deadline = time.monotonic() + 300 * PATIENCE
            while not (output / "strain.csv").exists() and time.monotonic() < deadline:
                time.sleep(0.01)
            result = run(*study[1:])
            os.kill(first.pid, signal.SIGKILL)
        self.assertEqual(result.returncode, 2)
        self.assertIn("another homespun is writing there", result.stderr)
        # The lock went with its process, and its rows with its run.
        again = run("strain", LAYERED, *SMALL, "--output", output, "--overwrite")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual({row["load"] for row in rows_of(output / "strain.csv")}, {"periodic-12"})


class Figure3(InFolder):
    def test_the_target_ends_well_where_only_the_method_failed_or_claims_are_open(self):
        script = CELLS.parents[1] / "verification" / "figure3.py"
        # A homespun that writes what it is told, in the place of a study, and a page of it.
        homespun = self.folder / "homespun"
        homespun.write_text("""#!/bin/sh
for folder; do :; done
if [ "$1" = report ]; then echo page > "$folder/report.html"; exit 0; fi
mkdir -p "$folder" && cp "$VERDICTS" "$folder/verdicts.json" && exit "$STATUS"
""", encoding="utf-8")
        homespun.chmod(0o755)

        def ends_with(status, *claims):
            verdicts = [{"claim": "a claim", "kind": kind, "verdict": verdict, "value": 1,
                         "limit": "0"} for kind, verdict in claims]
            told = self.folder / "verdicts.json"
            told.write_text(json.dumps({"verdicts": verdicts}), encoding="utf-8")
            return subprocess.run(
                [sys.executable, "-B", script, self.folder / "out", homespun, "a.prm", "b.prm"],
                env={**os.environ, "VERDICTS": str(told), "STATUS": str(status)},
                capture_output=True, text=True, check=False)
        self.assertEqual(ends_with(0).returncode, 0)
        self.assertTrue((self.folder / "out" / "report.html").exists())
        self.assertEqual(ends_with(4, ("program", "INCONCLUSIVE")).returncode, 0)
        of_method = ends_with(1, ("method", "FAIL"), ("program", "PASS"))
        self.assertEqual(of_method.returncode, 0)
        self.assertEqual(of_method.stdout.count("a claim: 1 (0)"), 2)
        self.assertEqual(ends_with(1, ("method", "FAIL"), ("program", "FAIL")).returncode, 1)
        self.assertEqual(ends_with(1).returncode, 1)
        self.assertEqual(ends_with(2).returncode, 2)
        self.assertEqual(ends_with(3).returncode, 3)

    def test_run_times_are_added_to_a_study_that_has_none(self):
        options = [LAYERED, *SMALL_SHEET, "--output", self.folder / "run"]
        first = run("strain", *options, "--no-runtime")
        self.assertFalse((self.folder / "run" / "runtime.csv").exists(), first.stderr)
        errors = (self.folder / "run" / "strain.csv").read_bytes()
        again = run("strain", *options)
        self.assertEqual(again.returncode, first.returncode, again.stderr)
        self.assertTrue(rows_of(self.folder / "run" / "runtime.csv"))
        self.assertEqual((self.folder / "run" / "strain.csv").read_bytes(), errors)


if __name__ == "__main__":
    unittest.main()
