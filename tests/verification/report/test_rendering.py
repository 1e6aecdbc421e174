# SPDX-License-Identifier: MIT
"""Tests of the pictures of a cloth in space: what the camera sees and how it is lit."""
import unittest
from unittest import mock

import numpy

import report_path  # noqa: F401
from figures.rendering import (
    Camera,
    axes_of,
    best_axes,
    bounds,
    camera_around,
    coloured,
    render,
    visible,
)
from made_up_study import square_mesh
from read import vtu


class RenderingTest(unittest.TestCase):
    """A camera above the plane of the first two axes, one unit wide, in pictures of 100 pixels."""

    def setUp(self):
        self.camera = Camera(numpy.eye(3), numpy.array([0.5, 0.5]), numpy.ones(2))

    def triangle(self, depth, size=1.0):
        return [[0.0, 0.0, depth], [size, 0.0, depth], [0.0, size, depth]]

    def picture(self, points, triangles, colours, **options):
        surface = vtu.Surface(numpy.array(points), numpy.array(triangles))
        return render(surface, self.camera, 100, numpy.array(colours, float), **options)

    def test_covered_area_is_the_area_of_the_triangle(self):
        image = self.picture(self.triangle(0.0), [[0, 1, 2]], [[1.0, 1.0, 1.0]])
        self.assertEqual(image.shape, (100, 100, 4))
        self.assertAlmostEqual(image[..., 3].mean(), 0.5, delta=0.005)
        # The lower left corner of the plane is that of the picture.
        self.assertEqual(image[99, 0, 3], 1.0)
        self.assertEqual(image[0, 99, 3], 0.0)

    def test_mesh_has_no_gaps_between_triangles(self):
        flat, triangles, _ = square_mesh(37, 1.0)
        image = self.picture(
            numpy.column_stack([flat, 0.0 * flat[:, 0]]), triangles, numpy.ones((len(triangles), 3))
        )
        self.assertEqual(image[..., 3].min(), 1.0)

    def test_a_picture_drawn_in_many_parts_is_the_same(self):
        flat, triangles, _ = square_mesh(5, 1.0)
        points = numpy.column_stack([flat, flat[:, 0] ** 2])
        colours = numpy.random.default_rng(1).random((len(triangles), 3))
        whole = self.picture(points, triangles, colours)
        with mock.patch("figures.rendering.CANDIDATES", 700):
            numpy.testing.assert_array_equal(self.picture(points, triangles, colours), whole)

    def test_two_colourings_of_what_is_seen_are_those_of_two_pictures(self):
        flat, triangles, _ = square_mesh(5, 1.0)
        cloth = vtu.Surface(numpy.column_stack([flat, flat[:, 0] ** 2]), triangles)
        body = vtu.Surface(numpy.array(self.triangle(0.2)), numpy.array([[0, 1, 2]]))
        seen = visible(cloth, self.camera, 100, body)
        random = numpy.random.default_rng(1)
        for colours, options in (
            (random.random((len(triangles), 3)), {"edge": 0.9}),
            (random.random((len(flat), 3)), {"per_vertex": True, "contrast": 0.3}),
        ):
            image = coloured(seen, colours, **options)
            numpy.testing.assert_array_equal(
                image, render(cloth, self.camera, 100, colours, bodies=body, **options)
            )
            # The grey body in front.
            self.assertLess(numpy.ptp(image[90:, :10], axis=(0, 1)).max(), 1e-12)

    def test_the_nearer_of_two_triangles_is_seen_whatever_their_order(self):
        points = self.triangle(0.0) + self.triangle(0.2, 0.5)
        red, blue = [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]
        for triangles, colours in (
            ([[0, 1, 2], [3, 4, 5]], [red, blue]),
            ([[3, 4, 5], [0, 1, 2]], [blue, red]),
        ):
            image = self.picture(points, triangles, colours)
            # Near the common corner the small one, which is nearer to the eye.
            self.assertGreater(image[95, 5, 2], 0.5)
            self.assertEqual(image[95, 5, 0], 0.0)
            self.assertGreater(image[95, 80, 0], 0.5)

    def test_both_sides_of_a_cloth_are_lit_alike(self):
        one, other = (
            self.picture(self.triangle(0.0), [t], [[1.0, 1.0, 1.0]]) for t in ([0, 1, 2], [0, 2, 1])
        )
        numpy.testing.assert_allclose(one, other, atol=1e-14)

    def test_camera_looks_at_the_broad_side_with_up_upwards(self):
        flat, triangles, _ = square_mesh(2, 1.0)
        # In the plane of y and z.
        hanging = vtu.Surface(numpy.column_stack([0.0 * flat[:, 0], flat]), triangles)
        axes = best_axes([hanging], numpy.array([0.0, 0.0, 1.0]))
        self.assertGreater(abs(axes[2, 0]), 0.9)
        self.assertGreater(axes[1, 2], 0.9)
        for up in (
            numpy.eye(3)[0],
            numpy.eye(3)[1],
            -numpy.eye(3)[2],
            numpy.array([1.0, 2.0, 3.0]),
        ):
            turned = axes_of(30.0, 20.0, up)
            numpy.testing.assert_allclose(turned @ turned.T, numpy.eye(3), atol=1e-14)
            self.assertAlmostEqual(numpy.linalg.det(turned), 1.0)
            self.assertAlmostEqual(turned[0] @ up, 0.0)

    def test_camera_shows_all_it_is_asked_to(self):
        flat, triangles, _ = square_mesh(2, 1.0)
        surface = vtu.Surface(numpy.column_stack([flat, flat[:, 0]]), triangles)
        axes = axes_of(30.0, 20.0, numpy.array([0.0, 0.0, 1.0]))
        camera = camera_around(axes, [bounds(surface, axes)])
        inside = abs(camera.project(surface.points)[:, :2] - camera.centre) < 0.5 * camera.extent
        self.assertTrue(inside.all())


if __name__ == "__main__":
    unittest.main()
