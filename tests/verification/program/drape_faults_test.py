# SPDX-License-Identifier: MIT
"""Scenes say all that is wrong with them."""
import re
import unittest

from cli import LAYERED, run
from scene_case import SCENES, TRIANGLE, SceneCase


class BadScenes(SceneCase):
    def refused(self, path, *says, options=()):
        output = self.folder / "out"
        result = run("drape", path, *options, "--no-report", "--output", output)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for part in says:
            self.assertIn(part, result.stderr)
        self.assertFalse(output.exists(), "nothing is written")
        return result.stderr

    def test_terms(self):
        self.refused(self.scene({"Terms": "friction, gravity, pins, damping, magic",
                                 "Wind velocity": "1 0 0"}),
                     "unknown term `magic`; expected some of", "wind", "`membrane` is missing",
                     "`Wind velocity` belongs to the term `wind`",
                     "`friction` without `obstacles`")

    def test_places(self):
        self.refused(self.scene({"Pins": "vertices 0 99999"}), "held vertex 99999 does not exist")
        self.refused(self.scene({"Pins": "left; left"}), "the place `left` holds no vertex")
        # The last one for its error bar.
        for options, n in ((["--quick"], 4), (["--cells", 4], 4), (["--references", "biot"], 2)):
            self.refused(self.scene({"Pins": "vertices 0 1"}),
                         "held vertex 1, at (1, 0) of 20 x 20 cells", f"{n} x {n} cells",
                         options=options)
        self.refused(self.scene({"Pins": "vertices 0 99999"}), "held vertex 99999 does not exist",
                     options=["--quick"])
        self.refused(self.scene({"Terms": "membrane, handles, damping",
                                 "Handles": "right: translate 1 during 2", "Pins": None,
                                 "Gravity": None}), "place: translate dx dy dz during s")

    def test_time(self):
        # Beside them, faults of places: all are told at once.
        for value, pins, *words in (
                ("0", None, "key `Pins` is missing"),
                ("-0.01", "north", "found `north`", "`top left`"),
                ("nan", "waist", "found `waist`", "a sheet has no waist"), ("soon", "top")):
            self.refused(self.scene({"Time step": value, "Pins": pins}), "key `Time step`",
                         f"`{value}`", "positive", *words)
        self.refused(self.scene({"Frame interval": "0.015"}), "multiple of the time step")
        self.refused(self.scene({"Duration": "0.004", "Frame interval": "0.01"}), "`Duration`",
                     "0.004 s", "0.01 s")
        self.refused(SCENES / "hang.prm", "--duration", "0.004 s", "0.01 s",
                     options=["--duration", "0.004"])

    def test_all_faults_at_once(self):
        text = self.refused(self.scene({"Time step": "0", "Pins": "north",
                                        "Terms": "membrane, pins, damping, magic"}))
        self.assertGreaterEqual(text.count("scene.prm"), 3)

    def test_files(self):
        self.refused(self.folder / "none.prm", "no such file")
        self.refused(self.scene({"Cells": "gone.prm"}), "gone.prm does not exist")
        self.refused(self.scene({"Terms": "membrane, gravity, obstacles",
                                 "Obstacles": "mesh gone.obj 0 0 0", "Pins": None,
                                 "Damping rate": None}), "gone.obj does not exist")
        cell = self.cell_with("set Lattice vectors = auto", "set Lattice vectors = 1 0; 0 1.1")
        self.refused(self.scene({"Cells": cell}), "layered")

    def test_cloths(self):
        waist = {"Pins": "waist", "Placement": None}
        shift = "v 0.1 0.1 0\nvt 0.1 0.1\n"
        for says, text in {
                "without": "v 0 0 1\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n",
                "triangle 0": "v 0 0 1\nv 0.1 0 0\nv 0 0.1 0\nvt 0 0\nvt 0.1 0\nvt 0.2 0\n"
                              "f 1/1 2/2 3/3\n",
                "belongs to 3 triangles": TRIANGLE + shift + "v 0 0 -1\nvt 0.2 0.1\n"
                                          "f 2/2 4/4 3/3\nf 2/2 5/5 3/3\n",
                "inside": TRIANGLE + "v 0.05 0.05 0\nv 0.1 0.1 0\nvt 0.05 0.05\nvt 0.1 0.1\n"
                          "f 2/2 5/5 4/4\nf 4/4 5/5 3/3\n"}.items():
            with self.subTest(says):
                self.assertIn(says, self.refused(self.scene(waist, garment=text), "cloth.obj"))

    def test_keys_of_the_other_kind_of_cloth(self):
        waist = {"Pins": "waist", "Placement": None}
        keys = {"Centre": "0 0 3", "Sheet cells": "7 7", "Disturbance": "0.1"}
        self.refused(self.scene({**waist, **keys}, garment=TRIANGLE),
                     *(f"key `{key}` is of a sheet, and `Mesh` gives a garment" for key in keys))
        self.refused(self.scene({"Rest coordinate unit": "0.01"}),
                     "key `Rest coordinate unit` is of a garment")

    def test_a_variant_that_the_cell_cannot_have_is_told_before_anything_moves(self):
        text = (LAYERED.parent / "layered.prm").read_text(encoding="utf-8")
        (self.folder / "layered.msh").write_bytes(LAYERED.with_suffix(".msh").read_bytes())
        path = self.folder / "layered.prm"
        path.write_text(re.sub(r"(Young's modulus\s*=).*", r"\1 1e6", text), encoding="utf-8")
        result = run("drape", self.scene({"Cells": path}), "--quick", "--variants", "biot,yarn",
                     "--no-report", "--output", self.folder / "out")
        self.assertEqual(result.returncode, 2)
        self.assertIn(f"--variants yarn: C^H of {path} is alike", result.stderr)
        self.assertNotIn("frame", result.stderr)

    def test_references_that_lack_a_term(self):
        self.refused(SCENES / "flag.prm", "has the term `wind`", "expected the reference `shell`",
                     options=["--references", "biot"])
        self.refused(SCENES / "skirt.prm", "is a garment", options=["--references", "green"])
        self.refused(SCENES / "hang.prm", "found `oracle`", options=["--references", "oracle"])
        self.refused(SCENES / "hang.prm", "found `knitted`",
                     options=["--variants", "biot,knitted"])

    def test_frames_that_are_not_kept_are_told_with_the_reason(self):
        # A sheet pressed together by nearly its height, in steps too large for the coarse cloth.
        path = self.scene({"Cells": LAYERED, "Integrator": "conserving",
                           "Time step": "0.02", "Frame interval": "0.02", "Duration": "0.5",
                           "Handles": "top: translate 0 0 -0.19 during 0.5"}, name="pull")
        output = self.folder / "out"
        result = run("drape", path, "--cells", 2, "--quick", "--variants", "biot", "--references",
                     "biot", "--keep", "--no-report", "--no-frames", "--output", output)
        self.assertEqual(result.returncode, 1, result.stderr)
        told = re.search(r"layered, biot: positions are not kept from frame (\d+) to frame 25, "
                         "which the coarse cloth did not reach: the line search of the conserving "
                         "step", result.stderr)
        self.assertTrue(told, result.stderr)
        kept = [path.stem for path in (output / "layered" / "positions").glob("biot-*.h5")]
        self.assertEqual(max(kept), f"biot-{int(told[1]) - 1:04d}")


if __name__ == "__main__":
    unittest.main()
