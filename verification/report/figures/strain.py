# SPDX-License-Identifier: MIT
"""The paper's Figure 3: error per vertex against strain, one panel per load.

Colour tells the method, line style and marker tell the reference law, the grey area the error bar
of the smallest error (the largest of the laws shown), the vertical line 1 % strain.
"""
import math

import numpy
from matplotlib import pyplot, ticker
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures import style
from figures.plot_data import DASHES, ROUND_OFF_NOTE, band, label_of
from read import schema

MARKED_STRAIN = 0.01  # real textiles hardly stretch more under their own weight
BAR_LABEL = "error bar of the smallest error"
FEW = 4  # strains that are all named at the axis


def series(rows, key, factor=1.0):
    """(strain, value) of rows in the order of strain, without empty fields."""
    pairs = sorted((row["strain"], factor * row[key]) for row in rows if not math.isnan(row[key]))
    return numpy.array([p[0] for p in pairs]), numpy.array([p[1] for p in pairs])


def errors_are_round_off(rows):
    """Whether an error, per cell side, is too small to tell from round-off."""
    return bool(rows) and all(
        row["error_mean_per_cell"] < style.ROUND_OFF
        for row in rows
        if not math.isnan(row["error_mean_per_cell"])
    )


def floored(rows, key, factor):
    """Strain, value and a mask of values that are round-off, judged by the error per cell side."""
    kept = sorted((row for row in rows if not math.isnan(row[key])), key=lambda row: row["strain"])
    strain = numpy.array([row["strain"] for row in kept])
    value = numpy.array([factor * row[key] for row in kept])
    low = numpy.array(
        [row[key] <= 0 or row["error_mean_per_cell"] < style.ROUND_OFF for row in kept], dtype=bool
    )
    return strain, value, low


def slope_triangle(axes, strain, value, slope):
    """A triangle of the given slope below the end of a curve, over one factor of three in strain.
    """
    x1, y1 = strain[-1], value[-1]
    x0 = x1 / 3.0
    y1 = y1 / 3.0
    y0 = y1 * (x0 / x1) ** slope
    axes.plot([100 * x0, 100 * x1, 100 * x1, 100 * x0], [y0, y0, y1, y0], color="#444444", lw=0.9)
    axes.annotate(
        f"{slope}",
        (100 * x1, math.sqrt(y0 * y1)),
        xytext=(2, 0),
        textcoords="offset points",
        fontsize=7.5,
        va="center",
        color="#444444",
    )


def curve_style(method, methods, reference, references):
    """(line style, marker) of a curve: of its law where there are several, else of its method; the
    line of a judged method is always its own.
    """
    of_method = style.method_style(method, methods)
    if len(references) < 2:
        return of_method
    line, marker = style.reference_style(reference)
    return of_method[0] if style.is_judged(method) else line, marker


def bars_of_smallest(rows, methods, references):
    """strain -> error bar [m] of the method with the smallest error, the largest of the laws."""
    bars = {}
    for strain, reference in {(row["strain"], row["reference"]) for row in rows}:
        some = [
            row
            for row in rows
            if (row["strain"], row["reference"]) == (strain, reference)
            and reference in references
            and row["method"] in methods
            and not math.isnan(row["error_mean_m"])
        ]
        if some:
            bar = min(some, key=lambda row: row["error_mean_m"]).get("error_bar_m", math.nan)
            if not math.isnan(bar):
                bars[strain] = max(bar, bars.get(strain, 0.0))
    return bars


def draw_panel(axes, rows, load, methods, references, key, factor, floor, side):
    """One load: all methods and references; returns whether round-off was drawn at the floor."""
    at_floor = False
    rows = [row for row in rows if row["load"] == load]
    if key == "error_mean_per_cell" and side:
        bars = sorted(
            (strain, bar / side)
            for strain, bar in bars_of_smallest(rows, methods, references).items()
            if bar / side > style.ROUND_OFF
        )
        if bars:
            strain, bar = numpy.array(bars).T
            band(axes, 100 * strain, bar, floor / 100.0, BAR_LABEL)
    for method in methods:
        for reference in references:
            some = [r for r in rows if r["method"] == method and r["reference"] == reference]
            strain, value, low = floored(some, key, factor)
            if not len(strain):
                continue
            line, marker = curve_style(method, methods, reference, references)
            colour = style.method_colour(method, methods)
            (curve,) = axes.plot(
                100 * strain,
                numpy.where(low, floor, value),
                ls=line,
                marker=marker,
                color=colour,
                markevery=list(numpy.flatnonzero(~low)),
                markerfacecolor="white",
                markeredgewidth=1,
                label=label_of(f"{method} against {reference}"),
            )
            curve.dashes = DASHES[line] if line in DASHES else list(line[1])
            if low.any():
                at_floor = True
                axes.plot(
                    100 * strain[low],
                    numpy.full(low.sum(), floor),
                    "v",
                    color=colour,
                    markerfacecolor="none",
                    clip_on=False,
                    zorder=5,
                    label=label_of(f"{method} against {reference}"),
                    gid=ROUND_OFF_NOTE,
                )
    if style.is_infinite(load) and key == "error_mean_per_cell":
        shared = schema.main_reference(r["reference"] for r in rows)
        some = [r for r in rows if r["method"] == "localized" and r["reference"] == shared]
        strain, value, low = floored(some, key, factor)
        if len(strain) > 1 and not low.any():
            slope_triangle(axes, strain, value, 2)
    axes.axvline(100 * MARKED_STRAIN, color="#888888", lw=0.9, ls=(0, (1, 1.5)), zorder=1)
    style.log_axes(axes)
    axes.set_title(load, loc="left", fontweight="bold")
    axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
    return at_floor


