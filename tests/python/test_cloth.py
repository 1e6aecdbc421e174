# SPDX-License-Identifier: MIT
"""The coarse cloth from Python: falls, handles, and what is refused."""
import unittest

import numpy

import homespun
from with_cell import SIDE, WithCell, address


class Cloths(WithCell):
    def hanging(self, **choices):
        sheet = homespun.Sheet(self.cell, 5, 5)
        top = numpy.flatnonzero(sheet.coarse_vertices[:, 1] > 5 * SIDE - 1e-9)
        return homespun.Cloth(self.cell, sheet.coarse_vertices, sheet.coarse_triangles,
                              held=top.tolist(), **choices), top

    def test_a_free_cloth_falls_as_everything_does(self):
        sheet = homespun.Sheet(self.cell, 4, 4)
        cloth = homespun.Cloth(self.cell, sheet.coarse_vertices, sheet.coarse_triangles)
        h, steps = 0.01, 10
        for _ in range(steps):
            cloth.step(h)
        # Implicit Euler: z = −g h² n (n + 1) / 2.
        numpy.testing.assert_allclose(cloth.positions[:, 2],
                                      -9.81 * h * h * steps * (steps + 1) / 2, rtol=1e-9)
        self.assertAlmostEqual(cloth.time, 0.1)

    def test_positions_are_a_view_that_moves_with_the_cloth(self):
        cloth, top = self.hanging()
        positions = cloth.positions
        before = positions.copy()
        cloth.step(0.01)
        self.assertEqual(address(positions), address(cloth.positions))
        self.assertLess(positions[:, 2].min(), before[:, 2].min())
        numpy.testing.assert_array_equal(positions[top], before[top])
        self.assertFalse(positions.flags.writeable)

    def test_held_vertices_go_where_they_are_told(self):
        cloth, top = self.hanging(gravity=[0., 0., 0.])
        target = cloth.positions[top[0]] + [0., 0.001, 0.]
        cloth.prescribe(int(top[0]), target.tolist())
        cloth.step(0.01)
        numpy.testing.assert_array_equal(cloth.positions[top[0]], target)
        self.assertGreater(cloth.stored_energy, 0.)

    def test_refusals(self):
        sheet = homespun.Sheet(self.cell, 2, 2)
        rest, triangles = sheet.coarse_vertices, sheet.coarse_triangles
        make = lambda **more: homespun.Cloth(self.cell, rest, triangles, **more)
        self.refused(lambda: make(held=[99]), "99")
        self.refused(lambda: make(bending=True), "no D^H")
        self.refused(lambda: make(integrator="leapfrog"), "leapfrog", "linearly implicit")
        self.refused(lambda: make(positions=numpy.zeros((3, 3))), "positions", "found 3 rows")
        self.refused(lambda: make().step(0.), "0")
        for name, bad, texts in (
                ("held", [0.5], "held: found 0.5 at [0]; expected indices, whole numbers from 0"),
                ("held", numpy.array([0, -1]), "held: found -1"),
                ("held", [True, False], "held: found a list of bool"),
                ("gravity", [0., 1.], "gravity: found the shape (2,); expected (3,)"),
                ("gravity", [0., 0., numpy.nan], "gravity: found nan at [2]"),
                ("positions", numpy.full((9, 3), numpy.nan), "positions: found nan at [0, 0]")):
            self.refused(lambda: make(**{name: bad}), texts)
        cloth = make(held=[0])
        self.refused(lambda: cloth.prescribe(0, [0., 0.]), "position: found the shape (2,)")
        moved = triangles.astype(float)
        for value, text in ((0.5, "0.5"), (-1., "-1"), (numpy.nan, "nan"), (2.**31, "2147483648")):
            moved[1, 2] = value
            self.refused(lambda: homespun.Cloth(self.cell, rest, moved),
                         f"triangles: found {text}", "at [1, 2]; expected")
        for value in (-2**32, -2**32 + 5, -2**62, 2**31, 2**32 + 5, 2**63 - 1, -2**63, 2**63):
            whole = triangles.astype(numpy.uint64 if value == 2**63 else numpy.int64)
            whole[1, 2] = value  # of which 32 bits would be an index that is there
            self.refused(lambda: homespun.Cloth(self.cell, rest, whole),
                         f"triangles: found {value} at [1, 2]; expected indices")
            self.refused(lambda: make(held=whole[1]), f"held: found {value} at [2]; expected")
        wrong = triangles.copy()
        wrong[1, 2] = -1
        self.refused(lambda: homespun.Cloth(self.cell, rest, wrong), "triangles: found -1 at [1, 2]")
        self.refused(lambda: homespun.Cloth(self.cell, rest, triangles[:, :2]),
                     "triangles: found the shape (8, 2); expected (n, 3)")

    def test_whatever_numpy_takes_for_numbers_makes_the_same_cloth(self):
        sheet = homespun.Sheet(self.cell, numpy.int64(3), 3)
        rest, triangles = sheet.coarse_vertices, sheet.coarse_triangles
        top = numpy.flatnonzero(rest[:, 1] > rest[:, 1].max() - 1e-9)
        fallen = []
        for given in ((rest, triangles, top.tolist(), (0., 0., -9.81)),
                      (rest.tolist(), triangles.astype("i8"), top, numpy.array([0., 0., -9.81])),
                      (numpy.asfortranarray(rest), triangles.astype("u1"), tuple(top), [0, 0, -9.81]),
                      (rest, triangles.astype("f4"), top.astype("f8"), (0., 0., -9.81))):
            cloth = homespun.Cloth(self.cell, *given[:2], held=given[2], gravity=given[3])
            cloth.prescribe(top[0], rest[top[0]].tolist() + [0.])
            cloth.step(numpy.float32(0.25))
            fallen.append(cloth.positions.copy())
        self.assertLess(fallen[0][:, 2].min(), 0.)
        for positions in fallen[1:]:
            numpy.testing.assert_array_equal(positions, fallen[0])

if __name__ == "__main__":
    unittest.main()
