# SPDX-License-Identifier: MIT
"""Methods of `drape` that move coarse cloths of their own."""
import unittest

from cli import CELLS, rows_of, run
from scene_case import TRIANGLE, SceneCase


class MethodsOfTheirOwn(SceneCase):
    """`edges`, `quadratic`, `p2` and `full` move coarse cloths of their own and leave that of
    others alone."""

    TERMS = "membrane, damping, pins, handles, selvedge"
    COMMON = ["--quick", "--duration", 0.2, "--no-report", "--frames", "obj", "--references",
              "shell", "--unit-cells", CELLS / "three-stiffness.prm"]

    def test_each_has_its_cloth_and_the_others_keep_every_byte(self):
        with_them, without = self.folder / "with", self.folder / "without"
        result = run("drape", self.scene({"Terms": self.TERMS}, "pull"), *self.COMMON,
                     "--methods", "affine,localized,edges,quadratic,p2,full", "--output", with_them)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("clamped, with slip and modes: axis 2, near end and axis 2, far end",
                      result.stdout + result.stderr)
        result = run("drape", self.scene({}, "pull"), *self.COMMON, "--methods",
                     "affine,localized", "--output", without)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        folder = "three-stiffness-corotational"
        frames = sorted(path.name for path in (without / folder).glob("*.obj"))
        self.assertGreater(len(frames), 3)
        for frame in frames:
            self.assertEqual((with_them / folder / frame).read_bytes(),
                             (without / folder / frame).read_bytes(), frame)
        for method in ("edges", "quadratic", "p2", "full"):
            self.assertNotEqual((with_them / f"three-stiffness-{method}" / frames[-1]).read_bytes(),
                                (without / folder / frames[-1]).read_bytes())
        rows = {(row["variant"], row["method"]) for row in rows_of(with_them / "drape.csv")}
        self.assertEqual(rows, {("corotational", "affine"), ("corotational", "localized"),
                                ("edges", "edges"), ("quadratic", "quadratic"), ("p2", "p2"),
                                ("full", "full")})
        self.assertEqual({row["variant"] for row in rows_of(with_them / "motion.csv")},
                         {"corotational", "edges", "quadratic", "p2", "full", "shell"})

    def refused(self, changes, methods, cells=4, **scene):
        result = run("drape", self.scene(changes, **{"name": "pull", **scene}), "--quick",
                     "--cells", cells, "--methods", methods, "--no-report", "--output",
                     self.folder / "refused")
        self.assertEqual(result.returncode, 2, result.stdout)
        return result.stderr

    def test_what_cannot_be_is_named(self):
        self.assertIn("--methods edges asks for the term `selvedge`", self.refused({}, "edges"))
        self.assertIn("lists `selvedge`, and no method takes it",
                      self.refused({"Terms": self.TERMS}, "localized"))
        self.assertIn("--methods quadratic: scene `scene` has the key `Integrator` = conserving",
                      self.refused({"Integrator": "conserving"}, "localized,quadratic"))
        held = {"Terms": "membrane, gravity, damping, pins, selvedge", "Pins": "vertices 0 1"}
        self.assertIn("is a garment, whose outlines",
                      self.refused(held, "edges", name="hang", garment=TRIANGLE))
        for method in ("p2", "full"):
            terms = {"Terms": self.TERMS} if method == "full" else {}
            self.assertIn(f"--methods {method}: scene `scene` has 3 x 3 cells; expected even",
                          self.refused(terms, f"localized,{method}", cells=3))
            self.assertIn(f"--methods {method}: scene `scene` has the key `Integrator`",
                          self.refused({**terms, "Integrator": "conserving"},
                                       f"localized,{method}"))
        self.assertIn("is a garment, whose panels six-node triangles do not fill",
                      self.refused({**held, "Terms": "membrane, gravity, damping, pins"}, "p2",
                                   name="hang", garment=TRIANGLE))


if __name__ == "__main__":
    unittest.main()
