# SPDX-License-Identifier: MIT
"""Margins of the stress cases, and what the solver of the cell problem costs against what makes it
hard.
"""
import math

import numpy
from matplotlib import pyplot, ticker
from matplotlib.lines import Line2D

from figures import style

# Figures below this part of their limit are drawn at the edge, with those that are zero.
LOWEST = 1e-9
MARKS = {
    "PASS": ("o", style.BLUE),
    "FAIL": ("X", style.VERMILLION),
    "INCONCLUSIVE": ("D", style.ORANGE),
}

# label, whether its axis is logarithmic
PARAMETERS = {
    "contrast": ("contrast of Young's moduli", True),
    "poisson": ("Poisson's ratio", False),
    "anisotropy": ("anisotropy of the yarns, E1/E2", True),
    "sliver": ("height of the slivers / edge", True),
    "triangles": ("triangles", True),
}
ORDER_LINES = {1: ("-", "o"), 2: ("--", "s")}


def limit_of(row):
    """The number at the head of a limit, nan where it is words."""
    try:
        return float(row["limit"].split()[0])
    except (ValueError, IndexError):
        return math.nan


def margin(row):
    """Figure over limit; nan where the case gave no number."""
    figure, limit = row["figure"], limit_of(row)
    if not limit > 0.0 or not math.isfinite(figure):
        return math.nan
    return figure / limit


def margin_table(rows):
    """(header, rows) of the CSV file: every case in the order of its file, empty where a figure or
    limit is no number.
    """
    header = ["group", "case", "verdict", "figure", "limit", "figure_over_limit"]
    return header, [
        [
            row["group"],
            row["case"],
            row["verdict"],
            row["figure"] if row["figure"] == row["figure"] else "",
            row["limit"],
            margin(row) if margin(row) == margin(row) else "",
        ]
        for row in rows
    ]


def margin_figure(rows):
    """One line per group, a mark per case at its figure over its limit; right of 1 a case fails.

    Places of marks are drawing, not data (cases of a line stand apart, zero at the edge): the
    numbers are `margin_table`'s. Of the cases of a group that fail the worst is named. Those without
    a number are counted beside the line.
    @return figure, or None where no case has a figure and a limit
    """
    groups = list(dict.fromkeys(row["group"] for row in rows))
    if not any(margin(row) == margin(row) for row in rows):
        return None
    largest = max((m for m in map(margin, rows) if m == m), default=1.0)
    right = 10.0 ** math.ceil(math.log10(max(10.0, largest)) + 0.5)
    figure, axes = pyplot.subplots(figsize=(9.2, 0.9 + 0.46 * len(groups)), layout="constrained")
    axes.axvspan(1.0, right, color=style.VERMILLION, alpha=0.07, lw=0)
    axes.axvline(1.0, color=style.BLACK, lw=1.0)
    failed, counts = [], []
    for line, group in enumerate(groups):
        some = [row for row in rows if row["group"] == group]
        for verdict, (mark, colour) in MARKS.items():
            shown = [
                (k, row)
                for k, row in enumerate(some)
                if row["verdict"] == verdict and margin(row) == margin(row)
            ]
            x = numpy.array([max(LOWEST, margin(row)) for _, row in shown])
            # Cases of a group stand in their order from top to bottom of the line, so that marks do
            # not cover each other.
            y = numpy.array([line + 0.62 * ((k + 0.5) / len(some) - 0.5) for k, _ in shown])
            low = numpy.array([margin(row) < LOWEST for _, row in shown], dtype=bool)
            if len(x):
                axes.plot(
                    x[~low],
                    y[~low],
                    mark,
                    color=colour,
                    ms=3.5 if verdict == "PASS" else 6.5,
                    alpha=0.75,
                    mew=0,
                    zorder=3 if verdict == "PASS" else 5,
                )
                axes.plot(x[low], y[low], "<", color=colour, ms=3.5, alpha=0.75, mew=0, zorder=3)
            if verdict == "FAIL" and shown:
                worst = max(range(len(shown)), key=lambda k: x[k])
                more = f" (and {len(shown) - 1} more)" if len(shown) > 1 else ""
                failed.append((x[worst], y[worst], shown[worst][1]["case"], more))
        words = [f"{sum(row['verdict'] == 'PASS' for row in some)}/{len(some)}"]
        unplaced = sum(margin(row) != margin(row) for row in some)
        if unplaced:
            words.append(f"{unplaced} without a number")
        counts.append(", ".join(words))
    for u, v, name, more in failed:
        label = axes.annotate(
            (name if len(name) < 62 else name[:60] + " …") + more,
            (u, v),
            xytext=(-6, 0),
            textcoords="offset points",
            ha="right",
            va="center",
            fontsize=6.8,
            color="#8A3C00",
            zorder=6,
            bbox={"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 0.6},
        )
        label.set_in_layout(False)
    axes.set(
        xscale="log",
        xlim=(0.6 * LOWEST, right),
        ylim=(len(groups) - 0.5, -0.5),
        yticks=range(len(groups)),
        xlabel="figure / limit",
    )
    axes.set_yticklabels(groups)
    beside = axes.secondary_yaxis("right")
    beside.set_yticks(range(len(groups)), counts)
    beside.tick_params(length=0.0)
    beside.spines["right"].set_visible(False)
    axes.xaxis.set_major_locator(ticker.LogLocator(numticks=20))
    axes.xaxis.set_minor_locator(ticker.NullLocator())
    axes.grid(axis="y", visible=False)
    for line in range(1, len(groups)):
        axes.axhline(line - 0.5, color="#E5E5E5", lw=0.5, zorder=0)
    handles = [
        Line2D([], [], ls="", marker=mark, color=colour, mew=0, ms=5, label=name)
        for name, (mark, colour), in (("within its limit", MARKS["PASS"]), ("fails", MARKS["FAIL"]))
    ]
    if any(row["verdict"] == "INCONCLUSIVE" for row in rows):
        mark, colour = MARKS["INCONCLUSIVE"]
        handles.append(Line2D([], [], ls="", marker=mark, color=colour, mew=0, ms=5, label="open"))
    handles.append(
        Line2D(
            [],
            [],
            ls="",
            marker="<",
            color="#444444",
            mew=0,
            ms=5,
            label=f"zero, or below 10{style.three(LOWEST).split('10')[-1]} of its limit",
        )
    )
    figure.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4)
    return figure


