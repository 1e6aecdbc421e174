# SPDX-License-Identifier: MIT
"""Pictures of cloth in space by a depth buffer in numpy.

Debian's VTK draws through an X server only, which a compute node lacks, and OpenGL drivers differ
in the last bit. Cloth of small triangles needs little more than a depth buffer: this is quick
enough (about a second for 288,000 triangles), needs no package and gives the same picture on every
machine.
"""
import math
from dataclasses import dataclass

import numpy

SAMPLES = 2  # per pixel and direction; they are averaged at the end
CANDIDATES = 6000000  # samples that are tested against their triangle at once: bounds the memory
AZIMUTHS = range(-90, 90, 15)  # [°] among which the camera chooses
ELEVATION = 20.0  # [°] above the horizon
BODY_COLOUR = (0.62, 0.66, 0.64)  # of what the cloth falls on
# Towards the lamp, in camera axes: right, up, towards the eye.
LIGHT = numpy.array([-0.35, 0.45, 0.82])


@dataclass
class Camera:
    """A parallel projection: lengths across the line of sight are true everywhere, so that a scale
    bar holds.
    """

    axes: numpy.ndarray  # (3,3) rows right, up, towards the eye
    centre: numpy.ndarray  # (2) [m] middle of the picture along right and up
    extent: numpy.ndarray  # (2) [m] width and height

    def project(self, points):
        """Right, up, towards the eye (n,3) [m]."""
        return points @ self.axes.T


def axes_of(azimuth, elevation, up):
    """Camera axes for an eye at the azimuth and elevation [°] above the plane normal to `up` (3).
    """
    up = up / numpy.linalg.norm(up)
    first = (
        numpy.eye(3)[numpy.argmin(abs(up))] if abs(up[2]) < 0.9 else numpy.array([1.0, 0.0, 0.0])
    )
    first = first - (first @ up) * up
    first /= numpy.linalg.norm(first)
    second = numpy.cross(up, first)
    a, e = math.radians(azimuth), math.radians(elevation)
    eye = math.cos(e) * (math.cos(a) * first + math.sin(a) * second) + math.sin(e) * up
    right = numpy.cross(up, eye)
    right /= numpy.linalg.norm(right)
    return numpy.array([right, numpy.cross(eye, right), eye])


def areas(points, triangles):
    """Normal of each triangle (m,3), as long as twice its area [m^2]."""
    corner = points[triangles]
    return numpy.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])


def best_axes(surfaces, up):
    """Camera axes (3,3) that see most of the cloth: one view for all frames and panels.

    Of some azimuths it takes the one with the largest projected area, summed over the surfaces;
    folds count as often as they overlap, which is what a viewer wants to see.
    """
    normals = [areas(s.points, s.triangles) for s in surfaces]
    candidates = [axes_of(azimuth, ELEVATION, up) for azimuth in AZIMUTHS]
    seen = [
        sum(float(numpy.abs(normal @ axes[2]).sum()) for normal in normals) for axes in candidates
    ]
    return candidates[
        max(range(len(candidates)), key=lambda i: (round(seen[i] / (max(seen) or 1.0), 6), -i))
    ]


def bounds(surface, axes):
    """Lowest and highest place in the picture (2,2) [m]."""
    flat = surface.points @ axes[:2].T
    return numpy.array([flat.min(axis=0), flat.max(axis=0)])


def camera_around(axes, boxes):
    """The camera along some axes that shows everything within some bounds."""
    low, high = numpy.min([b[0] for b in boxes], axis=0), numpy.max([b[1] for b in boxes], axis=0)
    size = high - low
    size = size if size.max() > 0.0 else numpy.ones(2)  # all in one point
    pad = 0.03 * float(size.max())
    # Not narrower than a third of its other side: a falling cloth would else be a ribbon in the
    # page.
    return Camera(
        axes, 0.5 * (low + high), numpy.maximum(size + 2.0 * pad, (size.max() + 2.0 * pad) / 3.0)
    )


def close_up(camera, surface, width):
    """The same view of so many metres' width, about the visible vertex at the middle of a surface.
    """
    projected = camera.project(surface.points)
    off = numpy.linalg.norm(projected[:, :2] - projected[:, :2].mean(axis=0), axis=1)
    near = numpy.flatnonzero(off <= max(0.25 * width, off.min()))
    middle = projected[near[numpy.argmax(projected[near, 2])], :2]
    return Camera(camera.axes, middle, camera.extent * (width / camera.extent[0]))


