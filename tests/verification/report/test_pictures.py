# SPDX-License-Identifier: MIT
"""Tests of what pictures must not do: flip colours, lose outlines, draw round-off, flatten curves,
write ticks that are all alike.
"""
import math
import os
import shutil
import tempfile
import unittest
from unittest import mock

import numpy
from matplotlib import pyplot

import report_path  # noqa: F401
import browser
from figures import plot_data, style
from figures.cell import phase_legend
from figures.cloth import phase_colour_map
from figures.drape import energy_figure
from figures.sheet import hole_edges
from figures.stiffness import RIM, polar_figure
from made_up_study import LAMINATE, square_mesh
from page import gallery, page
from read.cell_results import Cell
from read.vtu import Surface

HARD_FIRST = [{"name": "hard", "E1": 1e7}, {"name": "soft", "E1": 1e6}]


class PhaseTest(unittest.TestCase):
    def test_a_phase_has_one_colour_in_the_cell_and_in_the_cloth(self):
        """Light is soft, whatever the numbers of the materials are."""
        material = numpy.array([0, 1])
        cell = Cell("a", phases=HARD_FIRST, material=material)
        of_cell = {label: colour for _, colour, label in phase_legend(cell)}
        surface = Surface(
            numpy.zeros((3, 3)), numpy.array([[0, 1, 2]] * 2), cell_data={"material": material}
        )
        of_cloth = phase_colour_map([surface], ["hard", "soft"], [1e7, 1e6])

        def lightness(colour):
            return sum(style.colors.to_rgb(colour))

        self.assertGreater(lightness(of_cell["soft"]), lightness(of_cell["hard"]))
        self.assertGreater(sum(of_cloth[1][0]), sum(of_cloth[0][0]))
        self.assertEqual((of_cloth[0][1], of_cloth[1][1]), ("hard", "soft"))
        self.assertEqual(
            style.colours_of_materials([0, 1], [1e7, 1e6]),
            {0: of_cell["hard"], 1: of_cell["soft"]},
        )

    def test_a_picture_with_one_of_two_phases_keeps_its_colour(self):
        both = style.colours_of_materials([0, 1], [1e6, 1e7])
        self.assertEqual(style.colours_of_materials([1], [1e6, 1e7])[1], both[1])

    def test_materials_of_triangles_are_sharp(self):
        material = numpy.array([0, 1, 1, 0])
        surface = Surface(
            numpy.zeros((6, 3)), numpy.zeros((4, 3), int), {}, {"material": material}
        )
        numpy.testing.assert_array_equal(surface.material(), material)

    def test_the_outline_of_a_hole_is_drawn_and_the_cut_of_the_close_up_is_not(self):
        _, triangles, _ = square_mesh(4, 1.0)
        hole = [10, 11]  # the two triangles of one square
        holed = numpy.delete(triangles, hole, axis=0)
        near = holed[2:20]
        edges = {tuple(edge) for edge in hole_edges(holed, near)}
        ring = {tuple(sorted(edge)) for edge in ((6, 7), (7, 12), (11, 12), (6, 11))}
        self.assertLessEqual(ring, edges)
        inner = {tuple(sorted(edge)) for t in holed for edge in zip(t, numpy.roll(t, 1))}
        border = {e for e in inner if all(v % 5 in (0, 4) or v < 5 or v > 19 for v in e)}
        self.assertLessEqual(edges - ring, border)


