# SPDX-License-Identifier: MIT
"""Tests of what every page must be: whole, small, alone, with its numbers; and of what stands in
its plots and views.
"""
import csv
import glob
import math
import os
import re
import unittest
import urllib.parse
from unittest import mock

import numpy
from matplotlib import pyplot

import report_path  # noqa: F401
import browser
import page_checks
from figures import plot_data, style, view_data
from figures.decimation import area_of, decimate
from made_up_drape import write_drape
from made_up_study import square_mesh, write_results
from page import gallery, page_size
from page import page as whole_page
from page_case import OnePageTest, PageTest, draw_small_cloth

HAS_CHART = os.path.isfile(whole_page.CHART)
ACTIONS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "page_actions.js")


class WholePageTest(OnePageTest):
    """One page of a strain study and a scene."""

    def made(self):
        draw_small_cloth(self.addCleanup)
        write_results(self.folder)
        scene = os.path.join(self.place, "scene")
        write_drape(scene)
        return self.folder, scene

    def test_every_figure_has_its_downloads(self):
        self.assertGreater(self.text.count("<figure "), 10)
        for name in (
            "error-strain",
            "error-strain-fluctuation",
            "variants",
            "run-time",
            "load-step",
            "directional-modulus",
            "cell",
            "characteristic-displacements",
            "sheet-shear-frame",
            "error-time",
        ):
            self.assertIn(f'<figure id="stripes-{name}"', self.text)
        self.assertEqual(page_checks.figures_without_downloads(self.text, self.made_in), [])

    def test_no_reader_sees_a_backtick(self):
        self.assertEqual(page_checks.with_backticks(self.text), [])
        self.assertIn("<code>homespun verify</code>", self.text)
        planted = '<p>`a`</p><img alt="`b`"><script>`c`</script>'
        self.assertEqual(page_checks.with_backticks(planted), ["`a`", "`b`"])
        self.assertEqual(
            whole_page.with_code('<p title="`a`">`b` &lt; <i>`</i></p><img src="<svg>`d`</svg>"><script>`c`</script>'),
            '<p title="`a`"><code>b</code> &lt; <i>`</i></p><img src="<svg>`d`</svg>">'
            "<script>`c`</script>",
        )

    def test_every_curve_can_be_seen_on_a_dark_page(self):
        def luminance(colour):
            parts = (int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5))
            linear = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts)
            return sum(weight * c for weight, c in zip((0.2126, 0.7152, 0.0722), linear))

        lighter = dict(re.findall(r'"(#\w{6})": "(#\w{6})"', whole_page.own("plot_style.js")))
        shown = {curve.get("colour", "#888888").lower() for panels in page_checks.data_of(self.text, "plot-data")
                 for panel in panels for curve in panel["curves"] if not curve.get("fill")}
        shown |= {colour.lower() for colour in (*style.COLOUR_NAMES, *style.SPARE_COLOURS, *style.OWN_COLOURS)}
        self.assertIn("#332288", shown)
        ground = luminance("#14171a")  # of report.css
        for colour in shown:  # 3:1 is what WCAG 2.1, 1.4.11, asks of graphics
            with self.subTest(colour=colour):
                seen = luminance(lighter.get(colour, colour))
                self.assertGreater((seen + 0.05) / (ground + 0.05), 3.0)

    def test_nothing_is_fetched(self):
        self.assertEqual(page_checks.fetched(self.text), [])
        self.assertEqual(
            page_checks.fetched('<link href="https://a/b.css"><a href="https://c">c</a>'),
            ["https://a/b.css"],
        )

    def test_page_is_below_its_limit(self):
        self.assertLess(len(self.text.encode()), page_checks.LIMIT_BYTES)

    def test_all_numbers_of_the_plots_are_finite(self):
        plots = page_checks.data_of(self.text, "plot-data")
        self.assertGreater(len(plots), 5)
        for panel in (panel for panels in plots for panel in panels):
            self.assertTrue(panel["x"]["label"] and panel["y"]["label"], panel["title"])
            for curve in panel["curves"]:
                for point in curve.get("points", []):
                    self.assertTrue(all(value is None or math.isfinite(value) for value in point))
            for key in "xy":
                low, high = panel[key]["range"]
                self.assertLess(low, high)
                self.assertTrue(low > 0 or not panel[key]["log"])

    def test_csv_files_hold_finite_numbers_under_their_header(self):
        files = glob.glob(os.path.join(self.made_in, "figures", "*.csv"))
        self.assertGreater(len(files), 10)
        for path in files:
            with open(path, encoding="utf-8", newline="") as file:
                header, *rows = csv.reader(file)
            self.assertTrue(rows, path)
            for row in rows:
                self.assertEqual(len(row), len(header), path)
                self.assertNotIn("nan", row, path)
                self.assertNotIn("inf", row, path)
            self.assertEqual(page_checks.nameless_numbers(path), [], path)

    def test_error_that_is_round_off_is_zero_in_the_csv_file(self):
        with open(
            os.path.join(self.made_in, "figures", "stripes-error-strain.csv"),
            encoding="utf-8",
            newline="",
        ) as file:
            rows = [
                row
                for row in csv.DictReader(file)
                if row["panel"] == "periodic-22" and "localized" in row["series"]
            ]
        self.assertEqual(
            [(row["note"], float(row["y"])) for row in rows], [(plot_data.ROUND_OFF_NOTE, 0.0)] * 3
        )

    def test_views_hold_positions_within_their_bits(self):
        views = page_checks.data_of(self.text, "view-data")
        self.assertEqual(len(views), 2)  # the sheet and the scene
        sheet = view_data.unpacked(next(view for view in views if not view["times"]))
        self.assertEqual(sheet["upsampled"].shape, (1, 25, 2))
        numpy.testing.assert_allclose(sheet["difference"], 1e-5, rtol=1e-4)
        self.assertLess(sheet["triangles"].max(), 25)
        self.assertGreater(len(next(view for view in views if view["times"])["times"]), 1)

    @unittest.skipUnless(browser.CHROMIUM and HAS_CHART, "needs chromium and libjs-chart.js")
    def test_a_browser_draws_plots_and_a_view_without_a_fault(self):
        script = """when((page) => page.querySelector(".view[data-ready]"), (page) => send({
          theme: page.documentElement.dataset.theme, plots: page.querySelectorAll(".plot").length,
          corners: [...page.querySelectorAll(".view")].map((view) => view.dataset.ready) }));"""
        found, messages = browser.ask(self.made_in, "report.html?theme=dark&view=1", script)
        self.assertFalse(re.findall(r"CONSOLE.*(?:Error|error).*", messages))
        self.assertEqual(found["theme"], "dark")
        self.assertEqual(found["plots"], len(page_checks.data_of(self.text, "plot-data")))
        # Corners of all triangles of the sheet, which comes before the scene.
        self.assertEqual([corners for corners in found["corners"] if corners], [str(3 * 32)])

    @unittest.skipUnless(browser.CHROMIUM and HAS_CHART, "needs chromium and libjs-chart.js")
    def test_page_does_not_scroll_sideways_on_a_phone(self):
        script = """when((page) => page.querySelector(".plot canvas"), ({ documentElement: its }) =>
          setTimeout(() => send([its.scrollWidth, its.clientWidth]), 1000));"""
        (needed, shown), _ = browser.ask(self.made_in, "report.html", script, width=390)
        self.assertGreater(shown, 300)
        self.assertEqual(needed, shown)

    @unittest.skipUnless(browser.CHROMIUM and HAS_CHART, "needs chromium and libjs-chart.js")
    def test_a_reader_hovers_switches_curves_and_axes_and_saves_what_the_file_holds(self):
        with open(ACTIONS, encoding="utf-8") as file:
            found, _ = browser.ask(self.made_in, "report.html?view=1", file.read())
        self.assertEqual(found["faults"], [])
        self.assertIn("up-sampled − reference × 10 (exaggerated)", found["sliders"])
        self.assertEqual((found["hidden"], found["axis"]), (["affine against biot"], "linear"))
        self.assertEqual(
            found["beside_the_pointer"],
            ["localized against biot", "strain: 1 %", "mean error: 8 × 10⁻⁵ cell sides"],
        )
        with open(
            os.path.join(self.made_in, "figures", "stripes-error-strain.csv"),
            encoding="utf-8",
            newline="",
        ) as file:
            stored = list(csv.reader(file))
        saved = list(csv.reader(found["csv"].splitlines()))
        self.assertEqual([row[:4] for row in saved], [row[:4] for row in stored])
        self.assertEqual(
            [float(row[6]) for row in saved[1:]], [float(row[6]) for row in stored[1:]]
        )


