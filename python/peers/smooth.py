# SPDX-License-Identifier: MIT
"""A smooth surface through the coarse vertices: cubic triangles as in Vlachos, Peters, Boyd and
Mitchell, *Curved PN Triangles*, 2001. They and not Loop's subdivision, because they pass through
the coarse vertices, and so keep clamps where they are; Loop's surface does not. In the plane all
normals are alike and curve nothing: the gradient of the displacement at a vertex, the mean over
its triangles, takes the place of the normal, so that the displacement is a smooth cubic.
"""
import numpy

from flat import shares


def slopes(rest, triangles):
    """Gradients of the barycentric coordinates (m,2,3), areas (m), areas around the vertices."""
    a, b, c = (rest[triangles[:, k]] for k in range(3))
    edges = numpy.stack([b - a, c - a], axis=1)
    inverse = numpy.linalg.inv(edges)
    per_corner = numpy.concatenate([-inverse.sum(axis=2, keepdims=True), inverse], axis=2)
    area = 0.5 * numpy.abs(numpy.linalg.det(edges))
    around = numpy.zeros(len(rest))
    numpy.add.at(around, triangles, area[:, None])
    return per_corner, area, around


def smooth(mesh):
    """The method on a mesh (rest, coarse_rest, coarse_triangles): f(coarse) -> fine positions."""
    triangles, rest = mesh.coarse_triangles, mesh.coarse_rest
    triangle, share = shares(mesh.rest, rest, triangles)
    per_corner, area, around = slopes(rest, triangles)
    u, v, w = share.T
    # Of each of the six control points on the edges: corner, the other end, its polynomial.
    on_edges = [(k, (k + s) % 3, 3.0 * share[:, k]**2 * share[:, (k + s) % 3])
                for k in range(3) for s in (1, 2)]

    def method(coarse):
        moved = coarse - rest
        by_triangle = numpy.einsum("mjk,mkc->mjc", per_corner, moved[triangles]) * area[:, None, None]
        gradient = numpy.zeros((len(rest), 2, 2))
        for k in range(3):
            numpy.add.at(gradient, triangles[:, k], by_triangle)
        gradient /= around[:, None, None]
        corners = moved[triangles]  # (m, 3, 2)
        out = numpy.einsum("nk,nkc->nc", share**3, corners[triangle])
        middle = -0.5 * corners.mean(axis=1)  # b111 = E + (E - V) / 2 of those papers
        for k, other, polynomial in on_edges:
            along = rest[triangles[:, other]] - rest[triangles[:, k]]
            point = corners[:, k] + numpy.einsum("mj,mjc->mc", along, gradient[triangles[:, k]]) / 3
            out += polynomial[:, None] * point[triangle]
            middle += 0.25 * point
        return mesh.rest + out + (6.0 * u * v * w)[:, None] * middle[triangle]

    return method
