# SPDX-License-Identifier: MIT
"""Tests of the pages of `homespun drape` and `homespun stress`, on a made-up cloth that swings down on an edge."""
import contextlib
import io
import json
import os
import re
import shutil
import sys
import tempfile
import unittest
from unittest import mock

import numpy
from PIL import Image

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import drape_results  # noqa: E402
import figures_cloth  # noqa: E402
import report  # noqa: E402
import stress_results  # noqa: E402
import vtu  # noqa: E402
from figures_drape import free_fall  # noqa: E402
from rendering import Camera, axes_of, best_axes, bounds, camera_around, render  # noqa: E402
from test_report import square_mesh, write_results  # noqa: E402

SIDE = 0.01
GRAVITY = 9.81
STIFFNESS = [[2839.91, 299.7, 0.], [299.7, 999.001, 0.], [0., 0., 349.65]]
VARIANTS = ("corotational", "triangle-warping", "nodal-warping", "printed-nodal-warping")
METHODS = ("affine", "localized", "localized-affine-lift")
REFERENCES = ("shell", "biot")


def write_vtu(path, points, triangles, point_data=(), cell_data=(), header="UInt32"):
    """Triangles with float arrays, appended raw, as `homespun drape` writes them."""
    heads, blobs = {"point": "", "cell": ""}, []

    def add(name, values, kind, components=1):
        kinds = {"Float32": "<f4", "Int32": "<i4", "UInt8": "u1"}
        data = numpy.ascontiguousarray(values).astype(kinds[kind]).tobytes()
        offset = sum(map(len, blobs))
        blobs.append(numpy.array([len(data)], "<u8" if header == "UInt64" else "<u4").tobytes() + data)
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" '
                f'format="appended" offset="{offset}"/>\n')
    place = add("points", points, "Float32", 3)
    cells = (add("connectivity", triangles, "Int32") + add("offsets", 3 * numpy.arange(1, len(triangles) + 1), "Int32")
             + add("types", numpy.full(len(triangles), 5), "UInt8"))
    for name, values in dict(point_data).items():
        heads["point"] += add(name, values, "Float32")
    for name, values in dict(cell_data).items():
        heads["cell"] += add(name, values, "Float32")
    with open(path, "wb") as file:
        file.write((f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
                    f'header_type="{header}">\n<UnstructuredGrid><Piece NumberOfPoints="{len(points)}" NumberOfCells='
                    f'"{len(triangles)}">\n<PointData>{heads["point"]}</PointData><CellData>{heads["cell"]}</CellData>\n'
                    f'<Points>{place}</Points><Cells>{cells}</Cells>\n</Piece></UnstructuredGrid>\n'
                    '<AppendedData encoding="raw">\n_').encode() + b"".join(blobs)
                   + b"\n</AppendedData>\n</VTKFile>\n")


def swung(rest, size, time, ripple=0.):
    """Where a sheet (n,2) [m] that hangs on its upper edge is after some time [s]: it swings and ripples (n,3)."""
    angle = 0.5 * numpy.pi * (1. - numpy.cos(4. * time) * numpy.exp(-1.5 * time))
    drop = size - rest[:, 1]
    wave = 0.06 * drop * numpy.sin(4. * numpy.pi * rest[:, 0] / size + 0.5) * min(1., 2. * time)
    wave += ripple * numpy.sin(2. * numpy.pi * rest[:, 0] / SIDE) * numpy.sin(2. * numpy.pi * rest[:, 1] / SIDE)
    along = numpy.array([0., -numpy.cos(angle), -numpy.sin(angle)])
    normal = numpy.array([0., -numpy.sin(angle), numpy.cos(angle)])
    return numpy.outer(rest[:, 0], [1., 0., 0.]) + numpy.outer(drop, along) + numpy.outer(wave, normal)


