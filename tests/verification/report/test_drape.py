# SPDX-License-Identifier: MIT
"""Tests of the page of `homespun drape`, on a made-up cloth that swings down on an edge."""
import json
import math
import os
import re
import shutil
import unittest
from types import SimpleNamespace

import numpy
from PIL import Image

import report_path  # noqa: F401
from made_up_drape import REFERENCES, VARIANTS, write_drape, write_vtu
from made_up_run import list_again
from made_up_study import write_results, write_stress
from page import drape_tables
from page_case import PageTest, draw_small_cloth
from read import vtu


class DrapePageTest(PageTest):
    def setUp(self):
        super().setUp()
        draw_small_cloth(self.addCleanup)

    def test_complete_scene_makes_every_section_figure_and_link(self):
        write_drape(self.folder)
        self.assertEqual(self.whole_report(), (0, ""))
        page = self.page()
        sections = (
            "drape-short",
            "verdicts",
            "scene-1",
            "scene-1-1",
            "scene-1-1-error",
            "scene-1-1-motion",
            "scene-1-1-time",
            "scene-1-terms",
            "scene-1-parameters",
            "scene-1-frames",
            "left-out",
            "provenance",
        )
        places = [page.index(f'id="{key}"') for key in sections]
        self.assertEqual(places, sorted(places))
        # The command before the verdicts.
        self.assertLess(page.index("homespun drape swing.prm"), places[1])
        figures = set(os.listdir(os.path.join(self.output, "figures")))
        for name in ("cloth", "error-time", "height", "energies", "held-forces", "step"):
            self.assertIn(f"swing-layered-{name}.svg", figures)
            self.assertIn(f'id="swing-layered-{name}"', page)
        with Image.open(
            os.path.join(self.output, "figures", "swing-layered-motion.webp")
        ) as moving:
            self.assertEqual((moving.n_frames, moving.info["loop"]), (4, 0))
        for text in (
            "1.10 ms and its up-sampling 90.0 µs on 1 thread",
            "<b>1090 times</b> as long",
            "the uncertainty of the reference's mesh is 10.0 µm",
            "the uncertainty of the reference's mesh is not known",
            "let go &lt;level&gt;",
            "the scene does not ask for it",
            "1.10 ms ± 20.0 µs",
            'data-label="Step">1.10 ms</td>',
            'data-label="Mean">1.70 ms</td>',
            'data-label="95 %">5.90 ms</td>',
            "+13.6 %",
            "+23.5 %",
            "solver/tolerance",
            "1e-08",
            "printed-nodal-warping moves more than three times",
            "abc1234",
        ):
            self.assertIn(text, page)
        links = re.findall(r'href="(?!figures/)([^"#][^"]*)"', page)
        self.assertEqual(len(links), 2 * len(VARIANTS) + len(REFERENCES))
        for link in links:
            self.assertTrue(os.path.isfile(os.path.join(self.output, link)), link)
        self.assertFalse(re.search(r'src="(?!data:)', page), "the page must stand alone")
        self.assertLess(os.path.getsize(os.path.join(self.output, "report.html")), 8e6)

    def test_an_error_is_said_over_the_displacement_of_the_reference(self):
        def cell_of(moved, error=2e-3, method="localized"):
            row = {
                **dict.fromkeys(("reference_uncertainty_m", "time_step_uncertainty_m"), 1e-5),
                "variant": "biot",
                "reference": "biot",
                "method": method,
                "time_s": 1.0,
                "error_mean_m": error,
                "error_mean_per_cell": error / 0.01,
                "displacement_mean_m": moved,
            }
            return SimpleNamespace(errors=[row], info={"judged_method": method})

        def sentence(moved, error=2e-3):
            return drape_tables.error_sentence(cell_of(moved, error), "biot", "biot")

        # Whether the motion is larger than the error or smaller: the same words.
        self.assertIn("<b>10.0 % of the mean displacement</b>, <b>2.00 mm</b>", sentence(0.02))
        self.assertIn("<b>200 % of the mean displacement</b>, <b>2.00 mm</b>", sentence(0.001))
        # A cloth that rests has no displacement to divide by, nor one that is not known.
        for moved in (0.0, math.nan):
            self.assertNotIn("displacement", sentence(moved))
            self.assertIn("is <b>2.00 mm</b>", sentence(moved))
        # Of a run without `localized` that of its last method.
        other = drape_tables.error_sentence(cell_of(0.02, method="full"), "biot", "biot")
        self.assertIn("The mean error of full per vertex at the end", other)

    def test_scene_without_references_frames_and_terms_is_reported_and_what_is_absent_is_named(
        self,
    ):
        write_drape(self.folder, variants=VARIANTS[:1], references=())
        shutil.rmtree(os.path.join(self.folder, "layered-biot"))
        self.remove("terms.csv")
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        for text in (
            "No reference was computed",
            "Left out: pictures of layered",
            "Left out: error of layered",
            "Left out: what absent terms would have cost",
            "fine.pvd does not exist",
            "drape.csv does not exist",
            "Left out: links to frames",
        ):
            self.assertIn(text, page)

    def test_scene_of_which_only_the_description_is_left_is_reported(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=REFERENCES[:1])
        self.remove("drape.csv", "motion.csv", "terms.csv", "verdicts.json")
        self.edit(
            "drape.json",
            lambda text: json.dumps({"scene": "swing", "cells": [{"cell": "<layered>"}]}),
        )
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        for text in (
            "drape.json lists no run",
            "Left out: height and energies",
            "Left out: time per step",
            "Left out: terms of the solver",
            "Left out: parameters",
            "Left out: provenance",
            "Left out: verdicts",
        ):
            self.assertIn(text, page)

    def test_frames_without_material_error_or_reference_are_drawn(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=())
        path = os.path.join(self.folder, "layered-biot", "fine")
        for name in os.listdir(path):
            frame = vtu.read_vtu(os.path.join(path, name))
            write_vtu(os.path.join(path, name), frame.points, frame.triangles)
        list_again(self.folder)
        self.assertEqual(self.run_report(saved=["swing-layered-cloth"]), (0, ""))
        self.assertIn('id="swing-layered-cloth"', self.page())

    def test_report_of_a_strain_study_two_scenes_and_stress_cases_is_one_page(self):
        folders = [os.path.join(self.place, name) for name in ("strain", "one", "two", "stress")]
        write_results(folders[0])
        write_drape(folders[1], variants=VARIANTS[:1], references=REFERENCES[:1], frames=2)
        write_drape(folders[2], variants=VARIANTS[:1], references=(), frames=2)
        write_stress(folders[3])
        self.assertEqual(self.run_report(*folders), (0, ""))
        page = self.page()
        for key in ("drape-short", "scene-1", "scene-2", "stress-1", "strain", "stiffness", "chi"):
            self.assertEqual(page.count(f'<h2 id="{key}">'), 1)
        self.assertIn("<h1>homespun: stripes</h1>", page)
        self.assertIn(f"Cloth in motion: swing ({folders[1]})", page)
        self.assertIn("stress: contrast of stripes: no answer is wrong up to 1e10", page)

    def test_the_same_results_give_the_same_page(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=REFERENCES[:1], frames=2)
        self.assertEqual(self.whole_report(), (0, ""))
        first = self.page()
        self.assertEqual(self.whole_report(), (0, ""))
        self.assertEqual(self.page(), first)

    def test_truncated_frame_is_refused_by_name(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=REFERENCES[:1])
        path = os.path.join(self.folder, "layered-reference-shell", "fine", "0003.vtu")
        os.truncate(path, os.path.getsize(path) - 600)
        list_again(self.folder)
        self.assert_refused("layered-reference-shell/fine/0003.vtu", "is truncated")

    def test_frame_with_a_vertex_that_is_not_a_number_is_refused(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=())
        path = os.path.join(self.folder, "layered-biot", "fine", "0003.vtu")
        frame = vtu.read_vtu(path)
        points = frame.points.copy()
        points[5, 1] = numpy.nan
        write_vtu(path, points, frame.triangles)
        list_again(self.folder)
        self.assert_refused("0003.vtu: vertex 5 is at", "expected finite numbers")

    def test_files_outside_of_the_folder_are_not_opened(self):
        for path, old, new, message in (
            (
                "layered-biot/fine.pvd",
                'file="fine/0003.vtu"',
                'file="../../secret.vtu"',
                "names `../../secret.vtu`",
            ),
            ("drape.json", '"folder": "layered-biot"', '"folder": "/etc"', "folder `/etc`"),
            (
                "drape.json",
                '"folder": "layered-biot"',
                '"folder": "../elsewhere"',
                "folder `../elsewhere`",
            ),
        ):
            with self.subTest(new):
                shutil.rmtree(self.folder, ignore_errors=True)
                write_drape(self.folder, variants=VARIANTS[:1], references=())
                self.edit(path, lambda text: text.replace(old, new, 1))
                self.assert_refused(message)

    def test_all_faults_of_a_scene_are_named_at_once(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=REFERENCES[:1])
        self.edit("drape.csv", lambda text: text.replace("localized,0,", "localized,", 1))
        self.edit_table("motion.csv", lambda rows: rows[1].update(frame="one"))
        self.edit_table("terms.csv", lambda rows: rows[1].update(present="perhaps"))
        self.edit("layered-reference-shell/fine.pvd", lambda text: text[:100])
        self.assert_refused(
            "drape.csv, line 3: found 14 fields, expected 15",
            "`frame` is `one`",
            "`present` is `perhaps`",
            "fine.pvd: not a readable .pvd",
        )

    def test_description_with_keys_of_the_wrong_type_is_refused(self):
        for old, new, message in (
            ('"scene": "swing"', '"scene": 3', "key `scene` is `3`"),
            ('"present": true', '"present": 1', "term `membrane` has `present` = `1`"),
            ('"time_step_s": 0.001', '"time_step_s": "1 ms"', "key `time_step_s` is `1 ms`"),
            ('[2839.91, 299.7, 0.0]', '[2839.91]', "key `C` is not a 3 x 3 matrix"),
            ('"variant": "biot", ', '', "runs[0] has `variant` = `None`"),
            (
                '"seconds_per_step": 1.3',
                '"seconds_per_step": "long"',
                "`seconds_per_step` = `long`",
            ),
        ):
            with self.subTest(message):
                write_drape(self.folder, variants=VARIANTS[:1], references=REFERENCES[:1], frames=2)
                self.edit("drape.json", lambda text, old=old, new=new: text.replace(old, new, 1))
                self.assert_refused("drape.json", message, "homespun drape")

    def test_tables_without_their_description_are_left_out(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=())
        self.remove("drape.json")
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn("drape.json does not exist", self.page())

    def test_a_frame_that_was_changed_is_left_out_and_named(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=())
        path = os.path.join(self.folder, "layered-biot", "fine", "0003.vtu")
        os.truncate(path, os.path.getsize(path) - 600)
        self.assertEqual(self.run_report(), (0, ""))
        self.assertIn("fine/0003.vtu was changed after the run ended", self.page())
        self.assertIn('id="swing-layered-cloth"', self.page())


if __name__ == "__main__":
    unittest.main()
