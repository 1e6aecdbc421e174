# SPDX-License-Identifier: MIT
"""A triangle mesh with fewer vertices, each of them a vertex of the full mesh with its own stored
numbers.

Vertices are gathered in boxes; of each box the one nearest to its middle stays, and a triangle
stays if its corners lie in three boxes (Rossignac and Borrel 1993). Nothing is averaged: what is
shown at a vertex is what the study stored there. Boxes are centred on the borders of the mesh,
which keep their place.
"""
from dataclasses import dataclass

import numpy


@dataclass
class Decimated:
    vertices: numpy.ndarray  # (k) numbers of the vertices that stay
    triangles: numpy.ndarray  # (m,3) into these
    origin: numpy.ndarray  # (m) number of one triangle of the full mesh that each stands for


def area_of(points, triangles):
    edges = points[triangles[:, 1:]] - points[triangles[:, :1]]
    squares = (edges**2).sum(axis=2).prod(axis=1) - (edges[:, 0] * edges[:, 1]).sum(axis=1) ** 2
    return 0.5 * float(numpy.sqrt(numpy.maximum(squares, 0.0)).sum())


def boxes(points, width):
    """Number of the box of each point, and the squared distance from its middle in widths."""
    low = points.min(axis=0)
    size = points.max(axis=0) - low
    step = size / numpy.maximum(1.0, numpy.round(size / width))
    place = (points - low) / numpy.where(step > 0.0, step, 1.0)
    nearest = numpy.round(place)
    _, box = numpy.unique(nearest.astype(int), axis=0, return_inverse=True)
    return box.reshape(-1), ((place - nearest) ** 2).sum(axis=1)


def decimate(points, triangles, limit):
    """At most `limit` vertices of a mesh.

    @param points (n,2) or (n,3)
    @return Decimated; the whole mesh where it has no more vertices than that
    """
    if len(points) <= limit:
        return Decimated(numpy.arange(len(points)), triangles, numpy.arange(len(triangles)))
    width = max(area_of(points, triangles) / limit, 1e-300) ** 0.5
    box, off = boxes(points, width)
    while box.max() >= limit:
        width *= 1.04
        box, off = boxes(points, width)
    order = numpy.lexsort((off, box))
    # The vertex nearest to the middle of each box.
    first = order[numpy.unique(box[order], return_index=True)[1]]
    corners = box[triangles]
    kept = numpy.flatnonzero(
        (corners[:, 0] != corners[:, 1])
        & (corners[:, 1] != corners[:, 2])
        & (corners[:, 2] != corners[:, 0])
    )
    _, once = numpy.unique(numpy.sort(corners[kept], axis=1), axis=0, return_index=True)
    kept = kept[once]
    used, numbers = numpy.unique(corners[kept], return_inverse=True)
    return Decimated(first[used], numbers.reshape(-1, 3), kept)
