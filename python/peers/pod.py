# SPDX-License-Identifier: MIT
"""Proper orthogonal decomposition of the whole sheet: the sum of training frames that is nearest to
the reference in the mean square. It is no method, because it is found with the reference at hand,
and a bound only on methods whose fine positions are such sums, in that norm.
"""
import numpy


def modes(rest, fine, smallest=1e-10):
    """Orthonormal displacements (p, 2 n) that span those of the frames `fine` (f, n, 2)."""
    moved = (fine - rest).reshape(len(fine), -1)
    _, sizes, rows = numpy.linalg.svd(moved / numpy.linalg.norm(moved, axis=1)[:, None],
                                      full_matrices=False)
    return rows[sizes > smallest * sizes[0]]


def pod(rest, fine):
    """nearest(reference) -> the positions nearest to it, in the mean square, among sums of frames."""
    basis = modes(rest, fine)
    return lambda reference: rest + (basis.T @ (basis @ (reference - rest).ravel())).reshape(-1, 2)
