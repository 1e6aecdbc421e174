# SPDX-License-Identifier: MIT
"""A linear operator learned from pairs of coarse and fine frames, after Kavan, Gerszewski, Bargteil
and Sloan, *Physics-Inspired Upsampling for Cloth Simulation in Games*, 2011.

What the flat surface lacks at a fine vertex is, component by component, a weighted sum of both
components of the displacements of coarse vertices near it, relative to the nearest one, so that a
translation is kept. The weights are least squares over the training frames, drawn to zero as
strongly as a quarter of the frames, left out at first, are met best (ridge regression); the paper
draws them to harmonic functions instead.
"""
import numpy

from flat import flat

STRENGTHS = 10.0 ** numpy.arange(-10.0, 1.0, 2.0)
AT_ONCE = 2000  # vertices, which bounds the memory


def nearest(points, coarse_rest, n):
    distance = ((points[:, None] - coarse_rest)**2).sum(axis=2)
    return numpy.argsort(distance, axis=1, kind="stable")[:, :n]


def differences(moved, near):
    """(f, n, w) of displacements (f, k, 2): those near a vertex less that of the nearest."""
    there = moved[:, near]
    return (there[:, :, 1:] - there[:, :, :1]).reshape(*there.shape[:2], -1)


def weights(data, missing, strength):
    """(n, w, 2) of differences (f, n, w) and what the flat surface lacks (f, n, 2)."""
    matrix = numpy.einsum("fnk,fnl->nkl", data, data, optimize=True)
    right = numpy.einsum("fnk,fnc->nkc", data, missing, optimize=True)
    size = numpy.einsum("nkk->n", matrix)[:, None, None] / matrix.shape[1]
    return numpy.linalg.solve(matrix + strength * size * numpy.eye(matrix.shape[1]), right)


def learned(mesh, coarse, fine, n_weights):
    """The method on a mesh, trained on positions of frames: coarse (f, k, 2), fine (f, n, 2).

    n_weights: of each component of a fine vertex, two for every coarse vertex beside the nearest
    """
    surface = flat(mesh)
    moved = coarse - mesh.coarse_rest
    missing = fine - numpy.stack([surface(one) for one in coarse])
    near = nearest(mesh.rest, mesh.coarse_rest, 1 + n_weights // 2)
    blocks = numpy.array_split(numpy.arange(len(near)), 1 + len(near) // AT_ONCE)
    left_out = numpy.arange(len(coarse)) % 4 == 3
    wrong = numpy.zeros(len(STRENGTHS))
    for its in blocks[::4]:  # a quarter of the vertices tells how strongly
        data = differences(moved, near[its])
        for s, strength in enumerate(STRENGTHS):
            some = weights(data[~left_out], missing[~left_out][:, its], strength)
            found = numpy.einsum("fnk,nkc->fnc", data[left_out], some)
            wrong[s] += numpy.linalg.norm(found - missing[left_out][:, its], axis=2).sum()
    best = STRENGTHS[wrong.argmin()]
    operator = numpy.concatenate([weights(differences(moved, near[its]), missing[:, its], best)
                                  for its in blocks])

    def method(positions):
        data = differences((positions - mesh.coarse_rest)[None], near)[0]
        return surface(positions) + numpy.einsum("nk,nkc->nc", data, operator)

    return method