def limits(rows, key, factor):
    """A common range of decades for a row of panels, and the floor: its lowest line."""
    values = [
        factor * row[key]
        for row in rows
        if not math.isnan(row[key])
        and row[key] > 0
        and row["error_mean_per_cell"] >= style.ROUND_OFF
    ]
    low = any(
        not math.isnan(row[key]) and (row[key] <= 0 or row["error_mean_per_cell"] < style.ROUND_OFF)
        for row in rows
    )
    if not values:
        values = [factor * style.ROUND_OFF]
    lower = 10.0 ** math.floor(math.log10(min(values)) - (0.5 if low else 0.0))
    upper = 10.0 ** math.ceil(math.log10(max(values) * 1.2))
    return lower, upper


def close_limits(rows, key, factor):
    """limits() with ends at 1, 2 or 5 times a power of ten, where two such powers lie between."""
    lower, upper = limits(rows, key, factor)
    values = [factor * row[key] for row in rows if factor * row[key] > lower]
    steps = sorted(n * 10.0**k for n in (1, 2, 5)
                   for k in range(round(math.log10(lower)), round(math.log10(upper)) + 1))
    if not values or any(row["error_mean_per_cell"] < style.ROUND_OFF for row in rows):
        return lower, upper  # whose lower edge is for round-off
    low = max((step for step in steps if 1.1 * step <= min(values)), default=lower)
    high = min((step for step in steps if step >= 1.2 * max(values)), default=upper)
    whole = math.floor(math.log10(1.001 * high)) - math.ceil(math.log10(0.999 * low))
    return (low, high) if whole > 0 else (lower, upper)


def name_few_strains(axes, strains):
    """Ticks at the strains themselves where these are few; else they are those of log_axes()."""
    if len(strains) <= FEW:
        axes.xaxis.set_major_locator(ticker.NullLocator())
        axes.xaxis.set_minor_locator(ticker.FixedLocator([100 * strain for strain in strains]))
        axes.xaxis.set_minor_formatter(lambda x, _: f"{x:g}")
        axes.grid(axis="x", which="minor")


def shows_a_bar(figure):
    """Whether a grey area reaches into its panel."""
    return any(
        area.get_label() == BAR_LABEL and area.upper_edge[:, 1].max() > axes.get_ylim()[0]
        for axes in figure.axes for area in axes.collections
    )


def legend(figure, methods, references, uncertainty, at_floor):
    one_law = len(references) == 1
    entries = []
    for m in methods:
        line, marker = style.method_style(m, methods)
        if not one_law:
            line, marker = line if style.is_judged(m) else "-", None
        entries.append(
            Line2D(
                [],
                [],
                color=style.method_colour(m, methods),
                ls=line,
                marker=marker,
                markerfacecolor="white",
                lw=1.4 if one_law else 2.2,
                label=style.METHOD_LABELS.get(m, label_of(m)),
            )
        )
    for reference in [] if one_law else references:
        line, marker = style.reference_style(reference)
        entries.append(
            Line2D(
                [],
                [],
                color="#444444",
                ls=line,
                marker=marker,
                markerfacecolor="white",
                label=f"against {reference}",
            )
        )
    if uncertainty:
        below = "" if shows_a_bar(figure) else ", below the axis"
        entries.append(Patch(color="#BDBDBD", alpha=0.55, label=BAR_LABEL + below))
    if at_floor:
        entries.append(
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
    entries.append(Line2D([], [], color="#888888", lw=0.9, ls=(0, (1, 1.5)), label="1 % strain"))
    figure.legend(
        handles=entries,
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncol=4 if figure.get_figwidth() > 6.0 else 3,
        handlelength=2.8,
        columnspacing=1.6,
    )


def error_figure(
    rows, methods, references, side, key="error_mean_per_cell", panel=(2.9, 2.55)
):
    """Error against strain for all loads of one cell.

    @param panel width and height of each panel [inches]

    @param key error_mean_per_cell, or error_mean_per_fluctuation, which is drawn in percent
    @return (figure, whether round-off was drawn at the floor)
    """
    rows = [row for row in rows if row["method"] in methods and row["reference"] in references]
    loads = style.ordered_loads(row["load"] for row in rows)
    groups = [
        [load for load in loads if style.is_infinite(load)],
        [load for load in loads if not style.is_infinite(load)],
    ]
    groups = [group[i : i + 3] for group in groups for i in range(0, len(group), 3)]
    factor = 100.0 if key == "error_mean_per_fluctuation" else 1.0
    columns = max(len(group) for group in groups)
    figure, grid = pyplot.subplots(
        len(groups),
        columns,
        squeeze=False,
        sharex=True,
        figsize=(0.9 + panel[0] * columns, 0.5 + panel[1] * len(groups)),
        layout="constrained",
    )
    at_floor = False
    uncertainty = (
        key == "error_mean_per_cell"
        and any(row.get("error_bar_m", 0.0) > 0 for row in rows)
        and bool(side)
    )
    for group, line in zip(groups, grid):
        group_rows = [row for row in rows if row["load"] in group]
        lower, upper = close_limits(group_rows, key, factor)
        for axes, load in zip(line, group):
            at_floor |= draw_panel(axes, rows, load, methods, references, key, factor, lower, side)
            axes.set_ylim(lower, upper)
            name_few_strains(axes, sorted({row["strain"] for row in rows}))
            axes.tick_params(labelleft=axes is line[0], labelbottom=True)
            axes.set_xlabel("strain [%]")
        line[0].set_ylabel(
            "mean error [% of the fluctuation]" if factor == 100.0 else "mean error [cell sides]"
        )
        for axes in line[len(group) :]:
            axes.set_visible(False)
    legend(figure, methods, references, uncertainty, at_floor)
    return figure, at_floor
