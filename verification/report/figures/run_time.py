# SPDX-License-Identifier: MIT
"""Run time: the lower half of the paper's Figure 3, the parts of a load step, and error against
time.
"""
import math
from statistics import median

import numpy
from matplotlib import pyplot
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures import style
from figures.plot_data import ROUND_OFF_NOTE, label_of, name_unseen
from figures.strain import series
from read.schema import main_method

METHOD = "localized"


def of_main_method(rows):
    """Those of the method that a page speaks of, load by load and law by law."""
    methods = {}
    for row in rows:
        methods.setdefault((row["load"], row["reference"]), set()).add(row["method"])
    return [
        row
        for row in rows
        if row["method"]
        == main_method(methods[row["load"], row["reference"]])
    ]


def positive(rows, *keys):
    return [row for row in rows if all(row[key] > 0 for key in keys)]


def run_time_figure(rows, reference):
    """Seconds against strain: coarse solve with up-sampling, and the full-resolution solve.

    @return figure, or None where no row has both times
    """
    rows = positive(
        [row for row in of_main_method(rows) if row["reference"] == reference],
        "seconds_method",
        "seconds_reference",
    )
    loads = style.ordered_loads(row["load"] for row in rows)
    groups = [
        (
            "infinite cloth, one periodic cell",
            [load for load in loads if style.is_infinite(load)],
        ),
        ("sheet", [load for load in loads if not style.is_infinite(load)]),
    ]
    groups = [(title, group) for title, group in groups if group]
    if not groups:
        return None
    figure, grid = pyplot.subplots(
        1,
        len(groups),
        squeeze=False,
        sharey=True,
        layout="constrained",
        figsize=(0.6 + 4.3 * len(groups), 3.4),
    )
    for axes, (title, group) in zip(grid[0], groups):
        for load in group:
            some = [row for row in rows if row["load"] == load]
            for key, line, what in (
                ("seconds_reference", "-", "full resolution"),
                ("seconds_method", "--", "coarse"),
            ):
                strain, value = series(some, key)
                axes.plot(
                    100 * strain,
                    value,
                    line,
                    color=style.load_colour(load),
                    marker=style.load_marker(load),
                    markerfacecolor="white",
                    label=f"{load}, {what}",
                )
        ratios = [
            row["seconds_reference"] / row["seconds_method"] for row in rows if row["load"] in group
        ]
        if title == "sheet":  # an endless cloth has no coarse solve that could be faster
            title += f": {style.three(float(median(ratios)))} times faster"
        axes.set_title(title, loc="left")
        style.log_axes(axes)
        axes.set_xlabel("strain [%]")
        axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
    grid[0][0].set_ylabel("time per strain level [s]")
    handles = [
        Line2D([], [], color="#444444", label=f"full resolution ({reference})"),
        Line2D([], [], color="#444444", ls="--", label="coarse solve and up-sampling"),
    ]
    handles += [
        Line2D(
            [],
            [],
            color=style.load_colour(load),
            marker=style.load_marker(load),
            markerfacecolor="white",
            label=load,
        )
        for load in loads
    ]
    figure.legend(
        handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4, handlelength=2.8
    )
    return figure


def step_figure(steps):
    """Parts of one load step as bars, for each load and reference; None without times."""
    steps = positive(steps, "seconds_coarse_solve", "seconds_upsample", "seconds_fine_step")
    if not steps:
        return None
    loads = style.ordered_loads(step["load"] for step in steps)
    references = style.ordered_references(step["reference"] for step in steps)
    shades = style.ramp("#F2B48C", style.VERMILLION, "#8A3A00", number=len(references))
    bars = [
        ("seconds_coarse_solve", None, "coarse solve", style.BLUE),
        ("seconds_upsample", None, "up-sampling", style.SKY),
    ]
    bars += [
        ("seconds_fine_step", reference, f"full resolution, {reference}", shades[i])
        for i, reference in enumerate(references)
    ]
    height = 0.8 / len(bars)
    figure, axes = pyplot.subplots(
        figsize=(9.2, 0.8 + 0.13 * (len(bars) + 1.5) * len(loads)), layout="constrained"
    )
    lower = 10.0 ** math.floor(
        math.log10(min(step[key] for step in steps for key, *_ in bars)) - 0.3
    )
    for i, load in enumerate(loads):
        some = [step for step in steps if step["load"] == load]
        for k, (key, reference, label, colour) in enumerate(bars):
            its = [step for step in some if reference in (None, step["reference"])]
            if not its:
                continue
            value, y = median(step[key] for step in its), i - 0.4 + (k + 0.5) * height
            axes.barh(y, value - lower, 0.9 * height, left=lower, color=colour, label=label)
            if reference:  # over the coarse steps beside it, as tables.step_rows() has them
                light = sum(median(step[part] for step in its) for part, *_ in bars[:2])
                axes.annotate(
                    f"{style.three(float(value / light))} ×",
                    (value, y),
                    xytext=(4, 0),
                    textcoords="offset points",
                    va="center",
                    fontsize=7.5,
                )
    axes.set(xscale="log", xlabel="median time per load step [s]", ylim=(len(loads) - 0.4, -0.6))
    axes.set_xlim(left=lower)
    axes.set_yticks(range(len(loads)), loads)
    name_unseen(axes.yaxis, "load")
    axes.grid(axis="y", visible=False)
    figure.legend(
        handles=[Patch(color=colour, label=label) for _, _, label, colour in bars],
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncol=len(bars),
    )
    return figure