def panels_of(rows):
    """Known parameters in their order, then the others by name."""
    there = {row["parameter"] for row in rows}
    return [name for name in PARAMETERS if name in there] + sorted(there.difference(PARAMETERS))


def solver_figure(rows, key):
    """Iterations or seconds against each parameter, one panel each; P1 solid, P2 dashed, colour
    tells the cell.

    Where the solver gave up, a cross stands at the upper edge.
    @param key iterations, or seconds (preconditioner and solve)
    @return figure, or None where no row has the number
    """
    if not any(row[key] > 0 for row in rows):
        return None
    panels = panels_of(rows)
    columns = min(3, len(panels))
    lines = -(-len(panels) // columns)
    figure, grid = pyplot.subplots(
        lines,
        columns,
        squeeze=False,
        layout="constrained",
        figsize=(0.8 + 2.9 * columns, 0.3 + 2.75 * lines),
    )
    colours = (style.BLUE, style.ORANGE, style.GREEN, style.PURPLE)
    for axes, parameter in zip(grid.flat, panels):
        some = [row for row in rows if row["parameter"] == parameter]
        cells = list(dict.fromkeys(row["cell"] for row in some))
        label, is_log = PARAMETERS.get(
            parameter, (parameter, all(row["value"] > 0 for row in some))
        )
        if is_log:
            axes.set_xscale("log")
        axes.set_yscale("log")
        for cell in cells:
            colour = colours[cells.index(cell) % len(colours)]
            for order, (line, mark) in ORDER_LINES.items():
                series = sorted(
                    (row["value"], row[key])
                    for row in some
                    if row["cell"] == cell and row["order"] == order and row[key] > 0
                )
                if series:
                    axes.plot(
                        *numpy.array(series).T,
                        line,
                        marker=mark,
                        color=colour,
                        markerfacecolor="white",
                        label=f"{cell}, P{order}",
                    )
                gave_up = [
                    row["value"]
                    for row in some
                    if row["cell"] == cell
                    and row["order"] == order
                    and row["outcome"] != "converged"
                ]
                if gave_up:
                    axes.plot(
                        gave_up,
                        [0.97] * len(gave_up),
                        "X",
                        color=style.VERMILLION,
                        ms=7,
                        mew=0,
                        transform=axes.get_xaxis_transform(),
                        zorder=5,
                    )
        axes.set_xlabel(label)
        axes.yaxis.set_major_formatter(lambda y, _: f"{y:g}")
        axes.yaxis.set_minor_formatter(ticker.NullFormatter())
        if is_log:
            axes.xaxis.set_minor_locator(ticker.NullLocator())
        handles = [
            Line2D([], [], color=colours[k % len(colours)], label=cell)
            for k, cell in enumerate(cells)
        ]
        axes.legend(handles=handles, loc="best", fontsize=7, handlelength=1.5)
    shared = [axes for axes in grid.flat][: len(panels)]
    if key == "iterations":  # one range for all, so that panels compare
        low, high = min(a.get_ylim()[0] for a in shared), max(a.get_ylim()[1] for a in shared)
        for axes in shared:
            axes.set_ylim(low, high)
            axes.yaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
    for axes in grid[:, 0]:
        axes.set_ylabel("iterations" if key == "iterations" else "preconditioner and solve [s]")
    for axes in list(grid.flat)[len(panels) :]:
        axes.set_visible(False)
    handles = [
        Line2D(
            [],
            [],
            color="#444444",
            ls=line,
            marker=mark,
            markerfacecolor="white",
            label=f"P{order}",
        )
        for order, (line, mark) in ORDER_LINES.items()
    ]
    if any(row["outcome"] != "converged" for row in rows):
        handles.append(
            Line2D([], [], ls="", marker="X", color=style.VERMILLION, mew=0, label="gave up")
        )
    figure.legend(
        handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3, handlelength=2.8
    )
    return figure
