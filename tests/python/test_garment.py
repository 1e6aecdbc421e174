# SPDX-License-Identifier: MIT
"""Cells laid over a mesh of one's own: an OBJ is up-sampled as the sheet that it is."""
import unittest

import numpy

import homespun
from with_cell import SIDE, SOURCE, WithCell, write_obj


class Garments(WithCell):
    n = 5

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.sheet = homespun.Sheet(cls.cell, cls.n, cls.n)
        cls.rest = cls.sheet.coarse_vertices
        cls.flat = numpy.column_stack([cls.rest, numpy.zeros(len(cls.rest))])
        cls.obj = cls.folder / "rest.obj"
        write_obj(cls.obj, cls.flat, cls.sheet.coarse_triangles)
        x, y, _ = cls.flat.T
        cls.moved = numpy.column_stack([1.03 * x + 0.02 * y, 0.1 * x * x / SIDE, y])

    def assert_same_cloth(self, garment, moved, of_sheet):
        """Vertex by vertex, found by their places at rest."""
        fine = homespun.Upsampler(self.cell, garment).upsample(moved)
        order = [numpy.lexsort(numpy.round(mesh.vertices / SIDE * 1e4).T)
                 for mesh in (garment, self.sheet)]
        numpy.testing.assert_allclose(garment.vertices[order[0]], self.sheet.vertices[order[1]],
                                      atol=1e-9)
        # Single precision.
        numpy.testing.assert_allclose(fine[order[0]], of_sheet[order[1]], atol=2e-7 * self.n * SIDE)

    def test_an_obj_of_a_sheet_is_up_sampled_as_the_sheet(self):
        of_sheet = homespun.Upsampler(self.cell, self.sheet).upsample(self.moved)
        affine = homespun.Upsampler(self.cell, self.sheet, method="affine").upsample(self.moved)
        self.assertGreater(abs(of_sheet - affine).max(), 1e-2 * 0.03 * SIDE)  # chi is seen
        in_millimetres = self.folder / "mm.obj"
        write_obj(in_millimetres, 1e3 * self.flat, self.sheet.coarse_triangles)
        with_vt = self.folder / "vt.obj"
        write_obj(with_vt, self.moved, self.sheet.coarse_triangles, self.rest)
        for garment, positions in (
                (homespun.Garment(self.cell, self.obj), self.flat),
                (homespun.Garment(self.cell, str(in_millimetres), unit=1e-3), self.flat),
                (homespun.Garment(self.cell, with_vt), self.moved),
                (homespun.Garment(self.cell, self.rest.tolist(),
                                  self.sheet.coarse_triangles.astype("i8")), self.flat)):
            self.assert_same_cloth(garment, self.moved, of_sheet)
            numpy.testing.assert_allclose(garment.coarse_positions, positions, atol=1e-12)
            numpy.testing.assert_array_equal(garment.coarse_triangles, self.sheet.coarse_triangles)
            self.assertEqual(numpy.bincount(garment.material).tolist(),
                             numpy.bincount(self.sheet.material).tolist())
            self.assertEqual(repr(garment), f"<homespun.Garment of {len(self.rest)} coarse vertices: "
                                            f"{2 * self.n**2} coarse triangles, "
                                            f"{len(self.sheet.triangles)} fine>")

    def test_vt_of_another_unit_are_asked_about_and_taken_as_told(self):
        of_sheet = homespun.Upsampler(self.cell, self.sheet).upsample(self.moved)
        size = self.n * SIDE
        normalised = self.folder / "normalised.obj"
        write_obj(normalised, self.flat, self.sheet.coarse_triangles, self.rest / size)
        self.refused(lambda: homespun.Garment(self.cell, normalised),
                     "normalised.obj: against its vt it is pressed together by 95 % in the mean; "
                     "expected 30 % at most: are positions and vt in metres? `vt_unit=0.05` makes "
                     "them fit where positions are, `unit=20` where vt is, `flat=True` takes x and "
                     "y of the rest mesh for the rest state; `accept_strain=True` goes on as it is",
                     kind=homespun.BadInput)
        for keywords in ({"vt_unit": size}, {"flat": True}):
            self.assert_same_cloth(homespun.Garment(self.cell, normalised, **keywords), self.moved,
                                   of_sheet)
        as_it_is = homespun.Garment(self.cell, normalised, accept_strain=True)
        self.assertAlmostEqual(as_it_is.vertices.max(), 1., delta=1e-9)

    def test_cells_begin_at_the_origin_and_turn_by_the_angle(self):
        garment = homespun.Garment(self.cell, self.obj, origin=(SIDE / 2, 0), angle=90)
        # Stripes of the cell across axis 1 now lie across axis 2, and begin with the soft one.
        centres = garment.vertices[garment.triangles].mean(axis=1)
        inside = (centres[:, 1] / SIDE % 1.0 < 0.5).astype(int)
        original = self.cell.vertices[self.cell.triangles].mean(axis=1)[:, 0] / SIDE < 0.5
        first = int(self.cell.material[original][0])
        numpy.testing.assert_array_equal(garment.material, numpy.where(inside, first, 1 - first))

    def test_frames_are_read_in_the_order_of_the_file(self):
        frame = self.folder / "frame.obj"
        write_obj(frame, self.moved, self.sheet.coarse_triangles)
        numpy.testing.assert_array_equal(homespun.read_positions(frame), self.moved)

    def test_a_skirt_is_closed_along_its_seams(self):
        garment = homespun.Garment(self.cell, SOURCE / "meshes/scenes/skirt.obj")
        edges = numpy.sort(garment.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        _, counts = numpy.unique(edges, axis=0, return_counts=True)
        self.assertLessEqual(counts.max(), 2)
        fine = homespun.Upsampler(self.cell, garment).upsample(garment.coarse_positions)
        boundary = fine[numpy.unique(edges[numpy.flatnonzero(numpy.isin(
            edges @ [1, len(fine)], (numpy.unique(edges, axis=0)[counts == 1]) @ [1, len(fine)]))])]
        # Waist and hem alone: z is that of either.
        ends = garment.coarse_positions[:, 2].min(), garment.coarse_positions[:, 2].max()
        self.assertLess(numpy.minimum(*(abs(boundary[:, 2] - z) for z in ends)).max(), 1e-6)

    def test_refusals(self):
        self.refused(lambda: homespun.Garment(self.cell, "nowhere.obj"), "nowhere.obj")
        for unit in (0., -1e-9, numpy.nan):
            for name in ("unit", "vt_unit"):
                self.refused(lambda: homespun.Garment(self.cell, self.obj, **{name: unit}),
                             f"{name}: found {unit}; expected metres per unit")
        self.refused(lambda: homespun.Garment(self.cell, self.obj, origin=[0.]), "origin: found")
        self.refused(lambda: homespun.Garment(self.cell, self.obj, angle=numpy.nan), "angle")
        bent = self.folder / "bent.obj"
        write_obj(bent, self.moved, self.sheet.coarse_triangles)
        self.refused(lambda: homespun.Garment(self.cell, bent), "bent.obj", "vt")
        self.refused(lambda: homespun.Garment(self.cell, self.obj, unit=1000.),
                     "which are 1400 cells; expected a hundred at most: is it in metres? "
                     "`unit=0.01` takes rest mesh and frames in centimetres",
                     "`accept_strain=True`")
        self.refused(lambda: homespun.Garment(self.cell, self.obj, unit=1000., accept_strain=True),
                     f"would be a fine mesh of {25000000 * len(self.cell.triangles)}; expected at "
                     "most max_triangles = 10000000", "is it in metres?")
        self.refused(lambda: homespun.Garment(self.cell, self.rest, self.sheet.coarse_triangles,
                                              max_triangles=10), "max_triangles = 10:")
        self.refused(lambda: homespun.Garment(self.cell, self.obj, unit=1e12, accept_strain=True),
                     f"cells: 2.5e+25 of {len(self.cell.triangles)} triangles would be a fine mesh")
        for origin in (1e15, -1e30, 1e300, 1e308):
            self.refused(lambda: homespun.Garment(self.cell, self.obj, origin=(origin, 0.)),
                         "cells from the origin of the cells; expected at most 1e9")
        upsampler = homespun.Upsampler(self.cell, homespun.Garment(self.cell, self.obj))
        self.refused(lambda: upsampler.upsample(self.moved[1:]), f"expected {len(self.moved)}")


if __name__ == "__main__":
    unittest.main()
