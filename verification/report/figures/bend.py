# SPDX-License-Identifier: MIT
"""Errors of a bent sheet in position and normal: of each method under each load as a dot with its
bar, and against curvature where they are not just proportional to it.
"""
import math

import numpy
from matplotlib import pyplot, ticker

from figures import style
from figures.plot_data import DASHES
from read.bend_results import LINEAR, NORMAL, POSITION, radius_of

LONG_DASH = (0, (8, 2, 2, 2, 2, 2))
# Name for readers, colour, dashes and mark of each method, in the order of what they have.
LOOKS = {
    "flat": ("flat triangles", style.PURPLE, LONG_DASH, "v"),
    "affine": ("homogenized sheet", style.VERMILLION, "--", "s"),
    "localized": ("with deflection of the cell", style.BLUE, ":", "^"),
    "affine+edges": ("with edges", style.GREEN, "-.", "D"),
    "full": ("all terms", style.BLACK, "-", "o"),
}
QUANTITIES = (
    (POSITION, "position error", "k ε²", "mm", 1e3),
    (NORMAL, "normal error", "k ε", "°", 180.0 / math.pi),
)
HEADER = ("load", "method", "quantity", "error", "bar", "unit", "size of the unit [m or rad]")
PROPORTIONAL = 1e-6  # levels of linear theory differ by less than this part


def look_of(method):
    return LOOKS.get(method, (method, *style.line_of(5), "X"))


def ordered_methods(rows):
    found = {row["method"] for row in rows}
    return [m for m in LOOKS if m in found] + sorted(found.difference(LOOKS))


def bar_ends(value, bar, least):
    """Where a bar begins and ends on a logarithmic axis, None where it is not known."""
    return (max(value - bar, least), value + bar) if bar > 0 else None


def dot_rows(sheets):
    """The numbers of dot_figure(), under HEADER."""
    return [
        [bent.load, method, what.name, what.relative(row), what.relative(row, "bar"),
         of_size, what.size(row)]
        for bent in sheets
        for what, _, of_size, *_ in QUANTITIES
        for method in ordered_methods(bent.rows.values())
        for row in [bent.rows[method]]
    ]


def dot_figure(sheets):
    """A row per load, in it a dot with its bar per method, in the size of a fluctuation and, above,
    in mm and degrees at the curvature of the sheets.
    """
    methods = ordered_methods(row for bent in sheets for row in bent.rows.values())
    figure, grid = pyplot.subplots(
        1, 2, sharey=True, layout="constrained", figsize=(8.6, 1.1 + 0.74 * len(sheets))
    )
    first = next(iter(sheets[0].rows.values()))
    for axes, (what, label, of_size, unit, factor) in zip(grid, QUANTITIES):
        values = [
            what.relative(row) for bent in sheets for row in bent.rows.values() if what.relative(row) > 0
        ]
        least = 0.5 * min(values, default=1.0)
        for k, method in enumerate(methods):
            words, colour, _, marker = look_of(method)
            places = [
                (i + 0.15 * (k - 0.5 * (len(methods) - 1)), bent.rows[method])
                for i, bent in enumerate(sheets)
                if bent.known(method, what)
            ]
            axes.plot(
                [what.relative(row) for _, row in places],
                [place for place, _ in places],
                marker,
                color=colour,
                markerfacecolor="white" if method != "full" else colour,
                markersize=5.5,
                label=words,
            )
            for place, row in places:
                if ends := bar_ends(what.relative(row), what.relative(row, "bar"), least):
                    axes.hlines(place, *ends, color=colour, linewidth=1.6, zorder=1)
        axes.set(xscale="log", xlabel=f"{label} [{of_size}]", xlim=(least, 2.0 * max(values, default=1.0)))
        axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
        axes.grid(axis="y", visible=False)
        for i in range(1, len(sheets)):
            axes.axhline(i - 0.5, color="#BDBDBD", linewidth=0.6, zorder=0)
        size = factor * what.size(first)
        above = axes.secondary_xaxis(
            "top", functions=(lambda x, s=size: s * x, lambda x, s=size: x / s)
        )
        above.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
        above.set_xlabel(f"{label} [{unit}] at a radius of {100.0 * radius_of(first):.3g} cm")
    grid[0].set_yticks(range(len(sheets)), [bent.load for bent in sheets])
    grid[0].set_ylim(len(sheets) - 0.5, -0.5)
    legend(figure, *grid[0].get_legend_handles_labels())
    return figure


