# SPDX-License-Identifier: MIT
"""A cell from arrays, homogenized; 12 x 12 of it hung at two corners, up-sampled, drawn.

example.py PICTURE.png
"""
import sys

import matplotlib
import numpy

import homespun

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# A disc of stiff print, 5 mm wide, on a soft ground; cells of 1 cm, 24 x 24 squares cut in two.
n, side = 24, 0.01
x = numpy.linspace(0., side, n + 1)
vertices = numpy.array([(a, b) for b in x for a in x])
corner = numpy.add.outer(numpy.arange(n) * (n + 1), numpy.arange(n)).ravel()
triangles = numpy.concatenate([corner[:, None] + (0, 1, n + 2), corner[:, None] + (0, n + 2, n + 1)])
centres = vertices[triangles].mean(axis=1)
groups = (numpy.hypot(*(centres - side / 2).T) < side / 4).astype(int)
cell = homespun.homogenize(
    vertices=vertices, triangles=triangles, groups=groups, order=1,
    phases=[{"E": 1e6, "nu": 0.3, "thickness": 5e-4, "density": 300.},
            {"E": 2e7, "nu": 0.4, "thickness": 6e-4, "density": 1000.}])
print("C^H [N/m]:\n", cell.stiffness.round(1))

# The coarse cloth: two triangles per cell, held at two corners, of which one comes nearer by 3 cm
# in one of two seconds.
sheet = homespun.Sheet(cell, 12, 12)
rest = sheet.coarse_vertices
left, *_, right = numpy.flatnonzero(rest[:, 1] > rest[:, 1].max() - 1e-9)
standing = numpy.column_stack([rest[:, 0], numpy.zeros(len(rest)), rest[:, 1]])
cloth = homespun.Cloth(cell, rest, sheet.coarse_triangles, positions=standing,
                       held=[left, right], damping=2.)
upsampler = homespun.Upsampler(cell, sheet)
fine = numpy.empty((upsampler.n_fine, 3), dtype=numpy.float32)
for step in range(200):
    cloth.prescribe(right, [0.12 - 0.03 * min(step / 100, 1.), 0., 0.12])
    cloth.step(0.01)
    upsampler.upsample(cloth.positions, out=fine)

figure, axes = plt.subplots(figsize=(6, 6))
axes.tripcolor(fine[:, 0] * 100, fine[:, 2] * 100, sheet.triangles,
               facecolors=sheet.material.astype(float), cmap="cividis", rasterized=True)
axes.set(aspect="equal", xlabel="x [cm]", ylabel="z [cm]",
         title=f"{len(sheet.triangles)} triangles from {len(sheet.coarse_triangles)}")
figure.savefig(sys.argv[1], dpi=150, bbox_inches="tight")