class PageSizeTest(unittest.TestCase):
    def test_the_largest_pictures_go_beside_a_page_that_is_too_large(self):
        def figure(name, length):
            return (
                f'<figure id="{name}">\n<img src="data:image/webp;base64,{"A" * length}"'
                ' alt=""></figure>'
            )

        page = (
            figure("small", 100) + figure("moves", 3000) + figure("large", 2000) + page_size.PLACE
        )
        with mock.patch.object(page_size, "LIMIT_BYTES", 1000):
            text = page_size.fitted(page, {"moves"})
        self.assertLess(len(text), 1000)
        self.assertIn('<img src="figures/moves.webp" alt=', text)
        self.assertIn('<img src="figures/large.svg" alt=', text)
        self.assertIn(
            (
                "2 pictures lie beside the page in figures/, because with them it would exceed 8"
                " MB: large, moves."
            ),
            text,
        )
        self.assertEqual(page_size.fitted(page), page.replace(page_size.PLACE, ""))

    def test_an_svg_in_percent_encoding_is_the_same_picture(self):
        svg = (
            '<svg id="unused"><!-- a --><path id="p" d="M 1.23456 2 %\nL 3 4"/><use href="#p"'
            ' style="fill: #ffffff"/></svg>'
        )
        address = gallery.svg_address(gallery.short_svg(svg))
        self.assertFalse(set(address) & set('"&#'))
        self.assertEqual(
            urllib.parse.unquote(address.split(",", 1)[1]),
            "<svg><path id='p' d='M 1.2 2 % L 3 4'/><use href='#p' style='fill:#ffffff'/></svg>",
        )


