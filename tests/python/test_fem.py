# SPDX-License-Identifier: MIT
"""Homogenization from Python: the program's numbers, cells from arrays, refusals."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings

import h5py
import numpy

import homespun
from with_cell import BUILD, CELLS, SOURCE, Refusing, run_in_threads

CELL = CELLS / "layered.prm"
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


class Homogenize(Refusing):
    def test_a_file_gives_the_cell_and_the_brackets_of_the_program_bit_for_bit(self):
        # The drawing of hexagonal-dots has curves, whose bracket is another than that of its mesh.
        for name in ("layered", "hexagonal-dots"):
            prm = CELLS / f"{name}.prm"
            cell = homespun.homogenize(prm)
            with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
                subprocess.run([BUILD / "homespun", "homogenize", "--quiet", "--output", folder, prm],
                               check=True)
                mine = pathlib.Path(folder, "mine.h5")
                cell.write(mine)
                with h5py.File(mine) as a, h5py.File(pathlib.Path(folder, "cell.h5")) as b:
                    datasets = []
                    b.visititems(lambda path, item: datasets.append(path)
                                 if isinstance(item, h5py.Dataset) else None)
                    self.assertIn("chi", datasets)
                    self.assertIn("D", datasets)
                    self.assertIn("edges/slip", datasets)
                    for dataset in datasets:
                        numpy.testing.assert_array_equal(a[dataset][()], b[dataset][()], dataset)
                program = json.loads(pathlib.Path(folder, "homogenize.json").read_text())
            for bracket, letter in ((cell.stiffness_bracket, "C"), (cell.bending_bracket, "D")):
                lower = numpy.array(program[letter + "_lower"])
                upper = numpy.array(program[letter + "_upper"])
                numpy.testing.assert_array_equal(bracket.lower, lower)
                numpy.testing.assert_array_equal(bracket.upper, upper)
                numpy.testing.assert_array_equal(bracket.centre, (lower + upper) / 2)
                bars = numpy.sqrt(numpy.diag(upper - lower)) / 2
                numpy.testing.assert_allclose(bracket.half_width, numpy.outer(bars, bars) * 2,
                                              rtol=1e-12)
                self.assertEqual(bracket.is_of_drawing, name == "hexagonal-dots")
                self.assertIn("relative width", repr(bracket))

    def test_threads_find_the_same(self):
        run_in_threads("one = homespun.homogenize(sys.argv[1])\n"
                       "def work():\n"
                       "    for _ in range(2):\n"
                       "        cell = homespun.homogenize(sys.argv[1])\n"
                       "        assert (cell.stiffness == one.stiffness).all()\n"
                       "        for name in ('stiffness_bracket', 'bending_bracket'):\n"
                       "            assert (getattr(cell, name).lower == getattr(one, name).lower).all()",
                       CELL)

    def test_a_part_that_nothing_holds_is_refused(self):
        vertices, triangles, groups = striped(8)
        corner = (triangles % 9).min(axis=1), (triangles // 9).min(axis=1)
        ring = numpy.max([abs(corner[0] - 3.5), abs(corner[1] - 3.5)], axis=0)
        kept = ring != 1.5  # squares around a middle of 2 x 2, which then floats
        used, numbers = numpy.unique(triangles[kept], return_inverse=True)
        with self.assertRaisesRegex(homespun.BadInput, "floats"):
            homespun.homogenize(vertices=vertices[used], triangles=numbers.reshape(-1, 3),
                                groups=groups[kept], phases=[SOFT, HARD])

    def test_without_bars_the_cell_problems_alone(self):
        cell = homespun.homogenize(CELL, bars=False)
        numpy.testing.assert_array_equal(cell.stiffness, homespun.homogenize(CELL).stiffness)
        self.assertIsNone(cell.stiffness_bracket)
        self.assertIsNone(cell.bending_bracket)
        self.assertIsNone(cell.bending_stiffness)

    def test_a_mesh_too_large_for_brackets_has_none_and_says_so(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            cell = homespun.homogenize(CELL, max_dofs=1000)
        self.assertIsNone(cell.stiffness_bracket)
        self.assertIsNone(cell.bending_bracket)
        for one, name in zip(caught, ("C^H", "D^H")):
            self.assertIn(f"bracket on {name}: none: it would take 2880 DoFs", str(one.message))
            self.assertIn(": raise max_dofs, or", str(one.message))
        self.assertEqual(len(caught), 2)

    def test_brackets_of_a_mesh_hold_what_finer_ones_find(self):
        def board(n):
            """A checkerboard: both fields are wrong at its corners on every mesh."""
            vertices, triangles, _ = striped(n)
            centres = vertices[triangles].mean(axis=1) * 2 / 0.01
            groups = numpy.floor(centres).sum(axis=1) % 2
            return homespun.homogenize(vertices=vertices, triangles=triangles, groups=groups,
                                       phases=[SOFT, HARD])

        coarse, fine = board(4), board(16)
        for a, b in ((coarse.stiffness_bracket, fine.stiffness_bracket),
                     (coarse.bending_bracket, fine.bending_bracket)):
            self.assertGreater(a.width, 2 * b.width)
            # C^H lies in both, and what the finer mesh leaves open inside of the coarser bracket.
            self.assertTrue((abs(a.centre - b.centre) <= a.half_width + b.half_width).all())
            for larger, smaller in ((b.lower, a.lower), (a.upper, b.upper)):
                values = numpy.linalg.eigvalsh(larger - smaller)
                self.assertGreater(values.min(), -1e-9 * values.max())
        for cell in (coarse, fine):
            self.assertTrue((abs(cell.stiffness - cell.stiffness_bracket.centre)
                             <= cell.stiffness_bracket.half_width).all())

    def test_a_broken_file_has_the_text_of_check(self):
        text = CELL.read_text(encoding="utf-8")
        for old, new in (("set Thickness ", "set Thicknes "), ("hard: 1e7", "hard: -1e7"),
                         ("soft: 400, hard", "soft: 400, hart"), ("layered.msh", "nowhere.msh")):
            with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
                shutil.copy(CELL.with_suffix(".msh"), folder)
                broken = pathlib.Path(folder, "broken.prm")
                broken.write_text(text.replace(old, new), encoding="utf-8")
                check = subprocess.run([BUILD / "homespun", "check", broken], text=True, check=False,
                                       stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                self.assertEqual(check.returncode, 2, new)
                with self.assertRaises(homespun.BadInput) as caught:
                    homespun.homogenize(broken)
                for line in str(caught.exception).splitlines():
                    self.assertIn(line, check.stdout)
                self.assertIn(folder, str(caught.exception))

    def test_what_the_program_warns_of_is_a_warning(self):
        with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
            for path in (CELL, CELL.with_suffix(".msh")):
                shutil.copy(path, folder)
            mesh = pathlib.Path(folder, "layered.msh")
            # 720 triangles, the last block of which is one shorter.
            lines = mesh.read_text(encoding="utf-8").splitlines()
            del lines[lines.index("$EndElements") - 100]
            head = lines.index("$Elements") + 1
            self.assertEqual(lines[head], "2 720 1 720")
            lines[head] = "2 719 1 720"
            block = max(k for k, line in enumerate(lines) if line.endswith(" 2 360"))
            lines[block] = lines[block][:-3] + "359"
            mesh.write_text("\n".join(lines) + "\n", encoding="utf-8")
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                homespun.homogenize(CELL)
                self.assertEqual(caught, [])
                homespun.homogenize(pathlib.Path(folder, "layered.prm"))
            self.assertIn("layered.msh: a hole at (0.759259 0.516667)", str(caught[0].message))
            self.assertEqual(caught[0].filename, __file__)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                self.assertRaises(UserWarning, homespun.homogenize,
                                  pathlib.Path(folder, "layered.prm"))

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
        for order in (3, 0, -1, 2**32 + 2):
            self.refused(call(order=order), f"order: found {order}; expected 1 or 2")
        for most in (0, -5, 2**32 + 1000):
            self.refused(call(max_dofs=most), f"max_dofs: found {most}; expected 1 to 4294967295")
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
        self.refused(call(phases=[SOFT, {**HARD, "thick": 1e-4}]), "phase 1: found `thick`; exp")
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
