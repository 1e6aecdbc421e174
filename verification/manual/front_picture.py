#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the picture of the front page: coarse mesh, up-sampled and resolved sheet, and the error,
whole and close up.

    front_picture.py FOLDER LOAD STRAIN CELLS PICTURE.png

FOLDER: of a cell in a folder of `homespun strain`; CELLS: how many cells the close-up is wide.
Prints the mean errors. The front page has

    front_picture.py out/figure3/three-stiffness shear-frame 0.1 4 docs/pictures/front.png
"""
import io
import pathlib
import sys

import h5py
import numpy
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "report"))

# pylint: disable=wrong-import-position
from figures import style  # noqa: E402

style.use()  # before anything draws

from matplotlib import pyplot  # noqa: E402
from matplotlib.patches import Rectangle  # noqa: E402

from figures.cloth import ERROR_MAP, panels, phase_colour_map  # noqa: E402
from figures.rendering import Camera, bounds, camera_around  # noqa: E402
from figures.sheet import unit_of  # noqa: E402
from read.vtu import Surface, read_vtu  # noqa: E402

TITLES = {"coarse": "coarse mesh", "fine": "up-sampled", "reference": "resolved",
          "error": "error of up-sampling"}
PIXELS = 560  # width of a panel
FRONT = numpy.eye(3)  # camera axes: right, up, towards the eye


def surfaces_of(folder, load, strain):
    """({kind: Surface}, side of a cell [m], {method: mean error in cell sides})"""
    sheet = read_vtu(folder / f"sheet-{load}-{strain}.vtu")
    fields = {name.removesuffix(" [m]"): value for name, value in sheet.point_data.items()}
    phase = sheet.cell_data["phase"].reshape(-1)
    with h5py.File(folder / f"fields-{load}.h5", "r") as file:
        rest, triangles = file["coarse_rest"][...], file["coarse_triangles"][...].astype(int)

    def moved(by):
        points = sheet.points + fields[f"displacement {by}"]
        return Surface(points, sheet.triangles, cell_data={"material": phase})

    # Vertices of the coarse mesh are corners of cells, which the fine mesh has too.
    at = [numpy.argmin(numpy.hypot(*(sheet.points[:, :2] - point).T)) for point in rest]
    side = numpy.sqrt(2.0 * numpy.ptp(rest, axis=0).prod() / len(triangles))
    errors = {name: fields[f"error {name}"].mean() / side for name in ("affine", "localized")}
    return {
        "coarse": Surface(moved("affine").points[at], triangles),
        "fine": moved("localized"),
        "reference": moved("reference"),
    }, side, errors


def draw(surfaces, width, path):
    """Two rows through two cameras, the second one so wide [m]."""
    error = numpy.linalg.norm(surfaces["fine"].points - surfaces["reference"].points, axis=1)
    largest = float(numpy.percentile(error, 99.5))
    whole = camera_around(FRONT, [bounds(surface, FRONT) for surface in surfaces.values()])
    # At a free edge, where the error is largest.
    extent = whole.extent * width / whole.extent[0]
    near = Camera(FRONT, whole.centre + numpy.array([0.3, 0.0]) * whole.extent, extent)
    phases = phase_colour_map([surfaces["fine"]], None)
    ratio = whole.extent[1] / whole.extent[0]
    figure, grid = pyplot.subplots(2, len(TITLES), layout="constrained",
                                   figsize=(12.0, 2 * 2.75 * ratio + 0.4))
    for row, camera in zip(grid, (whole, near)):
        images = {}
        for kind, surface in surfaces.items():
            images |= panels(surface, kind, camera, PIXELS, phases,
                             error if kind == "fine" else None, largest)
        half = 0.5 * camera.extent
        for place, (kind, title) in zip(row, TITLES.items()):
            place.imshow(images[kind], extent=(-half[0], half[0], -half[1], half[1]),
                         interpolation="antialiased")
            place.set(xticks=[], yticks=[])
            place.grid(False)
            for spine in place.spines.values():
                spine.set(visible=camera is near, color="#999999")
            if camera is whole:
                place.set_title(title, fontweight="bold", fontsize=13)
                place.add_patch(Rectangle(near.centre - whole.centre - 0.5 * near.extent,
                                          *near.extent, fill=False, edgecolor=style.BLACK))
    factor, unit = unit_of(largest)
    figure.colorbar(pyplot.cm.ScalarMappable(pyplot.Normalize(0.0, factor * largest), ERROR_MAP),
                    ax=grid, location="right", shrink=0.6, pad=0.01, extend="max",
                    label=f"distance from the resolved sheet [{unit}]")
    with io.BytesIO() as picture:
        figure.savefig(picture, dpi=100, facecolor="white")
        # A palette: a front page is loaded often.
        Image.open(picture).convert("RGB").quantize(256).save(path, optimize=True)


def main(folder, load, strain, cells, path):
    """Draws the picture and prints what its caption needs."""
    surfaces, side, errors = surfaces_of(pathlib.Path(folder), load, strain)
    draw(surfaces, float(cells) * side, path)
    print(", ".join(f"{name} {value:.3g} cell sides" for name, value in errors.items()))


if __name__ == "__main__":
    main(*sys.argv[1:])