def vertex_normals(points, triangles):
    """Unit normals (n,3), averages over the triangles around a vertex, weighted by area."""
    normal = areas(points, triangles)
    total = numpy.column_stack(
        [
            numpy.bincount(triangles.ravel(), numpy.repeat(normal[:, i], 3), len(points))
            for i in range(3)
        ]
    )
    length = numpy.linalg.norm(total, axis=1, keepdims=True)
    return total / numpy.where(length > 0.0, length, 1.0)


def covered(corners, width, height):
    """Samples inside triangles: (sample, triangle, weights of the corners (k,3)), a part at a time.

    @param corners (m,3,2) in samples
    """
    low = numpy.maximum(numpy.ceil(corners.min(axis=1) - 0.5), 0).astype(int)
    high = numpy.minimum(numpy.floor(corners.max(axis=1) - 0.5), [width - 1, height - 1]).astype(
        int
    )
    span = numpy.maximum(high - low + 1, 0)
    count = span[:, 0] * span[:, 1]
    (a, b, c) = (corners[:, i] for i in range(3))
    double = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    count[double == 0.0] = 0  # seen on edge
    last = numpy.cumsum(count)
    start = 0
    while start < len(count):
        before = last[start] - count[start]
        stop = max(start + 1, int(numpy.searchsorted(last, before + CANDIDATES, side="right")))
        some = numpy.arange(start, stop)
        owner = numpy.repeat(some, count[some])
        local = numpy.arange(len(owner)) - (last[owner] - count[owner] - before)
        x = low[owner, 0] + local % span[owner, 0]
        y = low[owner, 1] + local // span[owner, 0]
        px, py = x + 0.5 - a[owner, 0], y + 0.5 - a[owner, 1]
        v = (px * (c - a)[owner, 1] - py * (c - a)[owner, 0]) / double[owner]
        w = (py * (b - a)[owner, 0] - px * (b - a)[owner, 1]) / double[owner]
        inside = (v >= 0.0) & (w >= 0.0) & (v + w <= 1.0)
        v, w = v[inside], w[inside]
        yield (y * width + x)[inside], owner[inside], numpy.column_stack([1.0 - v - w, v, w])
        start = stop


def render(surface, camera, pixels, colours, per_vertex=False, edge=0.0, contrast=1.0, bodies=None):
    """A picture of one surface on transparent ground: `coloured` of what is `visible`."""
    return coloured(visible(surface, camera, pixels, bodies), colours, per_vertex, edge, contrast)


@dataclass
class Visible:
    """What a camera sees of a surface and its bodies, whatever their colours: k of all samples show
    a triangle.
    """

    shape: tuple  # rows and columns of samples
    corners: numpy.ndarray  # (t,3,2) of the triangles, bodies last [samples]
    triangles: numpy.ndarray  # (t,3)
    n_body_points: int  # vertices of the bodies
    n_cloth: int  # triangles before those of the bodies
    shown: numpy.ndarray  # (k) the samples
    owner: numpy.ndarray  # (k) their triangle
    weights: numpy.ndarray  # (k,3) of its corners
    normal: numpy.ndarray  # (k,3) along the axes of the camera


