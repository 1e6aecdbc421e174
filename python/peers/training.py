# SPDX-License-Identifier: MIT
"""Frames to train on: sheets under other loads than a study has, by linear elasticity in NumPy. The
interior of each cell is condensed onto its outline, and what is left is solved densely: for sheets
of 10 x 10 cells seconds and half a gigabyte.
"""
import numpy


def stiffness_of(modulus, ratio, thickness):
    """Plane stress, in Voigt order 11, 22, 12 and engineering shear (3,3) [N/m]."""
    unit = numpy.array([[1.0, ratio, 0.0], [ratio, 1.0, 0.0], [0.0, 0.0, 0.5 * (1.0 - ratio)]])
    return modulus * thickness / (1.0 - ratio**2) * unit


def elements(rest, triangles, stiffness):
    """Stiffness matrices (m,6,6) of linear triangles; unknowns x, y of the first corner and so on."""
    corners = rest[triangles]
    edges = corners[:, 1:] - corners[:, :1]
    inverse = numpy.linalg.inv(edges)
    slope = numpy.concatenate([-inverse.sum(axis=2, keepdims=True), inverse], axis=2)  # (m,2,3)
    strain = numpy.zeros((len(triangles), 3, 6))
    strain[:, 0, 0::2] = strain[:, 2, 1::2] = slope[:, 0]
    strain[:, 1, 1::2] = strain[:, 2, 0::2] = slope[:, 1]
    area = 0.5 * numpy.abs(numpy.linalg.det(edges))
    return numpy.einsum("m,mai,mab,mbj->mij", area, strain, stiffness, strain, optimize=True)


def unknowns(vertices):
    return (2 * numpy.asarray(vertices)[..., None] + [0, 1]).reshape(*vertices.shape[:-1], -1)


def equilibrium(mesh, stiffness, part, held, values):
    """Displacements (f,n,2) where those of `held` (h) are `values` (f,h,2) and no force acts.

    mesh: (rest, triangles); stiffness (m,3,3); part (m): numbers of parts, condensed one by one
    """
    rest, triangles = mesh
    matrices = elements(rest, triangles, stiffness)
    n_parts = numpy.zeros(len(rest), dtype=int)
    parts = [numpy.flatnonzero(part == p) for p in numpy.unique(part)]
    for its in parts:
        n_parts[numpy.unique(triangles[its])] += 1
    is_inside = n_parts == 1
    is_inside[held] = False
    skeleton = numpy.flatnonzero((n_parts > 0) & ~is_inside)
    place = numpy.full(len(rest), -1)
    place[skeleton] = numpy.arange(len(skeleton))
    whole, back = numpy.zeros((2 * len(skeleton),) * 2), []
    for its in parts:
        vertices = numpy.unique(triangles[its])
        vertices = numpy.concatenate([vertices[is_inside[vertices]], vertices[~is_inside[vertices]]])
        local = numpy.zeros(len(rest), dtype=int)
        local[vertices] = numpy.arange(len(vertices))
        rows = unknowns(local[triangles[its]])
        matrix = numpy.zeros((2 * len(vertices),) * 2)
        numpy.add.at(matrix, (rows[:, :, None], rows[:, None, :]), matrices[its])
        n = 2 * int(is_inside[vertices].sum())
        inside, outside = vertices[:n // 2], vertices[n // 2:]
        carried = numpy.linalg.solve(matrix[:n, :n], matrix[:n, n:])
        there = unknowns(place[outside])
        whole[numpy.ix_(there, there)] += matrix[n:, n:] - matrix[n:, :n] @ carried
        back.append((inside, outside, carried))
    moved = numpy.zeros((len(rest), 2, len(values)))
    moved[held] = numpy.moveaxis(values, 0, 2)
    given = unknowns(place[numpy.asarray(held)])
    free = numpy.setdiff1d(numpy.arange(len(whole)), given)
    right = -whole[numpy.ix_(free, given)] @ moved[held].reshape(len(given), -1)
    flat = moved.reshape(2 * len(rest), -1)
    if len(free):
        flat[unknowns(skeleton)[free]] = numpy.linalg.solve(whole[numpy.ix_(free, free)], right)
    for inside, outside, carried in back:
        flat[unknowns(inside)] = -carried @ flat[unknowns(outside)]
    return numpy.moveaxis(flat.reshape(len(rest), 2, -1), 2, 0)


def waves(along, n_frames, seed, n=11):
    """Random smooth displacements (f,k,2) of a clamp, at `along` (k) from 0 to 1."""
    random = numpy.random.default_rng(seed)
    size = random.standard_normal((n_frames, n, 2)) / (1.0 + numpy.arange(n)**2)[:, None]
    return numpy.einsum("fwc,kw->fkc", size, numpy.cos(numpy.pi * numpy.outer(along, range(n))))