def write_frames(folder, kind, times, mesh, position, error=None, header="UInt32"):
    """FOLDER/KIND.pvd and a .vtu per time."""
    os.makedirs(os.path.join(folder, kind), exist_ok=True)
    _, triangles, material = mesh
    entries = ""
    for i, time in enumerate(times):
        name = f"{kind}/{i:04d}.vtu"
        points = position(time)
        data = {} if error is None else {"error": error(time)}
        write_vtu(os.path.join(folder, name), points, triangles, data,
                  {"material": material} if kind == "fine" else {}, header)
        entries += f'<DataSet timestep="{time:.9g}" part="0" file="{name}"/>\n'
    with open(os.path.join(folder, kind + ".pvd"), "w", encoding="utf-8") as file:
        file.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1"><Collection>\n' + entries
                   + "</Collection></VTKFile>\n")


def write_drape(folder, cells=2, per_cell=3, frames=4, names=("layered",), variants=VARIANTS, references=REFERENCES):
    """A complete output folder of `homespun drape`; the defaults are as small as they can be."""
    os.makedirs(folder, exist_ok=True)
    size, times = cells * SIDE, numpy.linspace(0., 1., frames)
    coarse, fine = square_mesh(cells, size), square_mesh(cells * per_cell, size)
    errors, motion, terms, info = [], [], [], []
    growth = {variant: 10. ** i for i, variant in enumerate(VARIANTS)}
    for name in names:
        entry = {"cell": name, "cell_side_m": SIDE, "C": STIFFNESS, "areal_density": 0.2, "runs": [], "references": []}
        info.append(entry)
        for reference in references:
            path = f"{name}-{reference}"
            entry["references"].append({"reference": reference, "folder": path, "seconds_per_step": 1.3, "ranks": 2,
                                        "threads": 1, "dofs": 3 * len(fine[0])})
            write_frames(os.path.join(folder, path), "fine", times, fine,
                         lambda time: swung(fine[0], size, time, 0.1 * SIDE), header="UInt64")
        for variant in variants:
            path, falls = f"{name}-{variant}", variant.startswith("printed")

            def position(rest, time, ripple=0., falls=falls, factor=growth[variant]):
                if falls:
                    height = numpy.full(len(rest), -0.5 * GRAVITY * time ** 2)
                    return numpy.column_stack([rest[:, 0], rest[:, 1] - size, height])
                return swung(rest, size, time * (1. + 1e-3 * factor), ripple)

            def upsampled(time, position=position):
                return position(fine[0], time, 0.09 * SIDE)

            def error(time, upsampled=upsampled):
                return numpy.linalg.norm(upsampled(time) - swung(fine[0], size, time, 0.1 * SIDE), axis=1)
            entry["runs"].append({"variant": variant, "folder": path, "frames": frames, "steps": 1000, "cut_steps": 0,
                                  "seconds_per_coarse_step": 1.1e-3, "seconds_per_upsampling": 9e-5, "threads": 1})
            write_frames(os.path.join(folder, path), "coarse", times, coarse, lambda t: position(coarse[0], t))
            write_frames(os.path.join(folder, path), "fine", times, fine, upsampled, error if references else None)
            for i, time in enumerate(times):
                value = float(error(time).mean())
                for reference in references:
                    for k, method in enumerate(METHODS):
                        one = value * (1., 0.5, 0.7)[k] + (1e-3 * SIDE if k == 0 else 0.)
                        errors.append(f"swing,{name},{variant},{reference},{method},{i},{time:.6g},{one:.6g},"
                                      f"{1.2 * one:.6g},{4. * one:.6g},{one / SIDE:.6g},{one / SIDE * 10.:.6g},"
                                      f"{1e-5 if reference == 'shell' else ''}")
        for variant in (*variants, *references):
            for i, time in enumerate(numpy.linspace(0., 1., 8 * frames)):
                falls = variant.startswith("printed")
                centre = -0.5 * GRAVITY * time ** 2 if falls else swung(fine[0], size, time).mean(axis=0)[2]
                known = "1.1e-3,9e-5" if variant in variants else ","
                motion.append(f"swing,{name},{variant},{i},{time:.6g},{size / 2.},{-size / 2.},{centre:.6g},"
                              f"{0.01 * numpy.sin(5. * time) ** 2:.6g},{1e-4 * time:.6g},{1. + 0.01 * time:.6g},{known}")
        terms.append(f"swing,{name},membrane,true,1e-3,1e-3,80000,80000")
        terms.append(f"swing,{name},wind,false,1.1e-3,1.25e-3,100000,123456")

    def write(file_name, text):
        with open(os.path.join(folder, file_name), "w", encoding="utf-8") as file:
            file.write(text)
    write("drape.json", json.dumps({
        "scene": "swing", "story": "A sheet, held along its upper edge, is let go <level> and swings down.",
        "command": "homespun drape swing.prm", "time_step_s": 1e-3, "duration_s": 1., "integrator": "implicit Euler",
        "coarse_triangles": len(coarse[1]), "fine_triangles": len(fine[1]), "fine_vertices": len(fine[0]),
        "terms": [{"name": "membrane", "present": True, "parameters": "C^H of the cell"},
                  {"name": "wind", "present": False, "why": "the scene does not ask for it"}],
        "cells": info, "parameters": {"Gravity": "0, 0, -9.81", "Time step": "0.001 s", "solver": {"tolerance": 1e-8}},
        "provenance": {"homespun": "0.2.0", "git": "abc1234"}}))
    if references:
        write("drape.csv", "\n".join([",".join(drape_results.ERROR_HEADER)] + errors) + "\n")
    write("motion.csv", "\n".join([",".join(drape_results.MOTION_HEADER)] + motion) + "\n")
    write("terms.csv", "\n".join([",".join(drape_results.TERMS_HEADER)] + terms) + "\n")
    write("verdicts.json", json.dumps({"verdicts": [
        {"claim": "the corotational cloth follows the shell", "verdict": "PASS", "value": 1e-4, "limit": "2e-4 m",
         "command": "homespun drape swing.prm"},
        {"claim": "the printed Eq. 8 holds the sheet up", "verdict": "FAIL", "value": 4.9, "limit": "0.1 m",
         "command": "homespun drape swing.prm"}]}))


