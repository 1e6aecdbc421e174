# SPDX-License-Identifier: MIT
"""Methods on one's own coarse positions: the same bits by `strain`, `upsample` and Python."""
import os
import subprocess
import sys
import unittest
import warnings

import h5py
import numpy

import homespun
from with_cell import BUILD, CELLS, COARSE, SOURCE, WithFolder, write_obj

sys.path.append(str(SOURCE / "verification/report"))
from read.vtu import read_vtu  # noqa: E402


def run(*arguments, status=(0,)):
    result = subprocess.run([BUILD / "homespun", *map(str, arguments)], check=False, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert result.returncode in status, result.stdout + result.stderr
    return result.stderr


class Methods(WithFolder):
    def kept(self, name, law, method):
        """Cell, coarse positions and what the study makes of them: strip-1 at 1 %, 3 x 3 cells."""
        output = self.folder / f"{name}-{law}"
        run("strain", COARSE / f"{name}.prm", "--cells", 3, "--loads", "strip-1", "--strains", 0.01,
            "--references", law, "--methods", f"affine,{method}", "--no-budget",
            "--no-runtime", "--no-report", "--keep", "--quiet", "--output", output, status=(0, 1, 4))
        with h5py.File(output / name / "fields-strip-1.h5") as file:
            self.assertEqual(file.attrs["method"].decode(), method)
            fine = file["upsampled"][:]
        with h5py.File(output / name / "positions" / f"strip-1-{law}-0.01.h5") as file:
            return homespun.Cell.read(output / name / "cell.h5"), file["coarse"][:], fine

    def test_from_kept_coarse_positions_come_the_fine_ones_of_the_study_to_the_last_bit(self):
        # Of layered quadratic modes, of the weave those that the study has fitted.
        for name, law, method in (("layered", "biot", "localized+modes"),
                                  ("layered", "green", "localized"),
                                  ("plain-weave-straight", "yarn", "localized+modes")):
            cell, coarse, expected = self.kept(name, law, method)
            upsampler = homespun.Upsampler(cell, homespun.Sheet(cell, 3, 3), method=method)
            fine = upsampler.upsample(coarse)
            self.assertEqual((fine.dtype, fine.shape), (numpy.float64, expected.shape))
            numpy.testing.assert_array_equal(fine, expected)
            # In space and single precision: 8 roundings of a position, halves of a last digit.
            in_space = upsampler.upsample(numpy.column_stack([coarse, 0. * coarse[:, 0]]))
            self.assertLess(numpy.abs(in_space[:, :2] - expected).max(),
                            8 * 2.**-24 * numpy.abs(expected).max())

    def test_under_the_linear_law_a_study_does_not_turn_cells_and_python_does(self):
        cell, coarse, expected = self.kept("layered", "linear", "localized")
        sheet = homespun.Sheet(cell, 3, 3)
        fine = homespun.Upsampler(cell, sheet, method="localized").upsample(coarse)
        distance = numpy.abs(fine - expected).max()
        # Second order in strain of what first order adds to the coarse motion.
        added = numpy.abs(fine - homespun.Upsampler(cell, sheet, method="affine").upsample(coarse)).max()
        self.assertGreater(distance, 0.001 * added)
        self.assertLess(distance, 0.02 * added)

    def test_upsample_and_python_give_the_same_bits_in_space(self):
        run("homogenize", CELLS / "three-stiffness.prm", "--no-bars", "--quiet", "--output",
            self.folder / "homogenize")
        cell_file = self.folder / "homogenize" / "cell.h5"
        cell = homespun.Cell.read(cell_file)
        sheet = homespun.Sheet(cell, 6, 6)
        flat = numpy.column_stack([sheet.coarse_vertices, numpy.zeros(49)])
        moved = flat * [1.04, 0.98, 1.]
        moved[:, 2] = 0.3 * flat[:, 0]**2 / 0.06
        moved[:, 0] += 0.2 * moved[:, 1]
        write_obj(self.folder / "rest.obj", flat, sheet.coarse_triangles)
        write_obj(self.folder / "moved.obj", moved, sheet.coarse_triangles)
        held = ["bottom", "top"]
        cases = [("full", False), ("full", True), ("full-edges", False), ("localized+edges", False),
                 ("affine", False)]
        for k, (method, has_slip) in enumerate(cases):
            output = self.folder / f"upsampled-{k}"
            said = run("upsample", cell_file, "--rest", self.folder / "rest.obj",
                       self.folder / "moved.obj", "--method", method, "--held", ",".join(held),
                       *["--slip"][:has_slip], "--output", output)
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                upsampler = homespun.Upsampler(cell, sheet, method=method, held=held,
                                               has_slip=has_slip)
            # What is left out is said once, in the same words.
            told = [line for line in said.splitlines() if "method" in line]
            self.assertEqual(told, [f"homespun: {one.message}" for one in caught])
            self.assertEqual(len(told), "full" in method)
            found = read_vtu(output / "moved.vtu")
            numpy.testing.assert_array_equal(found.points, upsampler.upsample(moved))
            numpy.testing.assert_array_equal(found.triangles, sheet.triangles)
            self.assertEqual("edges" in upsampler.terms, method in ("full", "localized+edges"))

    def test_a_rolled_sheet_is_met_between_its_coarse_vertices_with_its_normals(self):
        cell = homespun.homogenize(CELLS / "layered.prm", bars=False)
        sheet = homespun.Sheet(cell, 8, 3)
        radius = 5. * cell.lattice[0, 0]

        def rolled(points):
            angle = points[:, 0] / radius
            return (numpy.column_stack([radius * numpy.sin(angle), points[:, 1],
                                        radius * (1. - numpy.cos(angle))]),
                    numpy.column_stack([-numpy.sin(angle), 0. * angle, numpy.cos(angle)]))

        moved = rolled(sheet.coarse_vertices)[0]
        exact, exact_normals = rolled(sheet.vertices)
        flat = homespun.Upsampler(cell, sheet, method="affine").upsample(moved)
        upsampler = homespun.Upsampler(cell, sheet, method="affine+curved")
        self.assertEqual(upsampler.terms, ["curved"])
        normals = numpy.empty((upsampler.n_fine, 3), dtype=numpy.float32)
        fine = upsampler.upsample(moved, normals=normals)
        # kappa H^2 / 8; third order, of H / radius = 1/5.
        self.assertGreater(numpy.abs(flat - exact).max(), 0.9 * radius / 200.)
        self.assertLess(numpy.abs(fine - exact).max(), 0.05 * radius / 200.)
        self.assertLess(numpy.abs(normals - exact_normals).max(), 4e-3)  # (H / radius)^3 / 2
        localized = homespun.Upsampler(cell, sheet)
        with self.assertRaisesRegex(ValueError, "normals: the surface is that of flat triangles"):
            localized.upsample(moved, normals=normals)
        with self.assertRaisesRegex(ValueError, "no deflection of a bent sheet"):
            homespun.Upsampler(cell, sheet, method="localized+curved")

    def test_a_mesh_of_any_shape_takes_modes_and_no_edges(self):
        cell = homespun.homogenize(CELLS / "layered.prm", bars=False)
        rest = numpy.array([[0., 0.], [0.03, 0.], [0.032, 0.02], [0.001, 0.021]])
        garment = homespun.Garment(cell, rest, [[0, 1, 2], [0, 2, 3]], angle=20.)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            full = homespun.Upsampler(cell, garment, method="full-p2-cubic")
        self.assertIn("edges are left out, because no edge of a panel", str(caught[0].message))
        self.assertEqual(full.terms, ["modes", "micro"])
        moved = numpy.column_stack([rest * [1.05, 0.97], [0., 0.01, 0.003, 0.]])
        localized = homespun.Upsampler(cell, garment)
        distance = numpy.abs(full.upsample(moved) - localized.upsample(moved)).max()
        self.assertGreater(distance, 1e-7)  # second order in strain
        self.assertLess(distance, 1e-4)
        # The command gives the same bits.
        cell.write(self.folder / "layered.h5")
        for name, positions in (("garment", numpy.column_stack([rest, numpy.zeros(4)])),
                                ("frame-of-garment", moved)):
            write_obj(self.folder / f"{name}.obj", positions, numpy.array([[0, 1, 2], [0, 2, 3]]))
        run("upsample", self.folder / "layered.h5", "--rest", self.folder / "garment.obj",
            self.folder / "frame-of-garment.obj", "--method", "full", "--angle", 20, "--output",
            self.folder / "upsampled-garment")
        found = read_vtu(self.folder / "upsampled-garment" / "frame-of-garment.vtu")
        numpy.testing.assert_array_equal(found.points, full.upsample(moved))

    def test_a_panel_on_lattice_lines_takes_edges_where_it_lies_on_them(self):
        cell = homespun.homogenize(CELLS / "layered.prm", bars=False)
        side = cell.lattice[0, 0]
        rest = side * numpy.array([[0., 0.], [4., 0.], [3.3, 3.], [0., 3.]])
        triangles = numpy.array([[0, 1, 2], [0, 2, 3]])
        garment = homespun.Garment(cell, rest, triangles)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            upsampler = homespun.Upsampler(cell, garment, method="full-p2-cubic", held=["bottom"])
        told = [str(one.message) for one in caught]
        self.assertEqual(told, [
            "method full-p2-cubic: edges have layers at left (free) of panel 0; bottom (held) of "
            "panel 0; top (free) of panel 0; none along the 0 % of the outlines that are sewn and "
            "the 23 % that lie on no lattice line; curved is left out, because the cell has no "
            "deflection of a bent sheet"])
        self.assertEqual(upsampler.terms, ["edges", "modes", "micro"])
        moved = numpy.column_stack([rest * [1.05, 0.97], numpy.zeros(4)])
        fine = upsampler.upsample(moved)
        # A held edge is where it is held, away from its ends.
        on_edge = numpy.abs(garment.vertices[:, 1]) < 1e-9
        middle = on_edge & (numpy.abs(garment.vertices[:, 0] - 2. * side) < side)
        self.assertGreater(middle.sum(), 10)
        affine = homespun.Upsampler(cell, garment, method="affine").upsample(moved)
        largest = numpy.abs(fine - affine).max()
        self.assertLess(numpy.abs(fine - affine)[middle].max(), 0.01 * largest)
        # The command says the same, and gives the same bits.
        cell.write(self.folder / "layered-edges.h5")
        for name, positions in (("panel", numpy.column_stack([rest, numpy.zeros(4)])),
                                ("frame-of-panel", moved)):
            write_obj(self.folder / f"{name}.obj", positions, triangles)
        said = run("upsample", self.folder / "layered-edges.h5", "--rest",
                   self.folder / "panel.obj", self.folder / "frame-of-panel.obj", "--method",
                   "full-p2-cubic", "--held", "bottom", "--output", self.folder / "upsampled-panel")
        self.assertIn(f"homespun: {told[0]}", said.splitlines())
        found = read_vtu(self.folder / "upsampled-panel" / "frame-of-panel.vtu")
        numpy.testing.assert_array_equal(found.points, fine)

    def test_refusals_say_what_to_do(self):
        path = self.folder / "old.h5"
        subprocess.run([os.environ["HOMESPUN_MAKE_CELL"], path], check=True)
        cell = homespun.Cell.read(path)
        sheet = homespun.Sheet(cell, 2, 2)
        for choices, words in (
                ({"method": "fuller"}, "no preset is called `fuller`"),
                ({"method": "localized+modes"}, "make its cell.h5 again with `homespun homog"),
                ({"method": "localized+edges"}, "`held` does not say which edges on lattice"),
                ({"method": "localized+edges", "held": ["top"]}, "the cell has no terms of edges"),
                ({"held": ["upper"]}, "held: found `upper`")):
            with self.assertRaises(homespun.BadInput) as caught:
                homespun.Upsampler(cell, sheet, **choices)
            self.assertIn(words, str(caught.exception))
        rest = numpy.column_stack([sheet.coarse_vertices, numpy.zeros(9)])
        write_obj(self.folder / "old.obj", rest, sheet.coarse_triangles)
        write_obj(self.folder / "frame.obj", rest, sheet.coarse_triangles)
        for method, words in (("localized+modes", "make its cell.h5 again"),
                              ("localized+modes+modes", "the term modes is there twice")):
            said = run("upsample", path, "--rest", self.folder / "old.obj",
                       self.folder / "frame.obj", "--method", method, "--output",
                       self.folder / "refused", status=(2,))
            self.assertIn(words, said)
            self.assertFalse((self.folder / "refused").exists())


if __name__ == "__main__":
    unittest.main()
