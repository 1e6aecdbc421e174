# SPDX-License-Identifier: MIT
"""Proper orthogonal decomposition of the whole sheet, as a bound: the best that any sum of the
training frames comes to, found with the answer at hand. No method whose fine positions are such
sums is closer; none is a method, because it knows no answer.
"""
import numpy


def modes(rest, fine, smallest=1e-10):
    """Orthonormal displacements (p, 2 n) that span those of the frames `fine` (f, n, 2)."""
    moved = (fine - rest).reshape(len(fine), -1)
    _, sizes, rows = numpy.linalg.svd(moved / numpy.linalg.norm(moved, axis=1)[:, None],
                                      full_matrices=False)
    return rows[sizes > smallest * sizes[0]]


def pod(rest, fine):
    """closest(reference) -> the positions nearest to it, in the square, among sums of frames."""
    basis = modes(rest, fine)
    return lambda reference: rest + (basis.T @ (basis @ (reference - rest).ravel())).reshape(-1, 2)
