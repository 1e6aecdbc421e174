#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws garments that `homespun upsample` made, side by side, whole and close up.

    garment_picture.py PICTURE.png SIDE TITLE FRAME.vtu [SIDE TITLE FRAME.vtu ...]

SIDE: of a cell [m]; the close-up is ten of them wide. The guide on simulations has the frame
`pulled.obj`, a skirt that is stretched around by 12 %, its `vt` scaled so that cells are seen, with
`--method full` of the cells `honeycomb`, `hexagonal-dots` and `plain-weave`.
"""
import io
import pathlib
import sys

import numpy
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "report"))

# pylint: disable=wrong-import-position
from figures import style  # noqa: E402

style.use()  # before anything draws

from matplotlib import pyplot  # noqa: E402

from figures.cloth import fine_colours, phase_colour_map  # noqa: E402
from figures.rendering import (axes_of, bounds, camera_around, close_up, render)  # noqa: E402
from read.vtu import read_vtu  # noqa: E402

PIXELS = 420  # width of a panel
UP = numpy.array([0.0, 0.0, 1.0])


def main(path, *garments):
    """Draws the picture."""
    columns = list(zip(garments[0::3], garments[1::3], garments[2::3]))
    figure, grid = pyplot.subplots(2, len(columns), layout="constrained", squeeze=False,
                                   figsize=(3.6 * len(columns), 6.2))
    for column, (side, title, frame) in enumerate(columns):
        surface = read_vtu(frame)
        axes = axes_of(250.0, 15.0, UP)
        whole = camera_around(axes, [bounds(surface, axes)])
        near = close_up(whole, surface, 10.0 * float(side))
        colours = fine_colours(surface, phase_colour_map([surface], None))
        for place, camera in zip(grid[:, column], (whole, near)):
            place.imshow(render(surface, camera, PIXELS, colours), interpolation="antialiased")
            place.set(xticks=[], yticks=[])
            place.grid(False)
            for spine in place.spines.values():
                spine.set(visible=camera is near, color="#999999")
        grid[0, column].set_title(title, fontweight="bold", fontsize=12)
    with io.BytesIO() as picture:
        figure.savefig(picture, dpi=90, facecolor="white")
        Image.open(picture).convert("RGB").quantize(256).save(path, optimize=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
