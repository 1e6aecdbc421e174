# SPDX-License-Identifier: MIT
"""Error against size on logarithmic axes, with the slopes that theory expects; one figure per
study.
"""
import math

from matplotlib import pyplot, ticker
from matplotlib.lines import Line2D

from figures import style

GUIDE = "#6B6B6B"
THEORY = "order of the theory, or its bounds"
ORDER_MARKERS = {1: "o", 2: "^"}
TIME_LOOKS = ((style.BLUE, "o", "-"), (style.VERMILLION, "s", "--"), (style.GREEN, "^", "-."))
METHOD_LINES = {"localized": "-", "affine": "--", "full": "-."}
MESH_LINES = {"adaptive": "-", "uniform": "--"}


class Line:
    """A curve of a panel."""

    def __init__(self, series, label, colour, marker="o", line="-"):
        self.h, self.error = series.errors()
        self.expected, self.failed = series.expected(), series.judgement == "FAIL"
        self.is_band = series.is_band
        self.label, self.colour, self.marker, self.line = label, colour, marker, line


def slope_guides(axes, lines):
    """A dotted line of each expected order beneath the finest part of the lowest curve that expects
    it.
    """
    drawn = set()
    for line in sorted(lines, key=lambda one: one.error[-1] if one.error else math.inf):
        if len(line.h) < 3:
            continue
        for order in line.expected:
            order = round(order, 2)
            if order in drawn:
                continue
            drawn.add(order)
            x0, x1 = line.h[-1], line.h[-2 if line.is_band else -3]
            y0 = 0.45 * line.error[-1]
            y1 = y0 * (x1 / x0) ** order
            axes.plot(
                [x0, x1],
                [y0, y1],
                ":",
                color=GUIDE,
                lw=1.6,
                zorder=1,
                label=THEORY,
                gid=f"order {order:g}",
            )
            axes.annotate(
                f"{order:g}",
                (x1, y1),
                xytext=(4, -2),
                textcoords="offset points",
                fontsize=8,
                color=GUIDE,
                va="top",
            )


def draw_panel(axes, lines, title, xlabel, ylabel):
    for line in lines:
        if line.h:
            axes.plot(
                line.h,
                line.error,
                line.line,
                color=line.colour,
                marker=line.marker,
                markerfacecolor="white" if not line.failed else line.colour,
                ms=5,
                label=line.label,
            )
    slope_guides(axes, lines)
    style.log_axes(axes)
    sizes = [h for line in lines for h in line.h]
    if sizes and max(sizes) / min(sizes) < 30:
        axes.xaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
    low, high = axes.get_ylim()
    if high / low < 30:  # else a single number would stand at the axis
        axes.yaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.yaxis.set_major_formatter(lambda y, _: f"{y:.1g}")
    axes.set(xlabel=xlabel, ylabel=ylabel)
    axes.set_title(title, loc="left")


def order_figure(panels, columns=0):
    """Panels under a common legend.

    @param panels [(title, xlabel, ylabel, [Line])]
    @param columns panels in a row; 0: at most three
    @return figure, or None where no panel has a curve
    """
    panels = [panel for panel in panels if any(len(line.h) > 1 for line in panel[3])]
    if not panels:
        return None
    columns = columns or (2 if len(panels) == 4 else min(3, len(panels)))
    rows = math.ceil(len(panels) / columns)
    figure, grid = pyplot.subplots(
        rows,
        columns,
        squeeze=False,
        layout="constrained",
        figsize=(0.5 + 3.6 * columns, 3.2 * rows),
    )
    for axes in grid.flat[len(panels) :]:
        axes.set_visible(False)
    handles = {}
    for axes, (title, xlabel, ylabel, lines) in zip(grid.flat, panels):
        draw_panel(axes, lines, title, xlabel, ylabel)
        for line in lines:
            if line.h:
                handles.setdefault(
                    line.label,
                    Line2D(
                        [],
                        [],
                        color=line.colour,
                        ls=line.line,
                        marker=line.marker,
                        markerfacecolor="white",
                        label=line.label,
                    ),
                )
    guide = Line2D([], [], color=GUIDE, ls=":", lw=1.6, label=THEORY)
    handles = list(handles.values()) + [guide]
    figure.legend(
        handles=handles,
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncol=min(4, len(handles)),
        handlelength=2.8,
    )
    return figure


