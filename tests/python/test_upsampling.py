# SPDX-License-Identifier: MIT
"""Up-sampling from Python: what goes in, what is refused, and what a frame costs."""
import tracemalloc
import unittest

import numpy

import homespun
from with_cell import SIDE, WithCell, address, run_in_threads, turns_of_others, write_obj


class Upsampling(WithCell):
    n = 6

    def setUp(self):
        self.sheet = homespun.Sheet(self.cell, self.n, self.n)
        self.upsampler = homespun.Upsampler(self.cell, self.sheet)
        self.positions = numpy.zeros((self.upsampler.n_coarse, 3))
        self.positions[:, :2] = self.sheet.coarse_vertices

    def stretched(self, strain):
        moved = self.positions.copy()
        moved[:, 0] *= 1 + strain
        return moved

    def test_at_rest_the_fine_mesh_is_at_rest(self):
        fine = self.upsampler.upsample(self.positions)
        self.assertEqual((fine.dtype, fine.shape), (numpy.float32, (self.upsampler.n_fine, 3)))
        # Positions are single.
        numpy.testing.assert_allclose(fine[:, :2], self.sheet.vertices,
                                      atol=2 * numpy.finfo("f4").eps * self.n * SIDE)

    def test_stretch_adds_chi(self):
        strain = 0.01
        fine = self.upsampler.upsample(self.stretched(strain))
        affine = homespun.Upsampler(self.cell, self.sheet, method="affine").upsample(
            self.stretched(strain))
        fluctuation = (fine - affine)[:, 0]
        # w = −E11 chi_11, chi a tent of the soft stripe's slope, 1 − C11/D11, over half a cell.
        D = 500 / (1 - 0.3**2)
        height = strain * abs(1 - self.cell.stiffness[0, 0] / D) * SIDE / 2
        self.assertAlmostEqual(abs(fluctuation).max() / height, 1., 3)

    def test_out_is_written_where_it_lies(self):
        out = numpy.empty((self.upsampler.n_fine, 3), dtype=numpy.float32)
        place = address(out)
        given = self.upsampler.upsample(self.stretched(0.02), out=out)
        self.assertIs(given, out)
        self.assertEqual(address(given), place)
        numpy.testing.assert_array_equal(out, self.upsampler.upsample(self.stretched(0.02)))

    def test_positions_that_fit_are_read_where_they_lie(self):
        out = numpy.empty((self.upsampler.n_fine, 3), dtype=numpy.float32)
        # NumPy reports its buffers to tracemalloc.
        for positions, copies in ((self.positions, 0), (self.positions.astype("f4"), 1)):
            tracemalloc.start()
            self.upsampler.upsample(positions, out=out)
            taken = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            self.assertEqual(taken >= self.positions.nbytes, bool(copies))
            self.assertLess(taken, copies * self.positions.nbytes + 1000)

    def test_whatever_numpy_takes_for_numbers_is_taken(self):
        good = self.stretched(0.02)
        whole = numpy.round(good / SIDE)
        upsample = self.upsampler.upsample
        for given, same in (
                (good.tolist(), good), (tuple(map(tuple, good)), good),
                (numpy.asfortranarray(good), good), (good[::-1].copy()[::-1], good),
                (numpy.repeat(good, 2, axis=0)[::2], good), (good.astype(">f8"), good),
                (good.astype("f4"), good.astype("f4").astype("f8")), (whole.astype("i8"), whole)):
            numpy.testing.assert_array_equal(upsample(given), upsample(same))

    def test_refusals_name_argument_dtype_and_shape(self):
        good = self.positions
        out = numpy.zeros((self.upsampler.n_fine, 3), dtype=numpy.float32)
        upsample = self.upsampler.upsample
        self.refused(lambda: upsample(good[:, :1].copy()), "positions", "(n, 3)", f"({len(good)}, 1)")
        self.refused(lambda: upsample(good[:-1]), f"have {len(good) - 1} rows; expected {len(good)}")
        self.refused(lambda: upsample(good.astype(str)), "positions: found a ndarray of <U",
                     "expected numbers of the shape (n, 3)")
        self.refused(lambda: upsample(good * 1j), "positions", "complex128")
        self.refused(lambda: upsample([[0, 0], [0]]), "positions: found a list", "(n, 3)")
        self.refused(lambda: upsample(None), "positions: found a NoneType", "(n, 3)")
        # What is written into is never converted.
        self.refused(lambda: upsample(good, out=out.astype("f8")), "out", "float64", "float32")
        self.refused(lambda: upsample(good, out=numpy.asfortranarray(out)), "out", "contiguous")
        self.refused(lambda: upsample(good, out=out.tolist()), "out: found a list", "(n, 3)")
        self.refused(lambda: upsample(good, out=out[:-1]), f"expected {len(out)}")
        out.flags.writeable = False
        self.refused(lambda: upsample(good, out=out), "out: is read-only")
        bad = good.copy()
        bad[3, 1] = numpy.nan
        self.refused(lambda: upsample(bad), "positions: found nan at [3, 1]; expected finite")
        bad[3, 1] = -numpy.inf
        self.refused(lambda: upsample(bad.astype("f4")), "positions: found -inf at [3, 1]")

    def test_others_run_meanwhile(self):
        sheet = homespun.Sheet(self.cell, 150, 150)
        upsampler = homespun.Upsampler(self.cell, sheet)
        file = self.folder / "sheet.obj"
        write_obj(file, numpy.pad(sheet.coarse_vertices, ((0, 0), (0, 1))), sheet.coarse_triangles)

        def in_plane():
            """Makes what up-samples in the plane, and nothing else."""
            self.refused(lambda: upsampler.upsample(sheet.coarse_vertices, out=sheet.vertices),
                         "out: is read-only")

        for call in (lambda: homespun.Sheet(self.cell, 150, 150),
                     lambda: homespun.Upsampler(self.cell, sheet), in_plane,
                     lambda: homespun.read_positions(file)):
            # On processors that do other work, too, a call may end before the others come to run.
            self.assertTrue(any(turns_of_others(call) > 3 for _ in range(20)))

    def test_sheets_may_be_made_in_many_threads(self):
        # pybind11 has a list of all objects, which is changed with the interpreter held.
        run_in_threads("cell = homespun.Cell.read(sys.argv[1])\n"
                       "def work():\n"
                       "    for _ in range(20000):\n"
                       "        homespun.Sheet(cell, 1, 1)", self.file, n=8)

if __name__ == "__main__":
    unittest.main()
