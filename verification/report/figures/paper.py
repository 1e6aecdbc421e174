# SPDX-License-Identifier: MIT
"""Figures for a paper: of an exact width, with letters of 7 to 9 pt, text as text, dashes and marks
that survive black-and-white print, and axes that end on round numbers.
"""
import math

import matplotlib
import numpy
from matplotlib import pyplot
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures import style
from figures.cell import draw_phases, phase_legend
from figures.plot_data import label_of
from figures.stiffness import draw_moduli
from figures.strain import draw_panel, limits

CM, MM, INCH = 1.0 / 2.54, 0.1 / 2.54, 1.0
UNITS = {"cm": CM, "mm": MM, "in": INCH}
WIDTHS = (4.0 * CM, 40.0 * CM)  # inches
RC = {
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.labelsize": 8,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "legend.fontsize": 7.5,
    "lines.linewidth": 1.0,
    "lines.markersize": 3.2,
    "axes.linewidth": 0.6,
    "grid.linewidth": 0.4,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
}
PER_LINE = 5.4 * CM  # width of a panel below which the next one starts a new line
LEGEND_LINE = 0.17  # inches
SHARE = 100.0  # errors are in percent of the cell side


def width_of(text):
    """Inches of `8.5cm`, `85mm` or `3.3in`.

    @throws ValueError saying what was expected
    """
    try:
        inches = float(text[:-2]) * UNITS[text[-2:]]
    except (ValueError, KeyError):
        inches = math.nan
    if not WIDTHS[0] <= inches <= WIDTHS[1]:
        raise ValueError(f"--width: found `{text}`, expected 4cm to 40cm, like 8.5cm, 180mm or 3.3in")
    return inches


def round_ends(low, high):
    """The next numbers 1, 2 or 5 times a power of ten around two positive ones."""
    steps = numpy.outer(10.0 ** numpy.arange(-16.0, 17.0), [1.0, 2.0, 5.0]).ravel()
    tiny = 1.0 + 1e-9
    return float(steps[steps <= low * tiny].max()), float(steps[steps >= high / tiny].min())


def with_legend(width, columns, lines, height, handles, polar=False):
    """(figure, axes as a list) of an exact width, with a legend above the panels."""
    across = max(1, min(len(handles), int(width / (3.6 * CM))))
    top = LEGEND_LINE * -(-len(handles) // across) + 0.05
    figure = pyplot.figure(figsize=(width, top + lines * height), layout="constrained")
    grid = figure.add_gridspec(lines + 1, columns, height_ratios=[top] + [height] * lines)
    legend = figure.add_subplot(grid[0, :])
    legend.axis("off")
    legend.legend(handles=handles, loc="center", ncol=across, handlelength=2.6, borderpad=0.0,
                  columnspacing=1.2, labelspacing=0.3)
    kind = {"projection": "polar"} if polar else {}
    return figure, [
        figure.add_subplot(grid[1 + i, j], **kind) for i in range(lines) for j in range(columns)
    ]


def strain_figure(rows, methods, reference, side, width):
    """Error against strain, a panel per load, one law.

    @param rows of one cell with an error, of the loads that are drawn
    """
    with matplotlib.rc_context(RC):
        loads = style.ordered_loads(row["load"] for row in rows)
        columns = max(1, min(len(loads), int(width / PER_LINE) or 1, 4))
        if len(loads) > 1 and columns == 1 and width >= 7.0 * CM:
            columns = 2
        lines = -(-len(loads) // columns)
        handles = []
        for method in methods:
            line, marker = style.method_style(method, methods)
            handles.append(
                Line2D([], [], color=style.method_colour(method, methods), ls=line, marker=marker,
                       markerfacecolor="white",
                       label=style.METHOD_LABELS.get(method, label_of(method)))
            )
        if any(row.get("error_bar_m", 0.0) > 0 for row in rows):
            handles.append(Patch(color="#BDBDBD", alpha=0.55, label="bar of the smallest error"))
        height = min(0.85 * width / columns + 0.25, 2.4)
        figure, every = with_legend(width, columns, lines, height, handles)
        lower, upper = limits(rows, "error_mean_per_cell", 1.0)
        low, high = round_ends(*(100.0 * end([row["strain"] for row in rows]) for end in (min, max)))
        for k, (axes, load) in enumerate(zip(every, loads)):
            draw_panel(
                axes, rows, load, methods, [reference], "error_mean_per_cell", 1.0, lower, side
            )
            axes.set(xlim=(low, high), ylim=(lower, upper))
            for drawn in axes.get_lines():
                drawn.set_clip_on(drawn.get_transform() != axes.transData)
            axes.yaxis.set_major_locator(decades(lower, upper))
            axes.yaxis.set_major_formatter(lambda y, _: f"{SHARE * y:g}")
            axes.tick_params(labelleft=k % columns == 0)
            axes.set_xlabel("strain [%]")
            if k % columns == 0:
                axes.set_ylabel("mean error [% of cell side]")
        for axes in every[len(loads):]:
            axes.set_visible(False)
        return figure


def decades(lower, upper):
    """Ticks at whole decades, at most six of them, both ends among them where that is possible."""
    first, last = (round(math.log10(end)) for end in (lower, upper))
    step = next(n for n in range(1, 40) if (last - first) / n <= 5)
    return matplotlib.ticker.FixedLocator([10.0**k for k in range(first, last + 1, step)])


def stiffness_figure(matrices, width):
    """Modulus along each direction of several cells or bounds.

    @param matrices name -> (3,3) [N/m]
    """
    with matplotlib.rc_context(RC):
        size = min(width, 9.0 * CM)
        looks = [style.line_of(k) for k in range(len(matrices))]
        handles = [
            Line2D([], [], color=colour, ls=line, label=label_of(name))
            for name, (colour, line) in zip(matrices, looks)
        ]
        figure, (axes,) = with_legend(width, 1, 1, size, handles, polar=True)
        draw_moduli(axes, {n: (C, *look) for (n, C), look in zip(matrices.items(), looks)})
        axes.tick_params(axis="y", labelsize=RC["ytick.labelsize"])
        return figure


def cell_figure(cell, width):
    """The cell with its phases, lattice vectors and the axes of its materials."""
    with matplotlib.rc_context(RC):
        handles = [Patch(facecolor=colour, edgecolor="#555555", label=label)
                   for _, colour, label in phase_legend(cell)]
        extent = numpy.ptp(cell.vertices, axis=0)
        height = min(width * extent[1] / extent[0], 1.6 * width)
        figure, (axes,) = with_legend(width, 1, 1, height, handles)
        draw_phases(axes, cell)
        return figure
