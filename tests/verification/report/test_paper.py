# SPDX-License-Identifier: MIT
"""Tests of figures for a paper: their width, letters, text, dashes, ends of axes and refusals."""
import contextlib
import io
import os
import re
import unittest
from types import SimpleNamespace

import numpy
import report_path  # noqa: F401
import report
from figures import paper
from figures.cell import axes_of_materials, patches
from made_up_study import write_results
from matplotlib import pyplot
from page_case import PageTest

CENTIMETRE = 72.0 / 2.54  # points


def rows(*methods):
    return [
        {"load": load, "strain": strain, "reference": "biot", "method": method,
         "error_mean_per_cell": (1.0 + k) * strain**2, "error_mean_m": 0.01 * (1.0 + k) * strain**2,
         "reference_uncertainty_m": 1e-4 * strain**2}
        for load in ("strip-1", "shear-frame")
        for k, method in enumerate(methods)
        for strain in (0.0015, 0.01, 0.15)
    ]


class PaperTest(PageTest):
    def setUp(self):
        super().setUp()
        write_results(self.folder)

    def figure(self, *options):
        """(exit status, text on stdout, on stderr)"""
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            status = report.main([self.folder, "--output", self.output, *options])
        return status, out.getvalue(), errors.getvalue()

    def text_of(self, name):
        with open(os.path.join(self.output, name), encoding="latin-1") as file:
            return file.read()

    def test_a_figure_has_its_width_letters_of_7_to_9_points_and_text_as_text(self):
        status, out, errors = self.figure("--figure", "strain", "--loads", "shear-frame", "--width",
                                          "8.5cm", "--format", "svg,pdf")
        self.assertEqual((status, errors), (0, ""))
        self.assertEqual(out.split(), [os.path.join(self.output, f"stripes-strain.{kind}")
                                       for kind in ("svg", "pdf")])
        svg = self.text_of("stripes-strain.svg")
        width = float(re.search(r'<svg[^>]*\bwidth="([\d.]+)pt"', svg)[1])
        self.assertAlmostEqual(width, 8.5 * CENTIMETRE, places=2)
        sizes = [float(size) for size in re.findall(r"font: (?:\d+ )?([\d.]+)px", svg)]
        self.assertGreater(len(sizes), 8)
        self.assertTrue(all(7.0 <= size <= 9.0 for size in sizes), sizes)
        for words in ("strain [%]", "coarse mesh", "paper", "mean error [% of cell side]"):
            self.assertRegex(svg, rf"<text[^>]*>{re.escape(words)}</text>")
        pdf = self.text_of("stripes-strain.pdf")
        box = [float(v) for v in re.search(r"/MediaBox \[ ([\d. ]+) \]", pdf)[1].split()]
        self.assertAlmostEqual(box[2] - box[0], 8.5 * CENTIMETRE, places=1)
        self.assertRegex(pdf, "/Subtype /(TrueType|Type0|CIDFontType2)")
        self.assertNotIn("/Type3", pdf)
        self.assertFalse(os.path.exists(os.path.join(self.output, "report.html")))

    def test_cells_and_stiffness_are_drawn_too(self):
        for name in ("cell", "stiffness"):
            self.assertEqual(self.figure("--figure", name, "--format", "svg")[0], 0)
            sizes = re.findall(r"font: (?:\w+ )?(?:\d+ )?([\d.]+)px",
                               self.text_of(f"stripes-{name}.svg"))
            self.assertTrue(sizes and all(7.0 <= float(size) <= 9.0 for size in sizes), sizes)

    def test_what_cannot_be_drawn_is_refused_by_its_option(self):
        for options, words in (
            (("--figure", "strains"), "--figure: found `strains`, expected strain, stiffness, cell"),
            (("--figure", "strain", "--width", "8.5"), "--width: found `8.5`, expected 4cm to 40cm"),
            (("--figure", "strain", "--width", "85cm"), "--width: found `85cm`"),
            (("--figure", "strain", "--format", "eps"), "--format: found `eps`, expected pdf, svg"),
            (("--figure", "strain", "--loads", "strip-9"), "stripes has no `strip-9`, expected"),
        ):
            status, _, errors = self.figure(*options)
            self.assertEqual(status, 2)
            self.assertIn(words, errors)
            self.assertFalse(os.path.exists(self.output))


class DrawnTest(unittest.TestCase):
    def test_axes_end_on_round_numbers_and_curves_differ_without_colour(self):
        names = ["coarse mesh", "paper", "coarse cloth of homespun", "homespun"]
        figure = paper.strain_figure(rows(*names), names, "biot", 0.01, 17.0 * paper.CM)
        self.addCleanup(pyplot.close, figure)
        drawn = [axes for axes in figure.axes if axes.get_title(loc="left")]
        self.assertEqual([axes.get_title(loc="left") for axes in drawn], ["strip-1", "shear-frame"])
        for axes in drawn:
            self.assertEqual([round(end, 9) for end in axes.get_xlim()], [0.1, 20.0])
            for end in numpy.log10(axes.get_ylim()):
                self.assertAlmostEqual(end, round(end))
            looks = {(line.get_linestyle(), line.get_marker()) for line in axes.get_lines()
                     if not line.get_label().startswith("_")}
            self.assertEqual(len(looks), 4)
        self.assertAlmostEqual(figure.get_figwidth(), 17.0 / 2.54)

    def test_round_ends_are_1_2_or_5(self):
        for ends, expected in (((0.15, 15.0), (0.1, 20.0)), ((0.1, 10.0), (0.1, 10.0)),
                               ((0.3, 4.0), (0.2, 5.0)), ((6.0, 60.0), (5.0, 100.0))):
            numpy.testing.assert_allclose(paper.round_ends(*ends), expected)

    def test_each_patch_of_a_material_with_axes_has_one_line_along_its_first_axis(self):
        grid = numpy.array([[x, y] for y in (0.0, 1.0) for x in range(4)], dtype=float)
        triangles = numpy.array([t for i in range(3) for t in ([i, i + 1, i + 5], [i, i + 5, i + 4])])
        material = numpy.array([0, 0, 1, 1, 0, 0])
        cell = SimpleNamespace(vertices=grid, triangles=triangles, material=material, side=2.0)
        cell.phases = [{"E1": 2.0, "E2": 1.0, "angle": 90.0}, {"E1": 1.0, "E2": 1.0, "angle": 0.0}]
        self.assertEqual(len(numpy.unique(patches(cell))), 3)
        segments = axes_of_materials(cell)
        self.assertEqual(len(segments), 2)
        along = segments[:, 1] - segments[:, 0]
        numpy.testing.assert_allclose(along[:, 0], 0.0, atol=1e-12)
        self.assertTrue((along[:, 1] > 0.1).all())


if __name__ == "__main__":
    unittest.main()