class CurveTest(unittest.TestCase):
    def motion(self, **energies):
        return [
            {
                "member": "biot",
                "time_s": time,
                "kinetic_J": 1e-3 * time,
                "elastic_J": math.nan,
                "gravity_J": 0.0,
                "max_stretch": 1.0 + 1e-7 * time,
                **{key: value * time for key, value in energies.items()},
            }
            for time in (0.1, 0.2, 0.3)
        ]

    def test_an_energy_of_round_off_is_not_drawn_as_physics(self):
        figure, zero = energy_figure(self.motion(elastic_J=1e-20))
        self.addCleanup(pyplot.close, figure)
        self.assertEqual(zero, ["elastic energy"])
        self.assertNotIn("elastic energy [J]", [axes.get_ylabel() for axes in figure.axes])
        other, zero = energy_figure(self.motion(elastic_J=1e-12))
        self.addCleanup(pyplot.close, other)
        self.assertEqual(zero, [])

    def test_ticks_of_a_quantity_that_hardly_changes_differ(self):
        figure, _ = energy_figure(self.motion())
        self.addCleanup(pyplot.close, figure)
        figure.draw_without_rendering()
        axes = next(a for a in figure.axes if a.get_ylabel().startswith("largest stretch"))
        texts = [label.get_text() for label in axes.get_yticklabels()]
        self.assertEqual(len(set(texts)), len(texts))

    def test_a_bound_far_beyond_does_not_flatten_the_stiffness(self):
        cell = Cell(
            "a", homogenize={"C": LAMINATE.tolist(), "voigt": (50.0 * LAMINATE).tolist()}
        )
        figure = polar_figure(cell)
        self.addCleanup(pyplot.close, figure)
        axes = figure.axes[0]
        largest = max(
            numpy.nanmax(line.get_ydata()) for line in axes.lines if line.get_label() == "$C^H$"
        )
        self.assertLess(axes.get_ylim()[1], 1.3 * RIM * largest)
        labels = [line.get_label() for line in axes.lines]
        self.assertTrue(any("beyond the rim, up to" in label for label in labels))

    def test_words_at_a_point_are_read_back_for_the_page(self):
        figure, axes = pyplot.subplots()
        self.addCleanup(pyplot.close, figure)
        axes.plot([1.0, 2.0], [1.0, 4.0], label="error")
        axes.annotate("2", (2.0, 4.0), xytext=(3, -2), textcoords="offset points", va="center")
        (word,) = plot_data.panels_of(figure)[0]["words"]
        self.assertEqual((word["text"], word["at"], word["shift"]), ("2", [2.0, 4.0], [3.0, -2.0]))


class GalleryTest(unittest.TestCase):
    def test_each_figure_has_its_own_files_whichever_process_saves_it_and_a_fault_is_raised(self):
        def add(name, style):
            figure, axes = pyplot.subplots()
            axes.plot([1.0, 2.0], [1.0, 2.0], label=f"curve of {name}", drawstyle=style)
            return made.add(figure, name, "")

        for cores in (1, 2):
            folder = tempfile.mkdtemp()
            self.addCleanup(shutil.rmtree, folder)
            with mock.patch.object(os, "sched_getaffinity", return_value=range(cores)):
                made = gallery.Gallery(folder)
                pictures = [add(name, "default") for name in "abcde"]
                made.finish()
                for picture in pictures:
                    self.assertIn(f"curve of {picture.name}", picture.plot)
                self.assertEqual(sorted(os.listdir(folder)),
                                 [f"{name}.{kind}" for name in "abcde" for kind in ("csv", "svg")])
                with self.assertRaisesRegex(ValueError, "`curve of steps` is drawn with"):
                    add("steps", "steps-post")
                    made.finish()


@unittest.skipUnless(browser.CHROMIUM, "needs chromium")
class TickTest(unittest.TestCase):
    def test_ticks_of_the_page_differ_and_are_round(self):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        with open(os.path.join(folder, "page.html"), "w", encoding="utf-8") as file:
            file.write(f"<h1>a</h1><script>{page.own('plot_style.js')}</script>")
        script = """when((page) => page.querySelector("h1"), (page, their) => send(their.eval(`
          [[1, 1.0000001, 1.0000002], [0, 0.5, 1], [100000, 100001, 100002], [-0.02, 0, 0.02]].map(
            (ticks) => ticks.map((tick) => plot_style.linear_tick(tick, ticks))).concat([
          plot_style.log_ticks(5.411e-7, 9.3e-7), plot_style.log_ticks(1.1, 1.4)])`)));"""
        (near, plain, large, around, narrow, narrower), _ = browser.ask(
            folder, "page.html", script
        )
        for texts in (near, plain, large, around):
            self.assertEqual(len(set(texts)), 3, texts)
        self.assertEqual(plain, ["0", "0.5", "1"])
        self.assertEqual(near[1:], ["+10⁻⁷", "+2 × 10⁻⁷"])
        self.assertEqual(around[1], "0")
        for ticks in (narrow, narrower):
            self.assertGreaterEqual(len(ticks), 2)
            for tick in ticks:
                self.assertAlmostEqual(tick, float(f"{tick:.2g}"), delta=1e-9 * tick)


if __name__ == "__main__":
    unittest.main()