def write_stress(folder):
    os.makedirs(folder, exist_ok=True)
    rows = ["cell,contrast 1e12,finite C^H,finite C^H,1.5e-13,1e-9,PASS,10,0.2",
            "cell,\"sliver, 1e-6\",finite C^H,nan,,1e-9,FAIL,10,0.1",
            "start,flattened to a point,finite or refusal,refusal: triangle 3 is singular,,,PASS,10,0.01",
            "time step,1 s,energy does not grow,not run,,1e-12,INCONCLUSIVE,0,"]
    with open(os.path.join(folder, "stress.csv"), "w", encoding="utf-8") as file:
        file.write("\n".join([",".join(stress_results.HEADER)] + rows) + "\n")
    with open(os.path.join(folder, "verdicts.json"), "w", encoding="utf-8") as file:
        json.dump({"verdicts": [{"claim": "every case ends finite or refused", "verdict": "FAIL", "value": 1,
                                 "limit": "0 cases", "command": "homespun stress"}]}, file)


class DrapePageTest(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.place)
        self.folder, self.output = (os.path.join(self.place, name) for name in ("results", "out"))
        small = mock.patch.multiple(figures_cloth, PIXELS=60, MOVING_PIXELS=60)  # seconds instead of minutes
        small.start()
        self.addCleanup(small.stop)

    def run_report(self, *folders):
        """(exit status, text on stderr)"""
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            status = report.main([*(folders or (self.folder,)), "--output", self.output, "--quiet"])
        return status, errors.getvalue()

    def page(self):
        with open(os.path.join(self.output, "report.html"), encoding="utf-8") as file:
            return file.read()

    def edit(self, name, change):
        path = os.path.join(self.folder, name)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(change(text))

    def assert_refused(self, *words):
        """Exit status 2, every word in the message, and nothing written."""
        status, errors = self.run_report()
        self.assertEqual(status, 2)
        for word in words:
            self.assertIn(word, errors)
        self.assertFalse(os.path.exists(self.output))

    def test_complete_scene_makes_every_section_figure_and_link(self):
        write_drape(self.folder)
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        sections = ("verdicts", "drape-short", "scene-1", "scene-1-1", "scene-1-1-error", "scene-1-1-motion", "scene-1-1-time",
                    "scene-1-terms", "scene-1-parameters", "scene-1-frames", "left-out", "provenance")
        places = [page.index(f'id="{key}"') for key in sections]
        self.assertEqual(places, sorted(places))
        self.assertLess(page.index("homespun drape swing.prm"), places[0])  # the command before the verdicts
        figures = set(os.listdir(os.path.join(self.output, "figures")))
        for name in ("cloth", "error-time", "height", "energies", "step"):
            self.assertLessEqual({f"swing-layered-{name}.pdf", f"swing-layered-{name}.svg"}, figures)
            self.assertIn(f'id="swing-layered-{name}"', page)
        with Image.open(os.path.join(self.output, "figures", "swing-layered-motion.webp")) as moving:
            self.assertEqual((moving.n_frames, moving.info["loop"]), (4, 0))
        for text in ("1.10 ms and its up-sampling 90.0 µs on 1 thread", "<b>1090 times</b> as long",
                     "the uncertainty of the reference is 10.0 µm", "the uncertainty of the reference is not known",
                     "let go &lt;level&gt;", "the scene does not ask for it", "+13.6 %", "+23.5 %", "solver/tolerance", "1e-08", "printed-nodal-warping moves more than three times", "abc1234"):
            self.assertIn(text, page)
        links = re.findall(r'href="([^"#][^"]*)"', page)
        self.assertEqual(len(links), 2 * len(VARIANTS) + len(REFERENCES))
        for link in links:
            self.assertTrue(os.path.isfile(os.path.join(self.output, link)), link)
        self.assertFalse(re.search(r'src="(?!data:)', page), "the page must stand alone")
        self.assertLess(os.path.getsize(os.path.join(self.output, "report.html")), 8e6)

    def test_scene_without_references_frames_and_terms_is_reported_and_what_is_absent_is_named(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=())
        shutil.rmtree(os.path.join(self.folder, "layered-corotational"))
        os.remove(os.path.join(self.folder, "terms.csv"))
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        for text in ("No reference was asked for", "Left out: pictures of layered", "Left out: error of layered",
                     "Left out: what absent terms would have cost", "fine.pvd does not exist", "drape.csv does not exist",
                     "Left out: links to frames"):
            self.assertIn(text, page)

    def test_scene_of_which_only_the_description_is_left_is_reported(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=REFERENCES[:1])
        for name in ("drape.csv", "motion.csv", "terms.csv", "verdicts.json"):
            os.remove(os.path.join(self.folder, name))
        self.edit("drape.json", lambda text: json.dumps({"scene": "swing", "cells": [{"cell": "<layered>"}]}))
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        for text in ("drape.json lists no run", "Left out: height and energies", "Left out: time per step",
                     "Left out: terms of the solver", "Left out: parameters", "Left out: provenance", "Left out: verdicts"):
            self.assertIn(text, page)

    def test_frames_without_material_error_or_reference_are_drawn(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=())
        path = os.path.join(self.folder, "layered-corotational", "fine")
        for name in os.listdir(path):
            frame = vtu.read_vtu(os.path.join(path, name))
            write_vtu(os.path.join(path, name), frame.points, frame.triangles)
        self.assertEqual(self.run_report(), (0, ""))
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
        self.assertIn("homespun: swing, swing, stress, stripes", page)
        self.assertIn(f"Drape: swing ({folders[1]})", page)
        self.assertIn("stress: every case ends finite or refused", page)

    def test_the_same_results_give_the_same_page(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=REFERENCES[:1], frames=2)
        self.assertEqual(self.run_report(), (0, ""))
        first = self.page()
        self.assertEqual(self.run_report(), (0, ""))
        self.assertEqual(self.page(), first)

    def test_truncated_frame_is_refused_by_name(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=REFERENCES[:1])
        path = os.path.join(self.folder, "layered-shell", "fine", "0003.vtu")
        os.truncate(path, os.path.getsize(path) - 600)
        self.assert_refused("layered-shell/fine/0003.vtu", "is truncated")

    def test_frame_with_a_vertex_that_is_not_a_number_is_refused(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=())
        path = os.path.join(self.folder, "layered-corotational", "fine", "0003.vtu")
        frame = vtu.read_vtu(path)
        points = frame.points.copy()
        points[5, 1] = numpy.nan
        write_vtu(path, points, frame.triangles)
        self.assert_refused("0003.vtu: vertex 5 is at", "expected finite numbers")

    def test_all_faults_of_a_scene_are_named_at_once(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=REFERENCES[:1])
        self.edit("drape.csv", lambda text: text.replace("localized,0,", "localized,", 1))
        self.edit("motion.csv", lambda text: text.replace("layered,shell,1,", "layered,shell,one,", 1))
        self.edit("terms.csv", lambda text: text.replace("wind,false", "wind,perhaps"))
        self.edit("layered-shell/fine.pvd", lambda text: text[:100])
        self.assert_refused("drape.csv, line 3: found 12 fields, expected 13", "`frame` is `one`",
                            "`present` is `perhaps`", "fine.pvd: not a readable .pvd")

    def test_description_with_keys_of_the_wrong_type_is_refused(self):
        for old, new, message in (('"scene": "swing"', '"scene": 3', "key `scene` is `3`"),
                                  ('"present": true', '"present": 1', "term `membrane` has `present` = `1`"),
                                  ('"time_step_s": 0.001', '"time_step_s": "1 ms"', "key `time_step_s` is `1 ms`"),
                                  ('[2839.91, 299.7, 0.0]', '[2839.91]', "key `C` is not a 3 x 3 matrix"),
                                  ('"variant": "corotational", ', '', "runs[0] has `variant` = `None`"),
                                  ('"seconds_per_step": 1.3', '"seconds_per_step": "long"', "`seconds_per_step` = `long`")):
            with self.subTest(message):
                write_drape(self.folder, variants=VARIANTS[:1], references=REFERENCES[:1], frames=2)
                self.edit("drape.json", lambda text, old=old, new=new: text.replace(old, new, 1))
                self.assert_refused("drape.json", message, "homespun drape")

    def test_tables_without_their_description_are_refused(self):
        write_drape(self.folder, variants=VARIANTS[:1], references=())
        os.remove(os.path.join(self.folder, "drape.json"))
        self.assert_refused("drape.json: does not exist")

    def test_stress_cases_that_do_not_hold_come_first(self):
        write_stress(self.folder)
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        self.assertIn("2 of 4 cases hold, 1 fails, 1 cannot be judged.", page)
        self.assertLess(page.index("sliver, 1e-6"), page.index("energy does not grow"))
        self.assertLess(page.index("energy does not grow"), page.index("contrast 1e12"))
        self.assertLess(page.rindex("sliver, 1e-6"), page.index("contrast 1e12"))
        self.assertLess(page.index("homespun stress"), page.index('id="verdicts"'))

    def test_stress_case_with_an_unknown_verdict_is_refused(self):
        write_stress(self.folder)
        self.edit("stress.csv", lambda text: text.replace("FAIL", "BAD"))
        self.assert_refused("stress.csv, line 3: `verdict` is `BAD`", "homespun stress")


