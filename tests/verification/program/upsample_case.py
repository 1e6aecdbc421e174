# SPDX-License-Identifier: MIT
"""A coarse sheet of `layered` for tests of homespun upsample."""
import h5py
import numpy

from cli import LAYERED, InFolder, run


def coarse_sheet(cell, n):
    """Vertices (z = 0) and triangles of n x n cells, two triangles each, from cell.h5."""
    with h5py.File(cell) as file:
        lattice, low = file["lattice"][:], file["vertices"][:].min(axis=0)
    i, j = numpy.meshgrid(range(n + 1), range(n + 1))
    flat = low + i.reshape(-1, 1) * lattice[0] + j.reshape(-1, 1) * lattice[1]
    triangles = []
    for y in range(n):
        for x in range(n):
            a = y * (n + 1) + x
            triangles += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
    return numpy.column_stack([flat, numpy.zeros(len(flat))]), triangles


def write_obj(path, vertices, triangles):
    path.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist()) +
                    "".join("f " + " ".join(str(v + 1) for v in t) + "\n" for t in triangles),
                    encoding="utf-8")


class Upsampling(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.made = InFolder()
        cls.made.setUp()
        cls.addClassCleanup(cls.made.doCleanups)
        output = cls.made.folder / "cell"
        # Of linear elements, as the cells of scenes.
        result = run("homogenize", LAYERED, "--order", 1, "--output", output)
        assert result.returncode == 0, result.stderr
        cls.cell = output / "cell.h5"

    def setUp(self):
        super().setUp()
        self.rest, self.output = self.folder / "rest.obj", self.folder / "out"
        self.vertices, self.triangles = coarse_sheet(self.cell, 4)
        write_obj(self.rest, self.vertices, self.triangles)

    def frame(self, name, vertices=None, triangles=None):
        path = self.folder / name
        write_obj(path, self.vertices if vertices is None else vertices,
                  self.triangles if triangles is None else triangles)
        return path

    def moving(self, n, step=0.01):
        """Frames that stretch step by step along the first axis."""
        return [self.frame(f"f_{k}.obj", self.vertices * [1. + step * k, 1., 1.])
                for k in range(n)]

    def upsample(self, *arguments, status=0):
        result = run("upsample", self.cell, "--rest", self.rest, *arguments, "--output",
                     self.output)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        return result.stdout if status == 0 else result.stderr
