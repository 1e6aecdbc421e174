# SPDX-License-Identifier: MIT
"""Scenes as a user meets them: they run, resume, and say all that is wrong with them."""
import csv
import json
import shutil
import unittest

from cli import CELLS, InFolder, run

SCENES = CELLS.parent / "scenes"
TRIANGLE = "v 0 0 1\nv 0.1 0 0\nv 0 0.1 0\nvt 0 0\nvt 0.1 0\nvt 0 0.1\nf 1/1 2/2 3/3\n"


def rows_of(path, leave_out=()):
    with open(path, newline="", encoding="utf-8") as file:
        return [{key: value for key, value in row.items() if key not in leave_out} for row in csv.DictReader(file)]


class Scenes(InFolder):
    def test_every_shipped_scene_runs_with_both_cells(self):
        for scene in sorted(SCENES.glob("*.prm")):
            with self.subTest(scene=scene.name):
                output = self.folder / scene.stem
                sheet = [] if scene.stem == "skirt" else ["--quick"]
                result = run("drape", scene, *sheet, "--duration", 0.2, "--no-report", "--no-frames", "--output", output)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                self.assertEqual({row["cell"] for row in rows_of(output / "motion.csv")}, {"layered", "three-stiffness"})
                found = json.loads((output / "drape.json").read_text())
                listed = {term["name"] for term in found["terms"] if term["present"]}
                self.assertIn("membrane", listed)

    def test_frames_open_elsewhere(self):
        output = self.folder / "frames"
        run("drape", SCENES / "hang.prm", "--quick", "--duration", 0.1, "--frames", "vtu,ply,obj", "--no-report",
            "--unit-cells", CELLS / "layered.prm", "--output", output)
        folder = output / "layered-corotational"
        self.assertEqual((folder / "fine.pvd").read_text().count("fine_000"), 3)
        for ending in ("vtu", "ply", "obj"):
            self.assertEqual(len(list(folder.glob(f"fine_*.{ending}"))), 3, ending)

    def test_the_two_references_agree_and_do_not_depend_on_the_ranks(self):
        errors = []
        for ranks in (1, 2):
            output = self.folder / f"ranks{ranks}"
            result = run("drape", SCENES / "pull.prm", "--quick", "--duration", 0.15, "--references", "biot,shell",
                         "--unit-cells", CELLS / "layered.prm", "--no-frames", "--no-report", "--output", output,
                         ranks=ranks)
            self.assertEqual(result.returncode, 0, result.stderr)
            errors.append({(row["reference"], row["method"], row["frame"]): float(row["error_mean_m"])
                           for row in rows_of(output / "drape.csv")})
        for (reference, method, frame), error in errors[0].items():
            self.assertAlmostEqual(errors[1][reference, method, frame], error, delta=1e-5 * error + 1e-13)
            # One linearly implicit step of the shell against Newton's method of the other.
            self.assertAlmostEqual(errors[0]["shell", method, frame], error, delta=1e-2 * error + 1e-12)

    def test_a_resumed_run_equals_an_uninterrupted_one(self):
        study = ["drape", SCENES / "pull.prm", "--quick", "--references", "biot,shell", "--unit-cells",
                 CELLS / "layered.prm", "--no-frames", "--no-report", "--output"]
        whole = self.folder / "whole"
        self.assertEqual(run(*study, whole, "--duration", 0.3).returncode, 0)
        # A run that was cut: rows of the last frames and the state of an earlier one.
        cut = self.folder / "cut"
        self.assertEqual(run(*study, cut, "--duration", 0.15).returncode, 0)
        shutil.copy(whole / "inputs.json", cut)
        self.assertEqual(run(*study, cut, "--duration", 0.3, "--resume").returncode, 0)

        def key(row):
            return row["reference"], row["method"], int(row["frame"])
        expected, found = (sorted(rows_of(folder / "drape.csv"), key=key) for folder in (whole, cut))
        self.assertEqual([key(row) for row in found], [key(row) for row in expected])
        for one, two in zip(found, expected):
            error = float(two["error_mean_m"])
            self.assertAlmostEqual(float(one["error_mean_m"]), error, delta=1e-5 * error + 1e-14)


