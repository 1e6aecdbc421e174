#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""A method of one's own, the simplest there is: every coarse triangle carries its fine vertices
along. Writes the fine positions of all levels of a `homespun strain --keep` for `homespun judge`.

    flat.py RUN/CELL/positions OUTPUT
"""
import pathlib
import sys
import types

import h5py
import numpy


def shares(rest, coarse_rest, coarse_triangles):
    """(triangle, barycentric coordinates) of each fine vertex, shapes (n,) and (n,3)."""
    triangle = numpy.zeros(len(rest), dtype=int)
    inside = numpy.full((len(rest), 3), -numpy.inf)
    for t, corners in enumerate(coarse_triangles):
        a, b, c = coarse_rest[corners]
        two = numpy.linalg.solve(numpy.column_stack([b - a, c - a]), (rest - a).T).T
        here = numpy.column_stack([1.0 - two.sum(axis=1), two])
        better = here.min(axis=1) > inside.min(axis=1)
        triangle[better], inside[better] = t, here[better]
    return triangle, inside


def flat(mesh):
    """The method on a mesh (rest, coarse_rest, coarse_triangles): f(coarse) -> fine positions."""
    triangle, share = shares(mesh.rest, mesh.coarse_rest, mesh.coarse_triangles)
    corners = mesh.coarse_triangles[triangle]
    return lambda coarse: numpy.einsum("nk,nkc->nc", share, coarse[corners])


def main(kept, output):
    kept, output = pathlib.Path(kept), pathlib.Path(output)
    output.mkdir(parents=True, exist_ok=True)
    for mesh_file, pattern in (("sheet.h5", "s*-*.h5"), ("periodic.h5", "[pu]*-*.h5")):
        levels = sorted(kept.glob(pattern))
        if not levels:
            continue
        with h5py.File(kept / mesh_file) as file:
            method = flat(types.SimpleNamespace(**{name: file[name][...] for name in file}))
        for level in levels:
            with h5py.File(level) as file:
                numpy.save(output / f"{level.stem}.npy", method(file["coarse"][...]))


if __name__ == "__main__":
    main(*sys.argv[1:])
