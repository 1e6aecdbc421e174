# SPDX-License-Identifier: MIT
"""Homogenization from Python: the program's numbers, cells from arrays, refusals."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

import homespun

BUILD = pathlib.Path(os.environ["HOMESPUN_BUILD"])
SOURCE = pathlib.Path(__file__).resolve().parents[2]
CELL = SOURCE / "meshes/cells/layered.prm"
SOFT = {"E": 1e6, "nu": 0.3, "thickness": 5e-4, "density": 400.}
HARD = {"E": 1e7, "nu": 0.3, "thickness": 5e-4, "density": 400.}


def striped(n, side=0.01):
    """n x n squares cut in two, the left half of them phase 0."""
    x = numpy.linspace(0., side, n + 1)
    vertices = numpy.array([(a, b) for b in x for a in x])
    triangles, groups = [], []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            triangles += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
            groups += [int(2 * i >= n)] * 2
    return vertices, numpy.array(triangles, dtype=numpy.int32), numpy.array(groups)


class Homogenize(unittest.TestCase):
    def refused(self, call, *texts):
        with self.assertRaises(ValueError) as caught:
            call()
        for text in texts:
            self.assertIn(text, str(caught.exception))

    def test_a_file_gives_the_numbers_of_the_program_bit_for_bit(self):
        with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
            subprocess.run([BUILD / "homespun", "homogenize", "--no-bars", "--quiet",
                            "--order", "2", "--output", folder, CELL], check=True)
            program = homespun.Cell.read(str(pathlib.Path(folder, "cell.h5")))
        cell = homespun.homogenize(CELL)
        numpy.testing.assert_array_equal(cell.stiffness, program.stiffness)
        numpy.testing.assert_array_equal(cell.chi, program.chi)
        numpy.testing.assert_array_equal(cell.vertices, program.vertices)
        self.assertEqual(cell.areal_density, program.areal_density)

    def test_arrays_give_the_laminate(self):
        vertices, triangles, groups = striped(8)
        cell = homespun.homogenize(vertices=vertices, triangles=triangles, groups=groups,
                                   phases=[SOFT, HARD], order=1)
        D = numpy.array([phase["E"] * phase["thickness"] / (1 - phase["nu"]**2)
                         for phase in (SOFT, HARD)])
        # The solver stops at 1e-11 of the loads.
        self.assertAlmostEqual(cell.stiffness[0, 0] * (1 / D).mean(), 1., 9)
        self.assertAlmostEqual(cell.areal_density, 0.2, 12)
        numpy.testing.assert_array_equal(cell.material, groups)
        again = homespun.homogenize(vertices=vertices.tolist(), triangles=triangles.astype("i8"),
                                    groups=list(groups), phases=(SOFT, HARD), order=numpy.int64(1))
        numpy.testing.assert_array_equal(again.stiffness, cell.stiffness)

    def test_refusals(self):
        vertices, triangles, groups = striped(4)
        good = {"vertices": vertices, "triangles": triangles, "groups": groups,
                "phases": [SOFT, HARD]}

        def call(**other):
            return lambda: homespun.homogenize(**{**good, **other})

        self.refused(lambda: homespun.homogenize("nowhere.prm"), "nowhere.prm", "no such file")
        self.refused(lambda: homespun.homogenize(), "vertices, triangles, groups, phases missing")
        self.refused(lambda: homespun.homogenize(CELL, groups=groups), "a file and groups")
        self.refused(call(order=3), "order: found 3; expected 1 or 2")
        self.refused(call(groups=groups[:-1]), "groups", str(len(triangles)))
        self.refused(call(groups=groups + 1), "groups: triangle", "expected 0 to 1")
        self.refused(call(phases=[SOFT, {"E": 1.}]), "phase 1: has no `nu`", "`thickness`")
        self.refused(call(phases=[SOFT, {**HARD, "E": -1.}]), "phase 1")
        self.refused(call(triangles=triangles[:-1], groups=groups[:-1]), "outline")
        self.refused(call(vertices=vertices[:, :1]), "vertices: found the shape", "(n, 2)")
        self.refused(call(triangles=triangles + 0.5), "triangles: found 0.5 at [0, 0]")
        self.refused(call(groups=groups + 0.5), "groups: found 0.5 at [0]")
        self.refused(call(groups=-groups), "groups: found -1 at")
        self.refused(call(phases=[]), "phases: found none")
        self.refused(call(phases=[SOFT, 3]), "phase 1: found 3; expected a dict")
        self.refused(call(phases=[SOFT, {**HARD, "E": "1e6"}]), "phase 1: `E`: found '1e6'")
        self.refused(call(phases=[SOFT, {**HARD, "E": numpy.nan}]), "phase 1")

    def test_the_example_runs(self):
        with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
            picture = pathlib.Path(folder, "cloth.png")
            out = subprocess.run([sys.executable, "-B", SOURCE / "python/example.py", picture],
                                 check=True, text=True, stdout=subprocess.PIPE).stdout
            self.assertIn("C^H", out)
            self.assertGreater(picture.stat().st_size, 10000)
        lines = (SOURCE / "python/example.py").read_text(encoding="utf-8").splitlines()
        self.assertLess(len(lines), 60)


if __name__ == "__main__":
    unittest.main()