class BadScenes(InFolder):
    def scene(self, changes, name="hang", garment=None):
        """A copy of a shipped scene with keys replaced, added, or, given None, removed."""
        lines = (SCENES / f"{name}.prm").read_text(encoding="utf-8").replace("../cells", str(CELLS)).splitlines()
        for key, value in changes.items():
            lines = [line for line in lines if line.split("=")[0].split()[1:] != key.split()]
            if value is not None:
                lines.append(f"set {key} = {value}")
        if garment is not None:
            (self.folder / "cloth.obj").write_text(garment, encoding="utf-8")
            lines.append("set Mesh = cloth.obj")
        path = self.folder / "scene.prm"
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path

    def refused(self, path, *says, options=()):
        output = self.folder / "out"
        result = run("drape", path, *options, "--no-report", "--output", output)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for part in says:
            self.assertIn(part, result.stderr)
        self.assertFalse(output.exists(), "nothing is written")
        return result.stderr

    def test_terms(self):
        self.refused(self.scene({"Terms": "membrane, gravity, pins, damping, magic"}), "unknown term `magic`", "wind")
        self.refused(self.scene({"Terms": "gravity, pins, damping"}), "`membrane` is missing")
        self.refused(self.scene({"Wind velocity": "1 0 0"}), "`Wind velocity` belongs to the term `wind`")
        self.refused(self.scene({"Terms": "membrane, friction, gravity, pins, damping"}), "`friction` without `obstacles`")

    def test_places(self):
        self.refused(self.scene({"Pins": None}), "key `Pins` is missing")
        self.refused(self.scene({"Pins": "north"}), "found `north`", "`top left`")
        self.refused(self.scene({"Pins": "vertices 0 99999"}), "held vertex 99999 does not exist")
        self.refused(self.scene({"Terms": "membrane, handles, damping", "Handles": "right: translate 1 during 2",
                                 "Pins": None, "Gravity": None}), "place: translate dx dy dz during s")

    def test_time(self):
        for value in ("0", "-0.01", "nan", "soon"):
            self.refused(self.scene({"Time step": value}), "key `Time step`", f"`{value}`", "positive")
        self.refused(self.scene({"Frame interval": "0.015"}), "multiple of the time step")

    def test_all_faults_at_once(self):
        text = self.refused(self.scene({"Time step": "0", "Pins": "north", "Terms": "membrane, pins, damping, magic"}))
        self.assertGreaterEqual(text.count("scene.prm"), 3)

    def test_files(self):
        self.refused(self.folder / "none.prm", "no such file")
        self.refused(self.scene({"Cells": "gone.prm"}), "gone.prm does not exist")
        self.refused(self.scene({"Terms": "membrane, gravity, obstacles", "Obstacles": "mesh gone.obj 0 0 0",
                                 "Pins": None, "Damping rate": None}), "gone.obj does not exist")
        cell = self.cell_with("set Lattice vectors = auto", "set Lattice vectors = 1 0; 0 1.1")
        self.refused(self.scene({"Cells": cell}), "layered")

    def test_cloths(self):
        waist = {"Pins": "waist", "Placement": None}
        shift = "v 0.1 0.1 0\nvt 0.1 0.1\n"
        for says, text in {
                "without": "v 0 0 1\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n",
                "triangle 0": "v 0 0 1\nv 0.1 0 0\nv 0 0.1 0\nvt 0 0\nvt 0.1 0\nvt 0.2 0\nf 1/1 2/2 3/3\n",
                "belongs to 3 triangles": TRIANGLE + shift + "v 0 0 -1\nvt 0.2 0.1\nf 2/2 4/4 3/3\nf 2/2 5/5 3/3\n",
                "inside": TRIANGLE + "v 0.05 0.05 0\nv 0.1 0.1 0\nvt 0.05 0.05\nvt 0.1 0.1\nf 2/2 5/5 4/4\nf 4/4 5/5 3/3\n"}.items():
            with self.subTest(says):
                self.assertIn(says, self.refused(self.scene(waist, garment=text), "cloth.obj"))

    def test_references_that_lack_a_term(self):
        self.refused(SCENES / "flag.prm", "has the term `wind`", "expected the reference `shell`",
                     options=["--references", "biot"])
        self.refused(SCENES / "skirt.prm", "is a garment", options=["--references", "green"])
        self.refused(SCENES / "hang.prm", "found `oracle`", options=["--references", "oracle"])
        self.refused(SCENES / "hang.prm", "found `knitted`", options=["--variants", "corotational,knitted"])


if __name__ == "__main__":
    unittest.main()
