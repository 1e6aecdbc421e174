# SPDX-License-Identifier: MIT
"""Error against strain of several cells, or versions of one, in the same panels."""
import numpy
from matplotlib import pyplot
from matplotlib.lines import Line2D

from figures import style
from figures.plot_data import ROUND_OFF_NOTE
from figures.strain import MARKED_STRAIN, floored, limits

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
LINES = {"localized": "-", "affine": "--"}
KEY = "error_mean_per_cell"


def comparison_figure(rows, references):
    """One panel per load; colour and marker tell the cell, dashes the coarse mesh alone.

    @param rows name -> rows with an error
    @param references name -> the law that is shown
    @return figure, or None where fewer than two names have an error
    """
    rows = {
        name: [
            row
            for row in some
            if row["reference"] == references.get(name) and row["method"] in LINES
        ]
        for name, some in rows.items()
    }
    names = [name for name, some in rows.items() if some]
    if len(names) < 2:
        return None
    every = [row for name in names for row in rows[name]]
    loads = style.ordered_loads(row["load"] for row in every)
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
        here = [row for row in every if row["load"] == load]
        lower, upper = limits(here, KEY, 1.0)
        for k, name in enumerate(names):
            colour, marker = (
                COLOURS[k % len(COLOURS)],
                MARKERS[(k // len(COLOURS) + k) % len(MARKERS)],
            )
            for method, line in LINES.items():
                some = [
                    row for row in rows[name] if row["load"] == load and row["method"] == method
                ]
                strain, value, low = floored(some, KEY, 1.0)
                if not len(strain):
                    continue
                label = f"{name}, {method}"
                axes.plot(
                    100 * strain,
                    numpy.where(low, lower, value),
                    line,
                    color=colour,
                    marker=marker,
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
            label=name,
        )
        for k, name in enumerate(names)
    ]
    handles += [
        Line2D(
            [],
            [],
            color="#444444",
            ls=line,
            label={"affine": "coarse mesh alone"}.get(method, method),
        )
        for method, line in LINES.items()
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