class PlotDataTest(unittest.TestCase):
    def test_curves_bands_and_bars_are_read_back(self):
        figure, (one, two) = pyplot.subplots(1, 2)
        self.addCleanup(pyplot.close, figure)
        one.plot([1.0, 2.0], [3.0, numpy.nan], "--s", color="#0072B2", label="a")
        one.plot([1.0, 2.0], [1.0, 1.0], label="_guide")
        one.set(xscale="log", xlabel="strain [%]", ylabel="error [m]")
        plot_data.band(one, [1.0, 2.0], [5.0, 6.0], 0.1, "grey")
        two.barh(0.0, 9.0, left=1.0, label="time")
        a, guide, grey = plot_data.panels_of(figure)[0]["curves"]
        self.assertEqual(
            (a["label"], a["points"], a["colour"], a["marker"]),
            ("a", [[1.0, 3.0], [2.0, None]], "#0072b2", "s"),
        )
        self.assertEqual((guide["label"], grey["points"]), ("", [[1.0, 5.0], [2.0, 6.0]]))
        self.assertEqual(plot_data.panels_of(figure)[0]["x"]["log"], True)
        rows = plot_data.rows_of(figure)
        self.assertEqual([row[1] for row in rows], ["a", "grey", "grey", "time"])
        self.assertEqual(rows[-1][4], 10.0)  # where the bar ends, not how long it is

    def test_a_line_that_is_drawn_as_steps_is_refused(self):
        figure, axes = pyplot.subplots()
        self.addCleanup(pyplot.close, figure)
        axes.step([1.0, 2.0], [2.0, 1.0], where="post", label="front")
        with self.assertRaisesRegex(
            ValueError, "curve `front` is drawn with `steps-post`, expected `default`"
        ):
            plot_data.panels_of(figure)

    def test_a_figure_with_words_at_its_axis_stays_a_picture(self):
        figure, axes = pyplot.subplots()
        self.addCleanup(pyplot.close, figure)
        axes.plot([0.0, 1.0], [1.0, 2.0], label="a")
        axes.set_xticks([0.0, 1.0], ["one", "two"])
        self.assertIsNone(plot_data.panels_of(figure))


class DecimationTest(unittest.TestCase):
    def test_few_vertices_cover_the_same_area_and_are_vertices_of_the_mesh(self):
        points, triangles, _ = square_mesh(60, 1.0)
        few = decimate(points, triangles, 500)
        self.assertLessEqual(len(few.vertices), 500)
        self.assertGreater(len(few.vertices), 200)
        kept = points[few.vertices]
        self.assertAlmostEqual(area_of(kept, few.triangles), 1.0, delta=0.02)
        numpy.testing.assert_allclose(
            [kept.min(axis=0), kept.max(axis=0)], [[0.0, 0.0], [1.0, 1.0]], atol=1e-12
        )

    def test_a_small_mesh_stays_as_it_is(self):
        points, triangles, _ = square_mesh(3, 1.0)
        few = decimate(points, triangles, 16)
        numpy.testing.assert_array_equal(few.triangles, triangles)

    def test_packing_keeps_a_small_difference_beside_a_large_place(self):
        places = numpy.random.default_rng(1).uniform(-1.0, 1.0, (2, 50, 3))
        arrays = {
            "place": places,
            "small": 1e-7 * places,
            "triangles": numpy.arange(60).reshape(20, 3),
            "still": numpy.zeros((1, 4, 2)),
        }
        back = view_data.unpacked(view_data.packed(arrays))
        numpy.testing.assert_allclose(back["place"], places, atol=2.0 / 65000)
        numpy.testing.assert_allclose(back["small"], 1e-7 * places, atol=2e-7 / 65000)
        numpy.testing.assert_array_equal(back["triangles"], arrays["triangles"])
        numpy.testing.assert_array_equal(back["still"], arrays["still"])


class WithoutLibraryTest(PageTest):
    def test_page_without_the_plotting_library_says_so_once_and_keeps_its_pictures(self):
        write_results(self.folder)
        self.remove("stripes/fields-shear-frame.h5", "stripes/cell.h5", "stripes/homogenize.json")
        with mock.patch.object(whole_page, "CHART", os.path.join(self.place, "nowhere.js")):
            self.assertEqual(self.whole_report(), (0, ""))
        page = self.page()
        self.assertEqual(page.count("Plots are pictures only"), 1)
        self.assertNotIn("new Chart(", page)
        self.assertEqual(page_checks.figures_without_downloads(page, self.output), [])


if __name__ == "__main__":
    unittest.main()