class FramesTest(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.place)
        self.path = os.path.join(self.place, "frame.vtu")

    def test_frame_is_read_as_it_was_written_with_either_header(self):
        flat, triangles, material = square_mesh(3, 0.1)
        points = numpy.column_stack([flat, flat[:, 0] ** 2]).astype("f4")
        for header in ("UInt32", "UInt64"):
            write_vtu(self.path, points, triangles, {"error": points[:, 2]}, {"material": material}, header)
            frame = vtu.read_vtu(self.path)
            numpy.testing.assert_array_equal(frame.points, points)
            numpy.testing.assert_array_equal(frame.triangles, triangles)
            numpy.testing.assert_array_equal(frame.material(), material)
            numpy.testing.assert_array_equal(frame.point_data["error"], points[:, 2])

    def test_other_cells_than_triangles_and_vertices_that_do_not_exist_are_refused(self):
        flat, triangles, _ = square_mesh(1, 1.)
        write_vtu(self.path, numpy.column_stack([flat, 0. * flat[:, 0]]), triangles + 1)
        with self.assertRaisesRegex(vtu.BadFrame, "refers to vertex 4, but there are 4"):
            vtu.read_vtu(self.path)
        with open(self.path, "wb") as file:
            file.write(b"<VTKFile><UnstructuredGrid/></VTKFile>")
        with self.assertRaisesRegex(vtu.BadFrame, "expected arrays appended as raw bytes"):
            vtu.read_vtu(self.path)


