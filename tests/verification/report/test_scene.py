# SPDX-License-Identifier: MIT
"""Tests of what a scene is read into: frames from files, which of them belong together, up, errors,
free fall.
"""
import os
import shutil
import tempfile
import unittest

import numpy

import report_path  # noqa: F401
from figures import cloth
from figures.drape import free_fall
from made_up_drape import write_vtu
from made_up_study import square_mesh
from read import drape_results, vtu


class FramesTest(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.place)
        self.path = os.path.join(self.place, "frame.vtu")

    def test_frame_is_read_as_it_was_written_with_either_header(self):
        flat, triangles, material = square_mesh(3, 0.1)
        points = numpy.column_stack([flat, flat[:, 0] ** 2]).astype("f4")
        for header in ("UInt32", "UInt64"):
            write_vtu(
                self.path,
                points,
                triangles,
                {"error": points[:, 2]},
                {"material": material},
                header,
            )
            frame = vtu.read_vtu(self.path)
            numpy.testing.assert_array_equal(frame.points, points)
            numpy.testing.assert_array_equal(frame.triangles, triangles)
            numpy.testing.assert_array_equal(frame.material(), material)
            numpy.testing.assert_array_equal(frame.point_data["error"], points[:, 2])

    def test_other_cells_than_triangles_and_vertices_that_do_not_exist_are_refused(self):
        flat, triangles, _ = square_mesh(1, 1.0)
        write_vtu(self.path, numpy.column_stack([flat, 0.0 * flat[:, 0]]), triangles + 1)
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
        for value, gravity in (
            ("0, 0, -9.81", [0.0, 0.0, -9.81]),
            ([0, -1.6, 0], [0.0, -1.6, 0.0]),
            (9.81, [0.0, 0.0, -9.81]),
        ):
            drape = self.gravity(value)
            numpy.testing.assert_allclose(drape.gravity(), gravity)
            numpy.testing.assert_allclose(
                drape.up() * numpy.linalg.norm(gravity), numpy.negative(gravity)
            )
        for value in ("none", "0 0 0", "1 2"):
            numpy.testing.assert_allclose(self.gravity(value).up(), [0.0, 0.0, 1.0])
        self.assertIsNone(self.gravity("none").gravity())

    def test_frames_belong_together_where_their_times_agree(self):
        cell = drape_results.DrapedCell(
            "c",
            frames={
                ("biot", "fine"): [(0.0, "a"), (0.5, "b"), (1.0, "c")],
                ("reference shell", "fine"): [(0.0, "d"), (0.6, "e"), (1.0001, "f")],
            },
        )
        film = cloth.film_of(cell, ["biot"], ["shell"], 1.0)
        self.assertEqual(
            [(shot["fine"], shot["reference"]) for shot in film.shots],
            [("a", "d"), ("b", None), ("c", "f")],
        )
        self.assertIsNone(cloth.film_of(cell, ["nodal-warping"], ["shell"], 1.0))

    def test_error_is_measured_on_equal_meshes_and_read_on_others(self):
        flat, triangles, _ = square_mesh(1, 1.0)
        points = numpy.column_stack([flat, 0.0 * flat[:, 0]])
        surface, error = vtu.Surface(points, triangles), {"error": numpy.full(4, 7.0)}
        numpy.testing.assert_allclose(
            cloth.error_of(surface, vtu.Surface(points + [0.0, 3.0, 4.0], triangles)), 5.0
        )
        numpy.testing.assert_allclose(
            cloth.error_of(surface, vtu.Surface(points, triangles[:1], error)), 7.0
        )
        self.assertIsNone(
            cloth.error_of(
                surface, vtu.Surface(points[:3], triangles[:1], {"error": numpy.full(3, 7.0)})
            )
        )
        self.assertIsNone(cloth.error_of(surface, None))

    def test_free_fall_is_drawn_from_rest_alone(self):
        rows = [{"time_s": t, "height": 2.0, "kinetic_J": 0.0} for t in (0.0, 1.0)]
        time, height = free_fall(rows, numpy.array([0.0, 0.0, -10.0]))
        self.assertAlmostEqual(height[-1], 2.0 - 5.0)
        self.assertIsNone(
            free_fall([{**row, "kinetic_J": 1.0} for row in rows], numpy.array([0.0, 0.0, -10.0]))
        )
        self.assertIsNone(free_fall(rows, None))


if __name__ == "__main__":
    unittest.main()
