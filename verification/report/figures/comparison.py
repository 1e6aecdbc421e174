# SPDX-License-Identifier: MIT
"""Several cells, or versions of one: their errors in the same panels, their moduli in the same plots,
their pictures side by side.
"""
import numpy
from matplotlib import pyplot
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures import style
from figures.cell import draw_phases, phase_legend
from figures.plot_data import ROUND_OFF_NOTE, label_of
from figures.stiffness import draw_moduli
from figures.strain import MARKED_STRAIN, floored, limits
from read.schema import main_method

COLOURS = (
    style.BLUE,
    style.VERMILLION,
    style.GREEN,
    style.PURPLE,
    style.ORANGE,
    style.SKY,
    style.BLACK,
)
MARKERS = ("o", "s", "^", "D", "v")
PAPER, COARSE = "localized", "affine"
LINES = {"spoken of": "-", PAPER: ":", COARSE: "--"}
LABELS = {
    "spoken of": "the method that its page speaks of",
    PAPER: style.METHOD_LABELS[PAPER],
    COARSE: "coarse mesh alone",
}
KEY = "error_mean_per_cell"


def drawn(rows, reference):
    """Of the rows of one cell under one load and law those that are drawn: kind of line -> (method,
    its rows). The method of the paper stands apart only where the page speaks of another one.
    """
    some = [row for row in rows if row["reference"] == reference]
    spoken_of = main_method({row["method"] for row in some})
    methods = {"spoken of": spoken_of, COARSE: COARSE}
    if spoken_of != PAPER:
        methods[PAPER] = PAPER
    found = {
        kind: (method, [row for row in some if row["method"] == method])
        for kind, method in methods.items()
    }
    return {kind: pair for kind, pair in found.items() if pair[1]}


def comparison_figure(rows, references):
    """One panel per load; colour and marker tell the cell, full lines the method that its page
    speaks of, dots the paper's where that is another one, dashes the coarse mesh alone.

    @param rows name -> rows with an error
    @param references name -> the law that is shown
    @return figure, or None where fewer than two names have an error
    """
    lines_of = {
        (name, load): drawn([row for row in some if row["load"] == load], references.get(name))
        for name, some in rows.items()
        for load in {row["load"] for row in some}
    }
    names = [name for name in rows if any(lines_of[k] for k in lines_of if k[0] == name)]
    if len(names) < 2:
        return None
    kinds = {kind for found in lines_of.values() for kind in found}
    loads = style.ordered_loads({load for (_, load), found in lines_of.items() if found})
    columns = min(3, len(loads))
    lines = -(-len(loads) // columns)
    figure, grid = pyplot.subplots(
        lines,
        columns,
        squeeze=False,
        figsize=(0.9 + 2.9 * columns, 0.5 + 2.55 * lines),
        layout="constrained",
    )
    at_floor = False
    for axes, load in zip(grid.flat, loads):
        found = {name: lines_of.get((name, load), {}) for name in names}
        here = [row for some in found.values() for _, rows_of in some.values() for row in rows_of]
        lower, upper = limits(here, KEY, 1.0)
        for k, name in enumerate(names):
            colour, marker = (
                COLOURS[k % len(COLOURS)],
                MARKERS[(k // len(COLOURS) + k) % len(MARKERS)],
            )
            for kind, (method, some) in found[name].items():
                strain, value, low = floored(some, KEY, 1.0)
                if not len(strain):
                    continue
                label = label_of(f"{name}, {method}")
                axes.plot(
                    100 * strain,
                    numpy.where(low, lower, value),
                    ls=LINES[kind],
                    color=colour,
                    marker=marker if kind == "spoken of" else None,
                    markerfacecolor="white",
                    markevery=list(numpy.flatnonzero(~low)),
                    label=label,
                )
                if low.any():
                    at_floor = True
                    axes.plot(
                        100 * strain[low],
                        numpy.full(low.sum(), lower),
                        "v",
                        color=colour,
                        markerfacecolor="none",
                        clip_on=False,
                        zorder=5,
                        label=label,
                        gid=ROUND_OFF_NOTE,
                    )
        axes.axvline(100 * MARKED_STRAIN, color="#888888", lw=0.9, ls=(0, (1, 1.5)), zorder=1)
        style.log_axes(axes)
        axes.set(ylim=(lower, upper), xlabel="strain [%]")
        axes.set_title(load, loc="left", fontweight="bold")
        axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
    for axes in list(grid.flat)[len(loads) :]:
        axes.set_visible(False)
    for axes in grid[:, 0]:
        axes.set_ylabel("mean error [cell sides]")
    handles = [
        Line2D(
            [],
            [],
            color=COLOURS[k % len(COLOURS)],
            marker=MARKERS[(k // len(COLOURS) + k) % len(MARKERS)],
            markerfacecolor="white",
            label=label_of(name),
        )
        for k, name in enumerate(names)
    ]
    handles += [
        Line2D(
            [],
            [],
            color="#444444",
            ls=line,
            label=LABELS[kind],
        )
        for kind, line in LINES.items()
        if kind in kinds
    ]
    if at_floor:
        handles.append(
            Line2D(
                [],
                [],
                color="#444444",
                ls="",
                marker="v",
                markerfacecolor="none",
                label="zero to round-off, drawn at the lower edge",
            )
        )
    figure.legend(
        handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4, handlelength=2.8
    )
    return figure


def moduli_figure(stiffnesses, bendings):
    """The moduli of all along each direction, in one polar plot of tension and one of bending; None
    where fewer than two have one.

    @param stiffnesses, bendings name -> (3,3) [N/m, 1e-6 N m]
    """
    panels = [
        (title, matrices)
        for title, matrices in (
            ("tension, E(θ) [N/m]", stiffnesses),
            ("bending of a strip [10⁻⁶ N m]", bendings),
        )
        if len(matrices) > 1
    ]
    if not panels:
        return None
    figure, grid = pyplot.subplots(
        1, len(panels), squeeze=False, figsize=(4.6 * len(panels), 4.6),
        subplot_kw={"projection": "polar"}, layout="constrained",
    )
    names = list(dict.fromkeys(name for _, matrices in panels for name in matrices))
    looks = {name: style.line_of(k) for k, name in enumerate(names)}
    for axes, (title, matrices) in zip(grid[0], panels):
        draw_moduli(axes, {name: (C, *looks[name]) for name, C in matrices.items()}, title)
    handles = [
        Line2D([], [], color=colour, ls=line, lw=1.8, label=label_of(name))
        for name, (colour, line) in looks.items()
    ]
    figure.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4)
    return figure


def cells_figure(cells):
    """Cells side by side, each with its scale, its phases below it; None for fewer than two."""
    drawn = [cell for cell in cells if cell.vertices is not None]
    if len(drawn) < 2:
        return None
    columns = min(3, len(drawn))
    lines = -(-len(drawn) // columns)
    figure, grid = pyplot.subplots(
        lines, columns, squeeze=False, figsize=(3.7 * columns, 4.1 * lines), layout="constrained"
    )
    for axes, cell in zip(grid.flat, drawn):
        draw_phases(axes, cell)
        axes.set_title(cell.name, loc="left", fontweight="bold")
        axes.legend(
            handles=[
                Patch(facecolor=colour, edgecolor="#555555", label=label)
                for _, colour, label in phase_legend(cell)
            ],
            loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=2,
        )
    for axes in list(grid.flat)[len(drawn):]:
        axes.set_visible(False)
    return figure
