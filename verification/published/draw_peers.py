#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the errors of other methods beside homespun's, the picture of guides/own-method.md:

    draw_peers.py peers.csv > docs/pictures/peers.svg
"""
import csv
import io
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "report"))

# pylint: disable=wrong-import-position
from figures import style  # noqa: E402

style.use()  # before anything draws

from matplotlib import pyplot  # noqa: E402

from page.gallery import short_svg  # noqa: E402

TESTED = {"strip-1": "strip-1", "strip-2": "strip-2", "shear-frame": "shear\nframe",
          "waves left and right": "waves\nleft, right", "waves below and above": "waves\nbelow, above"}
METHODS = (  # method, trained on, what it is called, marker, colour, filled
    ("flat", "", "flat surface (coarse mesh alone)", "s", style.VERMILLION, "full"),
    ("learned_32", "left and right", "learned, 32 weights, clamped left and right", "v",
     style.PURPLE, "full"),
    ("learned_32", "both pairs", "learned, 32 weights, both pairs of clamps", "D", style.SKY, "full"),
    ("pod_bound", "both pairs", "bound: best sum of both pairs' frames", "D", style.SKY, "none"),
    ("localized", "", "localized (the paper's method)", "^", style.BLUE, "full"),
    ("full", "", "full", "o", style.BLACK, "full"))


def figure(rows):
    """A panel per cell: what was tested along x, errors along y."""
    cells = list(dict.fromkeys(row["cell"] for row in rows))
    drawn, axes = pyplot.subplots(2, 2, figsize=(9.0, 6.4), sharex=True, sharey=True)
    for axis, cell in zip(axes.flat, cells):
        for k, (method, on, label, marker, colour, fill) in enumerate(METHODS):
            points = [(place + 0.11 * (k - 2.5), float(row["error"])) for place, tested
                      in enumerate(TESTED) for row in rows
                      if (row["cell"], row["tested"], row["law"], row["method"],
                          row["trained_on"]) == (cell, tested, "linear", method, on)]
            axis.plot(*zip(*points), linestyle="none", marker=marker, color=colour, fillstyle=fill,
                      label=label)
        axis.set_yscale("log")
        axis.set_title(cell)
        axis.set_xticks(range(len(TESTED)), TESTED.values())
        axis.grid(axis="y", alpha=0.3)
    for axis in axes[:, 0]:
        axis.set_ylabel("error, 1/1000 of strain x cell side")
    drawn.legend(*axes.flat[0].get_legend_handles_labels(), loc="lower center", ncol=2,
                 frameon=False)
    drawn.tight_layout(rect=(0.0, 0.12, 1.0, 1.0))
    return drawn


def main(path):
    with open(path, newline="", encoding="utf-8") as file:
        drawn = figure(list(csv.DictReader(file)))
    text = io.StringIO()
    drawn.savefig(text, format="svg", metadata={"Date": None})
    print(short_svg(text.getvalue()))


if __name__ == "__main__":
    main(*sys.argv[1:])