def mesh_figure(convergence):
    panels = []
    for cell in convergence.cells("mesh"):
        lines = [
            Line(s, f"P{s.p}", style.BLUE if s.p == 1 else style.VERMILLION, ORDER_MARKERS[s.p])
            for s in convergence.of("mesh", cell)
            if s.name.startswith("trace")
        ]
        panels.append((cell, "mesh width [cell sides]", "error of tr $C^H$ [N/m]", lines))
    return order_figure(panels)


def adaptive_figure(convergence):
    """Width against DoFs; the slopes are those in DoFs."""
    panels = []
    for cell in convergence.cells("adaptive"):
        lines = [
            Line(
                s,
                f"P{s.p}, {s.name.split(' ')[0]}",
                style.BLUE if s.p == 1 else style.VERMILLION,
                ORDER_MARKERS[s.p],
                MESH_LINES[s.name.split(" ")[0]],
            )
            for s in convergence.of("adaptive", cell)
        ]
        for line in lines:
            line.h, line.expected = [h**-2 for h in line.h], [
                -order / 2 for order in line.expected
            ]
        panels.append((cell, "DoFs", "relative width of the bracket", lines))
    return order_figure(panels)


def method_lines(some):
    """A curve per load and method: colour and marker tell the load, dashes the method."""
    some = list(some)
    bent = dict.fromkeys(s.case for s in some if s.study == "bending")
    own = dict(zip(bent, style.LOAD_STYLES))
    lines = []
    for s in some:
        method = s.name.split(":")[0]
        colour, marker = own.get(s.case, style.load_style(s.case))
        lines.append(
            Line(s, f"{s.case}, {method}", colour, marker, METHOD_LINES.get(method, ":"))
        )
    return lines


def scale_figure(convergence):
    return order_figure(
        [
            (
                cell,
                "cell sides per sheet side",
                "mean error per strain [sheet sides]",
                method_lines(s for s in convergence.of("scale", cell) if s.unit == "sheet sides"),
            )
            for cell in convergence.cells("scale")
        ]
    )


def coarse_figure(convergence):
    panels = []
    for key, ylabel in (
        ("energy", "error of the energy [J]"),
        ("change of the coarse motion", "change by halving H, per strain [cell sides]"),
        ("localized", "mean error, localized, per strain [cell sides]"),
    ):
        for cell in convergence.cells("coarse"):
            lines = [
                Line(s, s.case, style.load_colour(s.case), style.load_marker(s.case))
                for s in convergence.of("coarse", cell)
                if s.name.startswith(key)
            ]
            panels.append((cell, "coarse mesh width $H$ [cell sides]", ylabel, lines))
    return order_figure(panels, min(3, len(convergence.cells("coarse"))))


def edges_figure(convergence):
    return order_figure(
        [
            (
                cell,
                "cell sides per sheet side",
                "mean error per strain [cell sides]",
                method_lines(convergence.of("edges", cell)),
            )
            for cell in convergence.cells("edges")
        ]
    )


def bending_figure(convergence):
    return order_figure(
        [
            (
                cell,
                "cell sides per sheet side",
                f"mean error of the {what} [{unit}]",
                method_lines(
                    s
                    for s in convergence.of("bending", cell)
                    if s.name.endswith(what) and s.name.split(":")[0] in ("affine", "full")
                ),
            )
            for cell in convergence.cells("bending")
            for what, unit in (("deflection", "$k L^2$"), ("normal", "$k L$"))
        ],
        2,
    )


def strain_figure(convergence):
    # What is zero to round-off is not judged and has no order.
    return order_figure(
        [
            (
                cell,
                "strain",
                "mean error [cell sides]",
                method_lines(s for s in convergence.of("strain", cell) if s.judgement),
            )
            for cell in convergence.cells("strain")
        ]
    )


def time_figure(convergence):
    """A panel per cell and unit of the error; a case has one look in all of them."""
    cases = dict.fromkeys(s.case for s in convergence.of("time"))
    looks = {case: TIME_LOOKS[i % len(TIME_LOOKS)] for i, case in enumerate(cases)}
    panels = []
    for cell in convergence.cells("time"):
        some = convergence.of("time", cell)
        for unit in dict.fromkeys(s.unit for s in some):
            lines = [Line(s, s.case, *looks[s.case]) for s in some if s.unit == unit]
            panels.append((cell, "time step [s]", f"mean error [{unit}]", lines))
    return order_figure(panels, min(2, len(panels)))


FIGURES = {
    "mesh": mesh_figure,
    "adaptive": adaptive_figure,
    "scale": scale_figure,
    "coarse": coarse_figure,
    "edges": edges_figure,
    "bending": bending_figure,
    "strain": strain_figure,
    "time": time_figure,
}
