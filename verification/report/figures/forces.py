# SPDX-License-Identifier: MIT
"""Force against strain: what a load takes of the resolved sheet, of the coarse cloth, and of the
affine motion; and how far the last two are from the first.

Colour tells the cloth. Line style and marker tell the law of the resolved sheet; the others are
shown beside one law, that of the coarse cloth.
"""
import math

import numpy
from matplotlib import pyplot
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures import style
from figures.plot_data import band

RESOLVED, COARSE, AFFINE = "resolved", "coarse", "affine"
COLOURS = {RESOLVED: style.BLACK, COARSE: style.BLUE, AFFINE: style.VERMILLION}
# Differences below this part of the force are what the solvers leave.
SOLVED = 1e-8
NAMES = {
    RESOLVED: "resolved",
    COARSE: "coarse cloth (affine and localized alike)",
    AFFINE: "affine motion in the resolved sheet",
}


def by_strain(rows, load, reference, method):
    """strain -> row of one curve, rows with a force alone."""
    return {
        row["strain"]: row
        for row in sorted(rows, key=lambda row: row["strain"])
        if (row["load"], row["reference"], row["method"]) == (load, reference, method)
        and not math.isnan(row["force_per_width_N_per_m"])
    }


def differences(rows, load, reference, method):
    """(strain, force of the method over that of the resolved sheet − 1, its bar), bar nan where it
    is not known.
    """
    resolved = by_strain(rows, load, reference, RESOLVED)
    result = []
    for strain, row in by_strain(rows, load, reference, method).items():
        force = resolved[strain]["force_per_width_N_per_m"] if strain in resolved else 0.0
        if force != 0.0:
            bar = resolved[strain]["reference_uncertainty_N_per_m"] / abs(force)
            result.append((strain, row["force_per_width_N_per_m"] / force - 1.0, bar))
    return result


def draw_forces(axes, rows, load, reference, references):
    """The curves of one load."""
    for law in references:
        line, marker = style.reference_style(law)
        for method in (RESOLVED, COARSE, AFFINE) if law == reference else (RESOLVED,):
            curve = by_strain(rows, load, law, method)
            if not curve:
                continue
            strain = 100.0 * numpy.array(list(curve))
            force = numpy.array([row["force_per_width_N_per_m"] for row in curve.values()])
            axes.plot(
                strain,
                force,
                line,
                marker=marker,
                color=COLOURS[method],
                markerfacecolor="white",
                markeredgewidth=1,
                lw=3.0 if method == COARSE else 1.0,  # seen below the resolved one
                zorder=2 if method == COARSE else 3,
                label=f"{method}, {law}",
            )
            if method == RESOLVED:
                bar = [row["reference_uncertainty_N_per_m"] for row in curve.values()]
                bar = numpy.nan_to_num(numpy.array(bar))
                axes.vlines(strain, force - bar, force + bar, color=style.BLACK, lw=2.4, zorder=1)
    axes.set_title(load, loc="left", fontweight="bold")
    axes.set_xlim(left=0.0)
    low, high = axes.get_ylim()
    axes.set_ylim(min(0.0, low), high)


def draw_differences(axes, rows, load, reference, floor):
    """How far coarse cloth and affine motion are from the resolved sheet, of one load."""
    known = [d for d in differences(rows, load, reference, COARSE) if d[2] > floor / 100.0]
    if known:
        strain, _, bar = numpy.array(known).T
        band(axes, 100 * strain, 100 * bar, floor, "bar of the resolved sheet")
    for method in (COARSE, AFFINE):
        of_method = differences(rows, load, reference, method)
        if not of_method:
            continue
        strain, part, _ = numpy.array(of_method).T
        line, marker = style.reference_style(reference)
        axes.plot(
            100 * strain,
            numpy.maximum(100 * abs(part), floor),
            line,
            marker=marker,
            color=COLOURS[method],
            markerfacecolor="white",
            markeredgewidth=1,
            label=f"|{method} − resolved|, {reference}",
        )
    style.log_axes(axes)
    axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
    axes.yaxis.set_major_formatter(lambda y, _: f"{y:g}")


def decades(rows, loads, reference):
    """A common range of decades for the differences of some loads [%]."""
    sizes = [
        100.0 * size
        for load in loads
        for method in (COARSE, AFFINE)
        for _, part, bar in differences(rows, load, reference, method)
        for size in (abs(part), bar)
        if size > SOLVED
    ] or [100.0 * SOLVED]
    return 10.0 ** math.floor(math.log10(min(sizes))), 10.0 ** math.ceil(
        math.log10(1.2 * max(sizes))
    )


def legend(figure, reference, references):
    entries = [
        Line2D([], [], color=COLOURS[method], lw=2.2, label=NAMES[method])
        for method in (RESOLVED, COARSE, AFFINE)
    ]
    for law in references:
        line, marker = style.reference_style(law)
        entries.append(
            Line2D(
                [],
                [],
                color="#444444",
                ls=line,
                marker=marker,
                markerfacecolor="white",
                label=f"{law}" + (" (all three)" if law == reference else " (resolved alone)"),
            )
        )
    entries.append(Patch(color="#BDBDBD", alpha=0.55, label="bar of the resolved sheet"))
    figure.legend(
        handles=entries,
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncol=3,
        handlelength=2.8,
        columnspacing=1.6,
    )


def force_figure(rows, reference, panel=(2.9, 2.2)):
    """Force per rest width against strain for all loads of one cell, and below each load the
    difference from the resolved sheet.

    @param rows of forces.csv
    @param reference law beside which coarse cloth and affine motion are shown
    @param panel width and height of each panel [inches]
    @return figure, or None where there is no force
    """
    rows = [row for row in rows if not math.isnan(row["force_per_width_N_per_m"])]
    if not any(row["reference"] == reference for row in rows):
        return None
    references = style.ordered_references(row["reference"] for row in rows)
    loads = style.ordered_loads(row["load"] for row in rows)
    groups = [
        [load for load in loads if style.is_infinite(load)],
        [load for load in loads if not style.is_infinite(load)],
    ]
    groups = [group[i : i + 3] for group in groups for i in range(0, len(group), 3)]
    columns = max(len(group) for group in groups)
    figure, grid = pyplot.subplots(
        2 * len(groups),
        columns,
        squeeze=False,
        figsize=(0.9 + panel[0] * columns, 0.5 + 2 * panel[1] * len(groups)),
        layout="constrained",
    )
    for k, group in enumerate(groups):
        low, high = decades(rows, group, reference)
        for column, load in enumerate(group):
            above, below = grid[2 * k][column], grid[2 * k + 1][column]
            draw_forces(above, rows, load, reference, references)
            draw_differences(below, rows, load, reference, low)
            below.set_ylim(low, high)
            below.tick_params(labelleft=column == 0)
            for axes in (above, below):
                axes.set_xlabel("strain [%]")
        grid[2 * k][0].set_ylabel(
            "nominal stress [N/m]" if style.is_infinite(group[0]) else "force per width [N/m]"
        )
        grid[2 * k + 1][0].set_ylabel("difference [% of the resolved]")
        for axes in (*grid[2 * k][len(group) :], *grid[2 * k + 1][len(group) :]):
            axes.set_visible(False)
    legend(figure, reference, references)
    return figure
