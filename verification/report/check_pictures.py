#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the cells of a check.json with the places of its findings marked, sound or broken.

    check_pictures.py FOLDER

writes FOLDER/NAME.svg and FOLDER/NAME.png for every cell whose mesh could be read. Errors are
vermillion crosses, warnings blue rings, each with the number under which it stands below the
picture, so that the shape tells them apart as well.
"""
import json
import os
import sys
import textwrap

import h5py
import numpy

from figures import style

style.use()  # before anything draws

# pylint: disable=wrong-import-position
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402

MARKS = {"error": ("X", style.VERMILLION), "warning": ("o", style.BLUE)}
MOST_TRIANGLES = 20000  # beyond, edges of triangles would only be grey
MOST_TOLD = 12


def usable(vertices, triangles):
    """Triangles whose corners exist and are finite: of a broken mesh, what can be drawn."""
    if len(triangles) == 0 or len(vertices) == 0:
        return numpy.zeros(len(triangles), dtype=bool)
    inside = ((triangles >= 0) & (triangles < len(vertices))).all(axis=1)
    corners = vertices[numpy.clip(triangles, 0, len(vertices) - 1)]
    return inside & numpy.isfinite(corners).all(axis=(1, 2))


def draw(cell, vertices, triangles, material):
    """The mesh by group, marks with numbers, and the findings in words."""
    findings = cell["findings"]
    told = [f"{k}  {f['severity']}: {f['what']}" for k, f in enumerate(findings[:MOST_TOLD], 1)]
    if len(findings) > MOST_TOLD:
        told.append(f"and {len(findings) - MOST_TOLD} more in check.json")
    # A long path before the words would fill the picture.
    folder = os.path.join(os.path.dirname(cell["file"]), "")
    told = [text.replace(folder, "") if folder else text for text in told]
    words = (
        "\n".join("\n".join(textwrap.wrap(text, 100, subsequent_indent="    ")) for text in told)
        or "nothing found"
    )
    lines = words.count("\n") + 1
    figure, axes = pyplot.subplots(figsize=(7.0, 5.2 + 0.15 * lines), layout="constrained")
    keep = usable(vertices, triangles)
    numbers = [int(k) for k in numpy.unique(material[keep])]
    colours = style.colours_of_materials(numbers, cell.get("phase_stiffness"))
    corners = vertices[triangles[keep]]
    axes.add_collection(
        PolyCollection(
            corners,
            facecolors=[colours[int(k)] for k in material[keep]],
            edgecolors="#555555" if keep.sum() <= MOST_TRIANGLES else "none",
            linewidths=0.25,
            rasterized=keep.sum() > MOST_TRIANGLES,
        )
    )
    points = numpy.vstack([corners.reshape(-1, 2)] + [[f["point"]] for f in findings if f["point"]])
    low, high = points.min(axis=0), points.max(axis=0)
    pad = 0.08 * max((high - low).max(), 1e-300)
    axes.set(
        xlim=(low[0] - pad, high[0] + pad),
        ylim=(low[1] - pad, high[1] + pad),
        aspect="equal",
        xlabel="x [mesh units]",
        ylabel="y [mesh units]",
        title=cell["name"],
    )
    axes.grid(False)
    numbers_at = {}
    for number, finding in enumerate(findings, 1):
        if finding["point"]:
            marker, colour = MARKS[finding["severity"]]
            axes.plot(
                *finding["point"],
                marker=marker,
                markersize=11,
                markeredgecolor=colour if marker == "o" else "white",
                markeredgewidth=2.0 if marker == "o" else 0.8,
                zorder=5,
                linestyle="none",
                markerfacecolor="none" if marker == "o" else colour,
            )
            numbers_at.setdefault(tuple(finding["point"]), []).append(str(number))
    for point, told_there in numbers_at.items():
        axes.annotate(
            ", ".join(told_there),
            point,
            xytext=(8, 6),
            textcoords="offset points",
            zorder=6,
            fontweight="bold",
            color=style.BLACK,
            bbox={
                "boxstyle": "round,pad=0.15",
                "facecolor": "white",
                "edgecolor": "none",
                "alpha": 0.8,
            },
        )
    names = cell["phases"] if len(cell["phases"]) > max(numbers, default=0) else {}
    handles = [
        Patch(facecolor=colours[k], edgecolor="#555555", label=names[k] if names else f"group {k}")
        for k in numbers[:12]
    ]
    for severity, (marker, colour) in MARKS.items():
        if any(f["severity"] == severity for f in findings):
            handles.append(
                Line2D(
                    [],
                    [],
                    marker=marker,
                    linestyle="none",
                    markersize=8,
                    label=severity,
                    markerfacecolor="none" if marker == "o" else colour,
                    markeredgecolor=colour,
                )
            )
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.01, 1.0))
    figure.supxlabel(words, x=0.02, ha="left", fontsize=7.5, family="DejaVu Sans")
    return figure


def main(folder):
    """Draws every cell of a folder; returns how many could be drawn."""
    with open(os.path.join(folder, "check.json"), encoding="utf-8") as file:
        cells = json.load(file)["cells"]
    drawn = 0
    for cell in cells:
        if not cell["mesh"]:
            continue
        with h5py.File(os.path.join(folder, os.path.basename(cell["mesh"])), "r") as mesh:
            vertices, triangles, material = (
                mesh[name][:] for name in ("vertices", "triangles", "material")
            )
        if not usable(vertices, triangles).any():
            continue
        figure = draw(cell, vertices, triangles, material)
        for ending in ("svg", "png"):
            figure.savefig(os.path.join(folder, f"{cell['name']}.{ending}"))
        pyplot.close(figure)
        drawn += 1
    return drawn


if __name__ == "__main__":
    try:
        main(sys.argv[1])
    except OSError as error:
        print(
            (
                f"error: {error.filename or sys.argv[1]}: {error.strerror or error}; expected a"
                " folder of `homespun check` that can be read and written: make room, or give"
                " another --output"
            ),
            file=sys.stderr,
        )
        sys.exit(2)