def error_time_figure(rows, methods, reference, strains, side):
    """Mean error against run time, one panel per strain; the full solve stands at its own
    uncertainty.

    @return figure, or None without times
    """
    rows = positive(
        [row for row in rows if row["reference"] == reference and row["method"] in methods],
        "seconds_method",
    )
    rows = [row for row in rows if not math.isnan(row["error_mean_per_cell"])]
    strains = [s for s in strains if any(row["strain"] == s for row in rows)]
    if not strains:
        return None
    figure, grid = pyplot.subplots(
        1,
        len(strains),
        squeeze=False,
        sharex=True,
        sharey=True,
        figsize=(0.6 + 4.3 * len(strains), 3.9),
        layout="constrained",
    )
    shown = [row for row in rows if row["strain"] in strains]
    values = [
        row["error_mean_per_cell"] for row in shown if row["error_mean_per_cell"] > style.ROUND_OFF
    ]
    values += [
        row["reference_uncertainty_m"] / side
        for row in shown
        if side and row["reference_uncertainty_m"] / side > style.ROUND_OFF
    ]
    values = values or [style.ROUND_OFF]
    floor = 10.0 ** math.floor(math.log10(min(values)) - 0.5)
    clipped = full = False
    for axes, strain in zip(grid[0], strains):
        for row in (row for row in shown if row["strain"] == strain):
            error = row["error_mean_per_cell"]
            low = error < style.ROUND_OFF
            clipped |= low
            axes.plot(
                row["seconds_method"],
                floor if low else error,
                style.load_marker(row["load"]),
                ms=7,
                clip_on=False,
                markerfacecolor="none" if low else style.method_colour(row["method"], methods),
                markeredgecolor=style.method_colour(row["method"], methods) if low else "white",
                mew=1.2 if low else 0.6,
                label=label_of(row["method"]),
                gid=f"{ROUND_OFF_NOTE}, {row['load']}" if low else row["load"],
            )
            if (
                row["method"] == METHOD
                and row["seconds_reference"] > 0
                and side
                and row["reference_uncertainty_m"] > 0
            ):
                full = True
                axes.plot(
                    row["seconds_reference"],
                    max(floor, row["reference_uncertainty_m"] / side),
                    style.load_marker(row["load"]),
                    color="#666666",
                    ms=7,
                    mew=0.6,
                    markeredgecolor="white",
                    clip_on=False,
                    label="full resolution, at its uncertainty",
                    gid=row["load"],
                )
        axes.set_title(f"{style.percent(strain)} strain, against {reference}", loc="left")
        style.log_axes(axes)
        axes.set_xlabel("time per strain level [s]")
    grid[0][0].set_ylim(floor, 10.0 ** math.ceil(math.log10(2.0 * max(values))))
    grid[0][0].set_ylabel("mean error [cell sides]")
    handles = [
        Line2D(
            [],
            [],
            ls="",
            marker="o",
            color=style.method_colour(m, methods),
            label=style.METHOD_LABELS.get(m, label_of(m)),
        )
        for m in methods
        if any(row["method"] == m for row in shown)
    ]
    if full:
        handles.append(
            Line2D(
                [],
                [],
                ls="",
                marker="o",
                color="#666666",
                label="full resolution, at its uncertainty",
            )
        )
    handles += [
        Line2D(
            [],
            [],
            ls="",
            marker=style.load_marker(load),
            color="#222222",
            markerfacecolor="none",
            label=load,
        )
        for load in style.ordered_loads(row["load"] for row in shown)
    ]
    if clipped:
        handles.append(Line2D([], [], ls="", label="hollow: zero to round-off"))
    figure.legend(handles=handles, loc="center left", bbox_to_anchor=(1.0, 0.5), handletextpad=0.3)
    return figure


def speed_ratio(rows, reference):
    """Median of full-resolution over coarse time for the sheet loads, or None."""
    rows = positive(
        [
            row
            for row in of_main_method(rows)
            if row["reference"] == reference
            and not style.is_infinite(row["load"])
        ],
        "seconds_method",
        "seconds_reference",
    )
    return (
        float(numpy.median([r["seconds_reference"] / r["seconds_method"] for r in rows]))
        if rows
        else None
    )