def visible(surface, camera, pixels, bodies=None):
    """Finds what each sample of a picture shows: nearly all its cost, so that two colourings share
    it.

    @param pixels width of the picture; its height follows from the camera
    @param bodies a surface that hides and is hidden, or None
    @return Visible
    """
    width = SAMPLES * int(pixels)
    scale = width / camera.extent[0]
    height = SAMPLES * max(1, round(camera.extent[1] * scale / SAMPLES))
    points, triangles = surface.points, surface.triangles
    if bodies is not None:
        triangles = numpy.concatenate([triangles, bodies.triangles + len(points)])
        points = numpy.concatenate([points, bodies.points])
    projected = camera.project(points)
    flat = (projected[:, :2] - camera.centre) * [scale, -scale] + [0.5 * width, 0.5 * height]
    corners, depth = flat[triangles], projected[:, 2][triangles]
    found = [
        (sample, owner, weights, numpy.einsum("ki,ki->k", weights, depth[owner]))
        for sample, owner, weights in covered(corners, width, height)
    ]
    shown, owner, weights, normal = (
        numpy.zeros(0, int),
        numpy.zeros(0, int),
        numpy.zeros((0, 3)),
        numpy.zeros((0, 3)),
    )
    if found:
        sample, owner, weights, toward = (numpy.concatenate(part) for part in zip(*found))
        order = numpy.argsort(toward, kind="stable")
        front = numpy.full(height * width, -1)
        front[sample[order]] = order  # of samples named twice the last one stays: the nearest
        shown = numpy.flatnonzero(front >= 0)
        nearest = front[shown]
        owner, weights = owner[nearest], weights[nearest]
        normal = (
            numpy.einsum("ki,kic->kc", weights, vertex_normals(points, triangles)[triangles[owner]])
            @ camera.axes.T
        )
    return Visible(
        (height, width),
        corners,
        triangles,
        len(points) - len(surface.points),
        len(surface.triangles),
        shown,
        owner,
        weights,
        normal,
    )


def coloured(seen, colours, per_vertex=False, edge=0.0, contrast=1.0):
    """A picture of what is seen, on transparent ground; bodies are grey and without edges.

    @param colours RGB from 0 to 1: (m,3) per triangle of the cloth, or (n,3) per vertex
    @param edge width of the drawn edges of triangles [pixels]; 0 draws none
    @param contrast 1 shades fully, less keeps colours closer to their bar
    @return (height, width, 4) from 0 to 1
    """
    n_bodies = seen.n_body_points if per_vertex else len(seen.triangles) - seen.n_cloth
    colours = numpy.concatenate([colours, numpy.tile(BODY_COLOUR, (n_bodies, 1))])
    colour = (
        numpy.einsum("ki,kic->kc", seen.weights, colours[seen.triangles[seen.owner]])
        if per_vertex
        else colours[seen.owner]
    )
    colour = colour * shade(seen.normal, contrast)[:, None]
    if edge > 0.0:
        drawn = on_edge(seen.corners, seen.owner, seen.weights, 0.5 * edge * SAMPLES) & (
            seen.owner < seen.n_cloth
        )
        colour[drawn] *= 0.35
    height, width = seen.shape
    image = numpy.zeros((height * width, 4))
    image[seen.shown, :3], image[seen.shown, 3] = numpy.clip(colour, 0.0, 1.0), 1.0
    return smaller(image.reshape(height, width, 4))


def shade(normal, contrast):
    """Brightness from a lamp beside the eye and one at the eye; both sides of a cloth are lit
    alike.
    """
    length = numpy.linalg.norm(normal, axis=1)
    normal = normal / numpy.where(length > 0.0, length, 1.0)[:, None]
    normal = normal * numpy.where(normal[:, 2] < 0.0, -1.0, 1.0)[:, None]
    lamp = numpy.clip(normal @ (LIGHT / numpy.linalg.norm(LIGHT)), 0.0, 1.0)
    return 1.0 - contrast * (0.56 - 0.43 * lamp - 0.13 * normal[:, 2])


def on_edge(corners, owner, weights, half_width):
    """Samples closer to an edge of their triangle than half its width: weight times height is the
    distance.

    Of a triangle seen nearly on edge the lines stay thinner, or they would fill it.
    """
    a, b, c = (corners[:, i] for i in range(3))
    double = abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    heights = numpy.column_stack(
        [
            double / numpy.maximum(numpy.linalg.norm(p - q, axis=1), 1e-300)
            for p, q in ((b, c), (c, a), (a, b))
        ]
    )
    reach = numpy.minimum(half_width, 0.07 * heights.min(axis=1))[owner, None]
    return (weights * heights[owner] < reach).any(axis=1)


def smaller(image):
    """Averages the samples of each pixel, colours weighted by what covers them."""
    height, width, _ = image.shape
    blocks = image.reshape(height // SAMPLES, SAMPLES, width // SAMPLES, SAMPLES, 4)
    alpha = blocks[..., 3:]
    cover = alpha.sum(axis=(1, 3))
    colour = (blocks[..., :3] * alpha).sum(axis=(1, 3)) / numpy.where(cover > 0.0, cover, 1.0)
    return numpy.concatenate([colour, cover / SAMPLES**2], axis=2)