def legend(figure, handles, labels):
    figure.legend(
        handles, labels, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=5, handlelength=3.4
    )


def inverse(value):
    return 1.0 / numpy.maximum(value, 1e-12)  # matplotlib asks at 0, too


def of_curve(rows, load, reference, method):
    return sorted(
        (r for r in rows if (r["load"], r["reference"], r["method"]) == (load, reference, method)),
        key=lambda row: row["curvature_times_cell"],
    )


def is_worth_a_figure(rows):
    """Whether errors are not just proportional to the curvature, as those of linear theory are."""
    for load, reference, method in {(r["load"], r["reference"], r["method"]) for r in rows}:
        values = [POSITION.relative(row) for row in of_curve(rows, load, reference, method)]
        values = [value for value in values if math.isfinite(value)]
        if values and max(values) - min(values) > PROPORTIONAL * max(values):
            return True
    return False


def draw_curves(axes, rows, load, what):
    """Under one load the curves of all methods, and what linear theory says as thin lines."""
    references = list(dict.fromkeys(row["reference"] for row in rows))
    least = 0.5 * min(
        (what.relative(row) for row in rows if row["load"] == load and what.relative(row) > 0),
        default=1.0,
    )
    for method in ordered_methods(rows):
        words, colour, dashes, marker = look_of(method)
        for reference in references:
            its = [
                row for row in of_curve(rows, load, reference, method) if what.relative(row) > 0
            ]
            if not its:
                continue
            x = numpy.array([row["curvature_times_cell"] for row in its])
            y = numpy.array([what.relative(row) for row in its])
            if reference == LINEAR and len(references) > 1:
                axes.plot(x, y, ":", color=colour, linewidth=0.9, label="_")
                continue
            (curve,) = axes.plot(
                x, y, ls=dashes, marker=marker, color=colour, markerfacecolor="white",
                label=words if reference == references[0] else f"{words}, {reference}",
            )
            curve.dashes = DASHES[dashes] if dashes in DASHES else list(dashes[1])
            for place, value, row in zip(x, y, its):
                if ends := bar_ends(value, what.relative(row, "bar"), least):
                    axes.vlines(place, *ends, color=colour, linewidth=1.0)


def curve_figure(rows, least_radius):
    """Errors in the size of a fluctuation against curvature x cell side: level where they are
    proportional to the curvature.

    @param rows of one cell, those of the reference that counts first
    @param least_radius from which on D^H holds [m], or None
    """
    loads = list(dict.fromkeys(row["load"] for row in rows))
    figure, grid = pyplot.subplots(
        len(loads), 2, squeeze=False, sharex=True, sharey="col", layout="constrained",
        figsize=(9.0, 0.8 + 1.9 * len(loads)),
    )
    limit = rows[0]["cell_side_m"] / least_radius if least_radius else math.inf
    for line, load in zip(grid, loads):
        for axes, (what, label, of_size, *_) in zip(line, QUANTITIES):
            draw_curves(axes, rows, load, what)
            style.log_axes(axes)
            axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
            axes.set_ylabel(f"{label} [{of_size}]")
            axes.set_title(load, loc="left", fontweight="bold")
            right = axes.get_xlim()[1]
            if limit < right:
                axes.axvspan(limit, right, color="#7F7F7F", alpha=0.15, linewidth=0)
                axes.axvline(limit, color="#7F7F7F", linewidth=0.9)
                axes.set_xlim(right=right)
    for axes in grid[-1]:
        axes.set_xlabel("curvature × cell side, k ε")
    for axes in grid[0]:
        above = axes.secondary_xaxis("top", functions=(inverse, inverse))
        above.set_xlabel("radius [cell sides]")
        above.xaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
        above.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
    handles = {}
    for axes in grid.flat:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    legend(figure, handles.values(), handles)
    return figure
