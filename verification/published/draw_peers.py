#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the errors of other methods beside homespun's under the linear law, the picture of
guides/own-method.md:

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

import numpy  # noqa: E402
from matplotlib import pyplot  # noqa: E402

from page.gallery import short_svg  # noqa: E402
from peers_section import cases, is_nearer  # noqa: E402

TESTED = {"strip-1": "strip-1", "strip-2": "strip-2", "shear-frame": "shear\nframe",
          "waves left and right": "waves\nleft, right", "waves below and above": "waves\nbelow, above"}
METHODS = (  # method, trained on, what it is called, marker, colour, filled
    ("flat", "", "flat surface (coarse mesh alone)", "s", style.VERMILLION, "full"),
    ("learned_32", "left and right", "learned, 32 weights, clamped left and right", "v",
     style.PURPLE, "full"),
    ("learned_32", "both pairs", "learned, 32 weights, both pairs of clamps", "D", style.SKY, "full"),
    ("pod", "both pairs", "nearest sum of both pairs' frames (POD, no method)", "D", style.SKY, "none"),
    ("localized", "", "localized (the paper's method)", "^", style.BLUE, "full"),
    ("full", "", "full", "o", style.BLACK, "full"))


def points_of(its_cases, k):
    """(x, error, bar, whether it is a peer that is nearer than `full`) of a method, one by one."""
    method, on, *_ = METHODS[k]
    for place, tested in enumerate(TESTED):
        its = its_cases[tested]
        if (method, on) in its:
            row, full = its[method, on], its.get(("full", ""))
            yield (place + 0.11 * (k - 2.5), float(row["error"]), float(row["error_bar"] or "nan"),
                   method.startswith("learned") and full is not None and is_nearer(row, full))


def figure(rows):
    """A panel per cell: what was tested along x, errors along y."""
    linear = [one for one in cases(rows) if one[2] == "linear"]
    cells = list(dict.fromkeys(cell for cell, *_ in linear))
    drawn, axes = pyplot.subplots(2, 2, figsize=(9.0, 6.6), sharex=True, sharey=True)
    ring, rings = {"linestyle": "none", "marker": "o", "markersize": 13, "fillstyle": "none",
                   "color": style.BLACK}, []
    for axis, cell in zip(axes.flat, cells):
        its_cases = {tested: its for of, tested, _, its in linear if of == cell}
        for k, (_, _, label, marker, colour, fill) in enumerate(METHODS):
            x, error, bar, is_ringed = map(numpy.array, zip(*points_of(its_cases, k)))
            axis.errorbar(x, error, bar, linestyle="none", marker=marker, color=colour,
                          fillstyle=fill, elinewidth=0.8, label=label)
            rings += axis.plot(x[is_ringed], error[is_ringed], **ring) if is_ringed.any() else []
        axis.set_yscale("log")
        axis.set_title(cell)
        axis.set_xticks(range(len(TESTED)), TESTED.values())
        axis.grid(axis="y", alpha=0.3)
    for axis in axes[:, 0]:
        axis.set_ylabel("error, 1/1000 of strain x cell side")
    n = sum(len(one.get_xdata()) for one in rings)
    n_cases = sum(("full", "") in its for *_, its in linear)
    handles, labels = axes.flat[0].get_legend_handles_labels()
    drawn.legend([*handles, pyplot.Line2D([], [], **{**ring, "markersize": 9})],
                 [*labels, f"learned and nearer than full by more than both bars: {n} of {n_cases}"],
                 loc="lower center", ncol=2, frameon=False)
    drawn.tight_layout(rect=(0.0, 0.15, 1.0, 1.0))
    return drawn


def main(path):
    with open(path, newline="", encoding="utf-8") as file:
        drawn = figure(list(csv.DictReader(file)))
    text = io.StringIO()
    drawn.savefig(text, format="svg", metadata={"Date": None})
    print(short_svg(text.getvalue()))


if __name__ == "__main__":
    main(*sys.argv[1:])
