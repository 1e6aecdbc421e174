# SPDX-License-Identifier: MIT
"""Methods of `drape` that move coarse cloths of their own."""
import unittest

from cli import CELLS, THREE, rows_of, run
from scene_case import TRIANGLE, SceneCase


class MethodsOfTheirOwn(SceneCase):
    """Those with the terms edges, cubic or p2 move coarse cloths of their own and leave that of
    others alone."""

    OWN = ("localized+edges", "localized+cubic+modes", "localized+p2", "full")

    TERMS = "membrane, damping, pins, handles, selvedge"
    COMMON = ["--quick", "--duration", 0.2, "--no-report", "--frames", "obj", "--references",
              "shell", "--unit-cells", THREE]

    def test_each_has_its_cloth_and_the_others_keep_every_byte(self):
        with_them, without = self.folder / "with", self.folder / "without"
        result = run("drape", self.scene({"Terms": self.TERMS}, "pull"), *self.COMMON,
                     "--methods", ",".join(("affine", "localized", "localized+modes", *self.OWN)),
                     "--output", with_them)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("clamped, with slip and modes: axis 2, near end and axis 2, far end",
                      result.stdout + result.stderr)
        result = run("drape", self.scene({}, "pull"), *self.COMMON, "--methods",
                     "affine,localized", "--output", without)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        folder = "three-stiffness-biot"
        frames = sorted(path.name for path in (without / folder).glob("*.obj"))
        self.assertGreater(len(frames), 3)
        for frame in frames:
            self.assertEqual((with_them / folder / frame).read_bytes(),
                             (without / folder / frame).read_bytes(), frame)
        for method in self.OWN:
            self.assertNotEqual((with_them / f"three-stiffness-{method}" / frames[-1]).read_bytes(),
                                (without / folder / frames[-1]).read_bytes())
        rows = {(row["variant"], row["method"]) for row in rows_of(with_them / "drape.csv")}
        self.assertEqual(rows, {("biot", "affine"), ("biot", "localized"),
                                ("biot", "localized+modes"),
                                *((method, method) for method in self.OWN)})
        self.assertEqual({(row["cloth"], row["variant"])
                          for row in rows_of(with_them / "motion.csv")},
                         {("reference", "shell"),
                          *(("coarse", name) for name in ("biot", *self.OWN))})

    def refused(self, changes, methods, cells=4, **scene):
        result = run("drape", self.scene(changes, **{"name": "pull", **scene}), "--quick",
                     "--cells", cells, "--methods", methods, "--no-report", "--output",
                     self.folder / "refused")
        self.assertEqual(result.returncode, 2, result.stdout)
        return result.stderr

    def test_what_is_asked_for_by_name_and_cannot_be_is_named(self):
        self.assertIn("`scene` does not list `selvedge` among its `Terms`",
                      self.refused({}, "localized+edges"))
        self.assertIn("lists `selvedge`, and no method takes it",
                      self.refused({"Terms": self.TERMS}, "localized"))
        for term in ("cubic", "p2"):
            self.assertIn(f"--methods localized+{term}: scene `scene` has the key `Integrator` = "
                          "conserving", self.refused({"Integrator": "conserving"},
                                                     f"localized,localized+{term}"))
        held = {"Terms": "membrane, gravity, damping, pins", "Pins": "vertices 0 1"}
        for term, words in (("edges", "whose coarse cloth has no terms of edges"),
                            ("p2", "whose panels six-node triangles"),
                            ("cubic", "whose coarse cloth has no cubic energy")):
            self.assertIn(f"is a garment, {words}", self.refused(
                held, f"localized+{term}", name="hang", garment=TRIANGLE))
        self.assertIn("--methods localized+p2: scene `scene` has 3 x 3 cells; expected even",
                      self.refused({}, "localized,localized+p2", cells=3))

    def test_what_a_preset_cannot_have_is_left_out_and_said(self):
        result = run("drape", self.scene({}, "pull"), *self.COMMON, "--cells", 3, "--methods",
                     "affine,localized,full", "--output", self.folder / "odd")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        for words in ("method full without p2: scene `scene` has 3 x 3 cells",
                      "method full without edges: scene `scene` does not list `selvedge`"):
            self.assertIn(words, result.stdout + result.stderr)
        self.assertIn(("full", "full"), {(row["variant"], row["method"])
                                         for row in rows_of(self.folder / "odd" / "drape.csv")})

    def test_a_cloth_of_yarns_has_no_second_order_and_a_garment_has_its_modes(self):
        weave = ["--quick", "--duration", 0.1, "--no-report", "--no-frames", "--unit-cells",
                 CELLS / "twill-straight.prm"]
        for term in ("cubic", "modes"):
            result = run("drape", self.scene({}, "pull"), *weave, "--methods",
                         f"localized,localized+{term}", "--output", self.folder / term)
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn(f"--methods localized+{term}: scene `scene` has a cloth of the law yarn",
                          result.stderr)
        result = run("drape", self.scene({}, "pull"), *weave, "--methods", "localized,full",
                     "--output", self.folder / "woven")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("method full without cubic: scene `scene` has a cloth of the law yarn",
                      result.stdout + result.stderr)
        held = {"Terms": "membrane, gravity, damping, pins", "Pins": "vertices 0 1"}
        result = run("drape", self.scene(held, "hang", garment=TRIANGLE), "--quick", "--duration",
                     0.1, "--no-report", "--no-frames", "--unit-cells",
                     THREE, "--methods", "localized,full", "--output",
                     self.folder / "garment")
        self.assertEqual(result.returncode, 0, result.stderr)
        said = result.stdout + result.stderr
        self.assertIn("method full without p2: scene `scene` is a garment", said)
        self.assertNotIn("method full without modes", said)


if __name__ == "__main__":
    unittest.main()