class SceneTest(unittest.TestCase):
    def gravity(self, value):
        return drape_results.Drape("", {"scene": "s", "parameters": {"Loads": {"Gravity": value}}})

    def test_up_is_against_gravity_however_it_is_written(self):
        for value, gravity in (("0, 0, -9.81", [0., 0., -9.81]), ([0, -1.6, 0], [0., -1.6, 0.]),
                               (9.81, [0., 0., -9.81])):
            drape = self.gravity(value)
            numpy.testing.assert_allclose(drape.gravity(), gravity)
            numpy.testing.assert_allclose(drape.up() * numpy.linalg.norm(gravity), numpy.negative(gravity))
        for value in ("none", "0 0 0", "1 2"):
            numpy.testing.assert_allclose(self.gravity(value).up(), [0., 0., 1.])
        self.assertIsNone(self.gravity("none").gravity())

    def test_frames_belong_together_where_their_times_agree(self):
        cell = drape_results.DrapedCell("c", frames={("corotational", "fine"): [(0., "a"), (0.5, "b"), (1., "c")],
                                                     ("shell", "fine"): [(0., "d"), (0.6, "e"), (1.0001, "f")]})
        film = figures_cloth.film_of(cell, ["corotational"], ["shell"], 1.)
        self.assertEqual([(shot["fine"], shot["reference"]) for shot in film.shots],
                         [("a", "d"), ("b", None), ("c", "f")])
        self.assertIsNone(figures_cloth.film_of(cell, ["nodal-warping"], ["shell"], 1.))

    def test_error_is_measured_on_equal_meshes_and_read_on_others(self):
        flat, triangles, _ = square_mesh(1, 1.)
        points = numpy.column_stack([flat, 0. * flat[:, 0]])
        surface = vtu.Surface(points, triangles, {"error": numpy.full(4, 7.)})
        numpy.testing.assert_allclose(figures_cloth.error_of(surface, vtu.Surface(points + [0., 3., 4.], triangles)), 5.)
        numpy.testing.assert_allclose(figures_cloth.error_of(surface, vtu.Surface(points, triangles[:1])), 7.)
        self.assertIsNone(figures_cloth.error_of(vtu.Surface(points, triangles), None))

    def test_free_fall_is_drawn_from_rest_alone(self):
        rows = [{"time_s": t, "height": 2., "kinetic_J": 0.} for t in (0., 1.)]
        time, height = free_fall(rows, numpy.array([0., 0., -10.]))
        self.assertAlmostEqual(height[-1], 2. - 5.)
        self.assertIsNone(free_fall([{**row, "kinetic_J": 1.} for row in rows], numpy.array([0., 0., -10.])))
        self.assertIsNone(free_fall(rows, None))


