# SPDX-License-Identifier: MIT
"""Pictures show what they are of: colours of phases, displaced cells, what is in front, numbers."""
import subprocess
import sys
import unittest

import matplotlib
import numpy

import homespun
from homespun import plot
from with_cell import WithCell

matplotlib.use("Agg")

COLUMNS = [("load", "U16"), ("strain", float), ("reference", "U8"), ("method", "U16"),
           ("error_mean_m", float), ("error_mean_per_cell", float), ("error_bar_m", float)]


def polygons(figure):
    """The corners and the colours of the triangles that were drawn first, in their order."""
    (drawn,) = figure.axes[0].collections
    corners = numpy.array([path.vertices[:3] for path in drawn.get_paths()])
    return corners, drawn.get_facecolors()[:, :3]


class Mesh:
    """Two triangles, one above the other in space."""
    vertices = numpy.array([[0., 0.], [1., 0.], [0., 1.], [0., 0.], [1., 0.], [0., 1.]])
    triangles = numpy.array([[0, 1, 2], [3, 4, 5]], dtype=numpy.int32)
    material = numpy.array([0, 1], dtype=numpy.int32)


class Pictures(WithCell):
    def tearDown(self):
        matplotlib.pyplot.close("all")

    def test_importing_loads_no_matplotlib(self):
        subprocess.run([sys.executable, "-B", "-c", "import sys, homespun.plot\n"
                        "assert 'matplotlib' not in sys.modules"], check=True)

    def test_a_cell_has_a_colour_for_each_phase(self):
        figure = plot.cell(self.cell)
        corners, colours = polygons(figure)
        numpy.testing.assert_allclose(corners, 1e3 * self.cell.vertices[self.cell.triangles])
        self.assertEqual(figure.axes[0].get_xlabel(), "x [mm]")
        brightness = [colours[self.cell.material == phase].mean(axis=1) for phase in (0, 1)]
        self.assertGreater(brightness[0].min(), brightness[1].max() + 0.2)

    def test_chi_is_drawn_where_a_stretched_cell_is(self):
        figure = plot.chi(self.cell)
        corners, _ = polygons(figure)
        # Stretched along axis 1 stripes stay straight, and the soft one stretches by more: there
        # are two slopes, of which the mean is that of the cell.
        x, moved = self.cell.vertices[self.cell.triangles][:, :, 0], corners[:, :, 0] / 1e3
        slopes = numpy.ptp(moved, axis=1) / numpy.ptp(x, axis=1) - 1.0
        D = numpy.array([500., 5000.]) / (1 - 0.3**2)
        expected = plot.SHOWN_STRAIN * self.cell.stiffness[0, 0] / D
        numpy.testing.assert_allclose(slopes, expected[self.cell.material], atol=1e-9)
        figure.savefig(self.folder / "chi.png")

    def test_what_is_nearer_to_the_viewer_is_drawn_last(self):
        for height, order in ((0.1, [0, 1]), (-0.1, [1, 0])):
            positions = numpy.column_stack([Mesh.vertices, [0., 0., 0.] + [height] * 3])
            corners, colours = polygons(plot.sheet(Mesh(), positions, elevation=90., azimuth=-90.))
            # From above, x to the right and y up.
            numpy.testing.assert_allclose(corners[order.index(1)], Mesh.vertices[:3], atol=1e-12)
            self.assertEqual(numpy.argmax(colours.mean(axis=1)), order.index(0))

    def test_a_sheet_is_seen_from_the_side_as_it_hangs(self):
        sheet = homespun.Sheet(self.cell, 3, 4)
        positions = numpy.column_stack([sheet.vertices[:, 0], 0. * sheet.vertices[:, 0],
                                        sheet.vertices[:, 1]])
        corners, _ = polygons(plot.sheet(sheet, positions, elevation=0., azimuth=-90.))
        numpy.testing.assert_allclose(numpy.ptp(corners.reshape(-1, 2), axis=0), [0.03, 0.04])
        flat, _ = polygons(plot.sheet(sheet))
        numpy.testing.assert_allclose(flat, 1e2 * sheet.vertices[sheet.triangles])
        with self.assertRaisesRegex(ValueError, r"positions: found the shape \(5, 3\); expected"):
            plot.sheet(sheet, numpy.zeros((5, 3)))

    def test_a_picture_that_would_fill_the_memory_is_refused(self):
        mesh = Mesh()
        mesh.triangles = numpy.broadcast_to(Mesh.triangles[:1], (plot.MOST_TRIANGLES + 1, 3))
        mesh.material = numpy.broadcast_to(Mesh.material[:1], plot.MOST_TRIANGLES + 1)
        with self.assertRaisesRegex(ValueError, "found 4000001 triangles; expected at most 4000000"):
            plot.sheet(mesh)

    def test_curves_have_the_numbers_of_the_table(self):
        rows = [(load, strain, law, method, 0.01 * error, error, 1e-4 * strain)
                for load in ("strip-1", "periodic-11") for law in ("linear", "biot")
                for strain in (0.01, 0.1)
                for method, error in (("affine", strain), ("localized", strain**2),
                                      ("full", 1e-14 if load == "periodic-11" else strain**3))]
        table = numpy.array(rows, dtype=COLUMNS)
        figure = plot.strain(table)
        first, second = figure.axes
        self.assertEqual([one.get_title() for one in (first, second)], ["strip-1", "periodic-11"])
        self.assertEqual([line.get_label() for line in first.lines],
                         ["coarse mesh alone", "paper", "full"])
        for line, power in zip(first.lines, (1, 2, 3)):
            numpy.testing.assert_allclose(line.get_xdata(), [1., 10.])
            numpy.testing.assert_allclose(line.get_ydata(), numpy.array([0.01, 0.1])**power)
        # The bar of the smallest error, in cell sides: 1e-4 strain / 0.01.
        band = first.collections[0].get_paths()[0].vertices
        self.assertAlmostEqual(band[:, 1].max() / 1e-3, 1.)
        self.assertTrue(numpy.isnan(second.lines[2].get_ydata()).all())
        self.assertIn("full: round-off", [text.get_text() for text in second.texts])
        with self.assertRaisesRegex(ValueError, "methods: found best; expected some of affine, l"):
            plot.strain(table, methods=["best"])
        with self.assertRaisesRegex(ValueError, "law: found yarn; expected one of linear, biot"):
            plot.strain(table, law="yarn")
        with self.assertRaisesRegex(ValueError, "table: has no column error_bar_m, error_mean_m"):
            plot.strain(table[["load", "strain", "reference", "method", "error_mean_per_cell"]])


if __name__ == "__main__":
    unittest.main()
