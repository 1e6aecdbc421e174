# SPDX-License-Identifier: MIT
"""Scenes as a user meets them: they run, and go on where they stopped."""
import json
import shutil
import subprocess
import sys
import time
import unittest

import h5py
import numpy

from cli import CELLS, COARSE, LAYERED, PROGRAM, cut, rows_of, run
from scene_case import SCENES, SceneCase

sys.path.append(str(CELLS.parents[1] / "verification" / "report"))
from read.vtu import read_vtu  # noqa: E402


def keep_rows(path, keep):
    """Removes the other rows of a table."""
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    header = lines[0].strip().split(",")
    path.write_text(lines[0] + "".join(line for line in lines[1:]
                                       if keep(dict(zip(header, line.strip().split(","))))),
                    encoding="utf-8")


class Scenes(SceneCase):
    def test_every_shipped_scene_runs_with_both_cells(self):
        # As they are, but that `../cells` is what has them on coarse meshes.
        scenes = self.folder / "scenes"
        shutil.copytree(SCENES, scenes)
        (self.folder / "cells").symlink_to(COARSE)
        for scene in sorted(scenes.glob("*.prm")):
            with self.subTest(scene=scene.name):
                output = self.folder / scene.stem
                sheet = [] if scene.stem == "skirt" else ["--quick"]
                result = run("drape", scene, *sheet, "--duration", 0.2, "--no-report",
                             "--no-frames", "--output", output)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                self.assertEqual({row["cell"] for row in rows_of(output / "motion.csv")},
                                 {"layered", "three-stiffness"})
                found = json.loads((output / "drape.json").read_text())
                listed = {term["name"] for term in found["terms"] if term["present"]}
                self.assertIn("membrane", listed)
                keys = found["parameters"]
                for term in found["terms"]:
                    if term["name"] == "damping" and term["present"]:
                        for key, what in (("Damping rate", "air"), ("Viscosity", "strain")):
                            self.assertEqual(what in term["parameters"], float(keys[key]) > 0,
                                             (scene.name, term, keys[key]))

    def test_frames_open_elsewhere(self):
        output = self.folder / "frames"
        run("drape", SCENES / "hang.prm", "--quick", "--duration", 0.1, "--frames", "vtu,ply,obj",
            "--no-report", "--unit-cells", LAYERED, "--output", output)
        folder = output / "layered-biot"
        self.assertEqual((folder / "fine.pvd").read_text().count("fine_000"), 3)
        for ending in ("vtu", "ply", "obj"):
            self.assertEqual(len(list(folder.glob(f"fine_*.{ending}"))), 3, ending)

    def test_a_duration_is_run_in_whole_steps_and_said_as_it_was_run(self):
        output = self.folder / "out"
        self.assertEqual(run("drape", SCENES / "hang.prm", "--quick", "--duration", 0.035,
                             "--no-frames", "--no-report", "--unit-cells", LAYERED,
                             "--output", output).returncode, 0)
        self.assertEqual([float(row["time_s"]) for row in rows_of(output / "motion.csv")
                          if not row["place"]], [0., 0.03])
        self.assertAlmostEqual(json.loads((output / "drape.json").read_text())["duration_s"], 0.03)

    def test_the_parameters_are_those_that_were_used(self):
        output = self.folder / "out"
        result = run("drape", SCENES / "pull.prm", "--cells", 4, "--time-step", 0.02,
                     "--duration", 0.12, "--no-frames", "--no-report", "--unit-cells", LAYERED,
                     "--output", output)
        self.assertEqual(result.returncode, 0, result.stderr)
        told = json.loads((output / "drape.json").read_text())
        used = told["parameters"]
        self.assertEqual([used[key] for key in ("Time step", "Duration", "Sheet cells", "Cells")],
                         ["0.02", "0.12", "4 4", str(LAYERED)])
        self.assertIn("with ways scaled from 20 20 cells", used["Handles"])
        self.assertTrue(any("frames are 0.06 s apart" in note for note in told["notes"]),
                        told["notes"])

    def test_energies_of_a_hanging_cloth_and_its_references_obey_clapeyron(self):
        # In equilibrium at small strain the weight has given twice what the cloth stores.
        output = self.folder / "out"
        scene = self.scene({"Integrator": "static"})
        self.assertEqual(run("drape", scene, "--quick", "--duration", 0.05, "--references",
                             "biot,shell", "--variants", "biot,nodal-warping",
                             "--unit-cells", LAYERED, "--no-frames", "--no-report",
                             "--output", output).returncode, 0)
        energies = {(row["cloth"], row["variant"], int(row["frame"])): row
                    for row in rows_of(output / "motion.csv") if not row["place"]}
        for name in (("coarse", "biot"), ("reference", "biot"), ("reference", "shell")):
            elastic, given = (float(energies[(*name, 1)][key]) - float(energies[(*name, 0)][key])
                              for key in ("elastic_J", "gravity_J"))
            self.assertGreater(elastic, 0.)
            self.assertAlmostEqual(given, -2. * elastic, delta=0.01 * elastic, msg=name)
        self.assertEqual(energies["coarse", "nodal-warping", 0]["elastic_J"], "")

    def test_held_vertices_of_a_smaller_sheet_are_at_the_same_places(self):
        # Both ends of the lower edge of 20 x 20 cells hold the sheet, which falls upwards.
        scene = self.scene({"Pins": "vertices 0 20", "Gravity": "0 0 9.81"})
        output = self.folder / "out"
        result = run("drape", scene, "--quick", "--duration", 0.05, "--references", "biot",
                     "--unit-cells", LAYERED, "--no-report", "--output", output)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        for name in ("layered-biot", "layered-reference-biot"):
            before, after = (read_vtu(output / name / f"fine_000{frame}.vtu").points
                             for frame in (0, 1))
            moved = numpy.linalg.norm(after - before, axis=1)
            low, high = before.min(axis=0), before.max(axis=0)
            self.assertAlmostEqual(high[0] - low[0], 0.04, delta=1e-6)
            ends = [[x, 0., low[2]] for x in (low[0], high[0])]
            held = [numpy.linalg.norm(before - end, axis=1).argmin() for end in ends]
            numpy.testing.assert_allclose(before[held], ends, atol=1e-7)
            self.assertEqual(sorted(numpy.flatnonzero(moved < 1e-7)), sorted(held), name)

    def test_the_checks_of_each_effective_stiffness_are_among_the_verdicts(self):
        output = self.folder / "out"
        self.assertEqual(run("drape", SCENES / "hang.prm", "--quick", "--duration", 0.05,
                             "--no-frames", "--no-report", "--output", output).returncode, 0)
        claims = [verdict["claim"]
                  for verdict in json.loads((output / "verdicts.json").read_text())["verdicts"]]
        for cell in ("layered", "three-stiffness"):
            for check in ("Hill-Mandel", "C^H <= Voigt", "C^H >= Reuss", "C_lower <= C_upper"):
                self.assertEqual(sum(claim.startswith(f"{cell}: {check}") for claim in claims), 1,
                                 (cell, check))

    def test_what_absent_terms_cost_is_measured_with_its_spread(self):
        output = self.folder / "out"
        self.assertEqual(run("drape", SCENES / "pull.prm", "--quick", "--duration", 0.05, "--costs",
                             "--unit-cells", LAYERED, "--no-frames", "--no-report",
                             "--output", output).returncode, 0)
        rows = {row["term"]: row for row in rows_of(output / "terms.csv")}
        self.assertEqual(set(rows), {"bending", "gravity", "damping", "wind", "obstacles"})
        for term, row in rows.items():
            self.assertGreater(float(row["seconds_per_step"]), 0.)
            self.assertGreaterEqual(float(row["seconds_spread"]), 0.)
            self.assertEqual(row["seconds_spread_forced"] == "", row["present"] == "true", term)

    def test_the_two_references_agree_and_do_not_depend_on_the_ranks(self):
        errors = []
        for ranks in (1, 2):
            output = self.folder / f"ranks{ranks}"
            result = run("drape", SCENES / "pull.prm", "--quick", "--duration", 0.15,
                         "--references", "biot,shell", "--unit-cells", LAYERED,
                         "--no-frames", "--no-report", "--output", output, ranks=ranks)
            self.assertEqual(result.returncode, 0, result.stderr)
            errors.append({(row["reference"], row["method"], row["frame"]):
                           float(row["error_mean_m"])
                           for row in rows_of(output / "drape.csv")})
        for (reference, method, frame), error in errors[0].items():
            self.assertAlmostEqual(errors[1][reference, method, frame], error,
                                   delta=1e-5 * error + 1e-13)
            # One linearly implicit step of the shell against Newton's method of the other.
            self.assertAlmostEqual(errors[0]["shell", method, frame], error,
                                   delta=1e-2 * error + 1e-12)

    def test_a_resumed_run_equals_an_uninterrupted_one(self):
        study = ["drape", SCENES / "pull.prm", "--quick", "--references", "biot,shell",
                 "--unit-cells", LAYERED, "--no-report", "--output"]
        whole, early = self.folder / "whole", self.folder / "early"
        self.assertEqual(run(*study, whole, "--duration", 0.3).returncode, 0)
        self.assertEqual(run(*study, early, "--duration", 0.15).returncode, 0)
        # What a kill leaves: the state of frame 3, rows and frames of the next one too, of the
        # second reference nothing.
        killed = self.folder / "killed"
        shutil.copytree(whole, killed)
        cut(killed)
        shutil.rmtree(killed / "layered-reference-shell")
        for frame in (5, 6):
            (killed / "layered-reference-biot" / f"fine_{frame:04d}.vtu").unlink()
        for table in ("drape.csv", "motion.csv"):
            keep_rows(killed / table, lambda row: row.get("cloth") == "coarse"
                      or row.get("reference", row["variant"]) == "biot"
                      and int(row["frame"]) <= 4)
        reference = "layered-reference-biot"
        shutil.copy(early / reference / "checkpoint.h5", killed / reference)
        with h5py.File(whole / reference / "checkpoint.h5") as of_whole, \
                h5py.File(killed / reference / "checkpoint.h5", "a") as of_cut:
            of_cut.attrs["run"] = of_whole.attrs["run"]
            self.assertEqual(of_cut.attrs["frame"], 3)
        for name in ("drape.json", "verdicts.json"):
            (killed / name).unlink()
        self.assertEqual(run(*study, killed, "--duration", 0.3, "--resume").returncode, 0)

        self.assertEqual(sorted(path.relative_to(killed) for path in killed.rglob("*")),
                         sorted(path.relative_to(whole) for path in whole.rglob("*")))
        for table, keys in (("drape.csv", ("reference", "method")),
                            ("motion.csv", ("cloth", "variant", "place"))):
            expected, found = (sorted(rows_of(folder / table),
                                      key=lambda row: [*(row[k] for k in keys), int(row["frame"])])
                               for folder in (whole, killed))
            self.assert_same_rows(found, expected)
        verdicts = [json.loads((folder / "verdicts.json").read_text())["verdicts"]
                    for folder in (whole, killed)]
        self.assertEqual(*([{**verdict, "command": ""} for verdict in some] for some in verdicts))
        for path in whole.rglob("*"):
            there = killed / path.relative_to(whole)
            if path.name == "run.json":
                self.assertEqual(*(json.loads(one.read_text())["fingerprint"]
                                   for one in (there, path)))
            elif path.suffix == ".pvd":
                self.assertEqual(there.read_text(), path.read_text(), path)
            elif path.suffix == ".vtu":
                one, two = read_vtu(there), read_vtu(path)
                numpy.testing.assert_allclose(one.points, two.points, atol=1e-8)
                self.assertEqual(set(one.point_data), set(two.point_data), path)
                for name, values in two.point_data.items():
                    numpy.testing.assert_allclose(one.point_data[name], values, atol=1e-8,
                                                  err_msg=f"{path} {name}")
        for frame in (f"{reference}/fine_0001.vtu", "layered-reference-shell/fine_0006.vtu"):
            self.assertIn("error", read_vtu(killed / frame).point_data)
        # Times are those of all steps, before and after the cut.
        with h5py.File(killed / reference / "checkpoint.h5") as of_cut, \
                h5py.File(early / reference / "checkpoint.h5") as of_early:
            seconds = numpy.array(of_cut["step_seconds"])
            self.assertEqual(len(seconds), 30)
            numpy.testing.assert_array_equal(seconds[:15], of_early["step_seconds"])
        reference = json.loads((killed / "drape.json").read_text())["cells"][0]["references"][0]
        self.assertAlmostEqual(reference["seconds_per_step"], numpy.median(seconds), delta=1e-5)

    def test_a_finished_run_that_is_resumed_keeps_its_times(self):
        study = ["drape", SCENES / "pull.prm", "--quick", "--references", "shell", "--unit-cells",
                 LAYERED, "--no-frames", "--no-report", "--duration", 0.1, "--output",
                 self.folder / "out"]

        def reference():
            found = json.loads((self.folder / "out" / "drape.json").read_text())
            return found["cells"][0]["references"][0]
        self.assertEqual(run(*study).returncode, 0)
        first = reference()
        self.assertEqual(run(*study, "--resume").returncode, 0)
        self.assertEqual(reference()["seconds_per_step"], first["seconds_per_step"])
        self.assertIsNotNone(reference()["coarse_steps_per_step"])

    def test_the_state_of_another_run_is_not_taken_up(self):
        output = self.folder / "out"
        study = ["drape", SCENES / "pull.prm", "--quick", "--references", "shell", "--unit-cells",
                 LAYERED, "--no-frames", "--no-report", "--duration", 0.1, "--output",
                 output]
        self.assertEqual(run(*study).returncode, 0)
        checkpoint = output / "layered-reference-shell" / "checkpoint.h5"
        kept = self.folder / "kept.h5"
        shutil.copy(checkpoint, kept)
        other = [*study, "--time-step", 0.005]
        before = {path: path.read_bytes() for path in output.rglob("*") if path.is_file()}
        refused = run(*other, "--resume")
        self.assertEqual(refused.returncode, 2, refused.stdout)
        self.assertIn("time_step", refused.stderr)
        self.assertEqual(before, {path: path.read_bytes() for path in output.rglob("*")
                                  if path.is_file()})
        # A run that begins anew does so without the state of the old one, even where it is killed
        # before its first frame.
        with subprocess.Popen([PROGRAM, *map(str, other), "--overwrite"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as process:
            deadline = time.monotonic() + 60
            while time.monotonic() < deadline and process.poll() is None:
                if self.time_step_of_run(output) == 0.005 and (output / "drape.csv").exists():
                    break
                time.sleep(0.001)
            process.kill()
        if checkpoint.exists():
            with h5py.File(checkpoint) as found, h5py.File(kept) as old:
                self.assertNotEqual(found.attrs["run"], old.attrs["run"])
        # A state that comes back is refused, with and without the table.
        for table in (True, False):
            if json.loads((output / "run.json").read_text())["finished"]:
                cut(output)
            checkpoint.parent.mkdir(exist_ok=True)
            shutil.copy(kept, checkpoint)
            if not table:
                (output / "drape.csv").unlink(missing_ok=True)
            result = run(*other, "--resume")
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn("checkpoint.h5", result.stderr)
            self.assertIn("--overwrite", result.stderr)

    @staticmethod
    def time_step_of_run(output):
        """None while there is no run."""
        try:
            description = json.loads((output / "run.json").read_text(encoding="utf-8"))
            return description["inputs"]["time_step"]
        except (FileNotFoundError, json.JSONDecodeError):
            return None

    def test_a_run_that_was_killed_is_taken_up_where_it_was(self):
        output = self.folder / "out"
        study = ["drape", SCENES / "pull.prm", "--quick", "--references", "shell", "--unit-cells",
                 LAYERED, "--no-frames", "--no-report", "--duration", 1, "--output",
                 output]
        checkpoint = output / "layered-reference-shell" / "checkpoint.h5"
        with subprocess.Popen([PROGRAM, *map(str, study)], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as process:
            deadline = time.monotonic() + 120
            while (time.monotonic() < deadline and process.poll() is None
                   and not checkpoint.exists()):
                time.sleep(0.001)
            process.kill()
        self.assertTrue(checkpoint.exists())
        self.assertFalse(json.loads((output / "run.json").read_text())["finished"])
        rows = rows_of(output / "drape.csv")
        self.assertTrue(rows)
        result = run(*study)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("shell reference, frame 0", result.stderr)
        self.assertEqual(rows_of(output / "drape.csv")[:len(rows)], rows)
        self.assertTrue(json.loads((output / "run.json").read_text())["finished"])

    def test_a_run_is_taken_up_only_with_what_it_was_asked_for(self):
        output = self.folder / "out"
        study = ["drape", SCENES / "pull.prm", "--quick", "--unit-cells", LAYERED,
                 "--no-frames", "--no-report", "--duration", 0.1, "--output", output]
        asked = {"--variants": "biot", "--methods": "localized", "--references": "shell"}
        options = [word for pair in asked.items() for word in pair]
        self.assertEqual(run(*study, *options).returncode, 0)
        for name, more in (("--variants", "biot,nodal-warping"),
                           ("--methods", "affine,localized"), ("--references", "shell,biot")):
            words = [word for pair in {**asked, name: more}.items() for word in pair]
            result = run(*study, *words, "--resume")
            self.assertEqual(result.returncode, 2, name)
            self.assertIn(f"holds another run ({name[2:]})", result.stderr)

    def test_each_claim_has_its_kind_and_says_where_its_limit_comes_from(self):
        output = self.folder / "out"
        self.assertEqual(run("drape", SCENES / "pull.prm", "--quick", "--duration", 0.1,
                             "--references", "shell", "--variants", "biot,nodal-warping",
                             "--unit-cells", LAYERED, "--no-frames", "--no-report",
                             "--output", output).returncode, 0)
        claims = {verdict["claim"]: verdict
                  for verdict in json.loads((output / "verdicts.json").read_text())["verdicts"]
                  if "runs to its end" in verdict["claim"]}
        self.assertEqual({claim: verdict["kind"] for claim, verdict in claims.items()}, {
            "layered, biot: the scene runs to its end (frames reached)": "program",
            "layered, nodal-warping: the scene runs to its end (frames reached)": "method",
            "layered, shell: the reference runs to its end (frames reached)": "program"})
        for verdict in claims.values():
            self.assertTrue(verdict["derivation"])
            self.assertEqual((verdict["verdict"], verdict["value"], verdict["limit"]),
                             ("PASS", 3, "3"))

    def test_what_was_left_out_is_what_was_not_asked_for(self):
        study = ["drape", SCENES / "pull.prm", "--quick", "--duration", 0.05, "--unit-cells",
                 LAYERED, "--no-frames", "--no-report"]
        for options, left_out in (
                ([], ["full-resolution cloth", "frames", "what absent terms would cost"]),
                (["--references", "biot,shell", "--costs"],
                 ["error bar of the reference biot", "error bar of the reference shell",
                  "frames"])):
            output = self.folder / f"out{len(options)}"
            self.assertEqual(run(*study, *options, "--output", output).returncode, 0)
            found = json.loads((output / "drape.json").read_text())
            self.assertEqual([item["what"] for item in found["left_out"]],
                             ["pull: " + what for what in left_out])
            # Of what ran there is only the law, which nobody asked for, to be told.
            self.assertEqual([note.split(", as none was asked for")[0] for note in found["notes"]],
                             ["layered: the law is biot"])


if __name__ == "__main__":
    unittest.main()