class RenderingTest(unittest.TestCase):
    """A camera above the plane of the first two axes, one unit wide, in pictures of 100 pixels."""

    def setUp(self):
        self.camera = Camera(numpy.eye(3), numpy.array([0.5, 0.5]), numpy.ones(2))

    def triangle(self, depth, size=1.):
        return [[0., 0., depth], [size, 0., depth], [0., size, depth]]

    def picture(self, points, triangles, colours, **options):
        surface = vtu.Surface(numpy.array(points), numpy.array(triangles))
        return render(surface, self.camera, 100, numpy.array(colours, float), **options)

    def test_covered_area_is_the_area_of_the_triangle(self):
        image = self.picture(self.triangle(0.), [[0, 1, 2]], [[1., 1., 1.]])
        self.assertEqual(image.shape, (100, 100, 4))
        self.assertAlmostEqual(image[..., 3].mean(), 0.5, delta=0.005)
        self.assertEqual(image[99, 0, 3], 1.)  # the lower left corner of the plane is that of the picture
        self.assertEqual(image[0, 99, 3], 0.)

    def test_mesh_has_no_gaps_between_triangles(self):
        flat, triangles, _ = square_mesh(37, 1.)
        image = self.picture(numpy.column_stack([flat, 0. * flat[:, 0]]), triangles, numpy.ones((len(triangles), 3)))
        self.assertEqual(image[..., 3].min(), 1.)

    def test_a_picture_drawn_in_many_parts_is_the_same(self):
        flat, triangles, _ = square_mesh(5, 1.)
        points = numpy.column_stack([flat, flat[:, 0] ** 2])
        colours = numpy.random.default_rng(1).random((len(triangles), 3))
        whole = self.picture(points, triangles, colours)
        with mock.patch("rendering.CANDIDATES", 700):
            numpy.testing.assert_array_equal(self.picture(points, triangles, colours), whole)

    def test_the_nearer_of_two_triangles_is_seen_whatever_their_order(self):
        points = self.triangle(0.) + self.triangle(0.2, 0.5)
        red, blue = [1., 0., 0.], [0., 0., 1.]
        for triangles, colours in (([[0, 1, 2], [3, 4, 5]], [red, blue]), ([[3, 4, 5], [0, 1, 2]], [blue, red])):
            image = self.picture(points, triangles, colours)
            self.assertGreater(image[95, 5, 2], 0.5)   # near the common corner the small one, which is nearer to the eye
            self.assertEqual(image[95, 5, 0], 0.)
            self.assertGreater(image[95, 80, 0], 0.5)

    def test_both_sides_of_a_cloth_are_lit_alike(self):
        one, other = (self.picture(self.triangle(0.), [t], [[1., 1., 1.]]) for t in ([0, 1, 2], [0, 2, 1]))
        numpy.testing.assert_allclose(one, other, atol=1e-14)

    def test_camera_looks_at_the_broad_side_with_up_upwards(self):
        flat, triangles, _ = square_mesh(2, 1.)
        hanging = vtu.Surface(numpy.column_stack([0. * flat[:, 0], flat]), triangles)  # in the plane of y and z
        axes = best_axes([hanging], numpy.array([0., 0., 1.]))
        self.assertGreater(abs(axes[2, 0]), 0.9)
        self.assertGreater(axes[1, 2], 0.9)
        for up in (numpy.eye(3)[0], numpy.eye(3)[1], -numpy.eye(3)[2], numpy.array([1., 2., 3.])):
            turned = axes_of(30., 20., up)
            numpy.testing.assert_allclose(turned @ turned.T, numpy.eye(3), atol=1e-14)
            self.assertAlmostEqual(numpy.linalg.det(turned), 1.)
            self.assertAlmostEqual(turned[0] @ up, 0.)

    def test_camera_shows_all_it_is_asked_to(self):
        flat, triangles, _ = square_mesh(2, 1.)
        surface = vtu.Surface(numpy.column_stack([flat, flat[:, 0]]), triangles)
        axes = axes_of(30., 20., numpy.array([0., 0., 1.]))
        camera = camera_around(axes, [bounds(surface, axes)])
        inside = abs(camera.project(surface.points)[:, :2] - camera.centre) < 0.5 * camera.extent
        self.assertTrue(inside.all())


if __name__ == "__main__":
    unittest.main()
