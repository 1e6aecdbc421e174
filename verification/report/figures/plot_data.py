# SPDX-License-Identifier: MIT
"""The numbers of a drawn figure, read back from it: for the interactive plot in the page and for
its CSV file.

Both show what the picture shows, because they are read from the picture. Curves and bars with a
label are data; without one they are guides (slopes, marked strains), which the plot repeats and the
CSV leaves out. The `gid` of a curve is a note on its points: the load, the way, or `zero to
round-off` for those drawn at the edge.
"""
import csv
import io
import math
import re

import numpy
from matplotlib.colors import to_hex
from matplotlib.text import Annotation
from matplotlib.ticker import FixedLocator

ROUND_OFF_NOTE = "zero to round-off"
NO_WIDTH = "\u200b"
BAND_COLOUR, BAND_ALPHA = "#BDBDBD", 0.55
DASHES = {
    "-": [],
    "--": [6, 3],
    "-.": [7, 3, 1.5, 3],
    ":": [1.5, 2.5],
    "None": None,
    "": None,
    " ": None,
}
HEADER = ("panel", "series", "note", "x_quantity", "x", "y_quantity", "y")


def label_of(name):
    """A name as a label of data: one that begins with an underscore would be left out of legends,
    hence a space without width stands before it, which plain() takes away.
    """
    return NO_WIDTH + name if name.startswith("_") else name


def plain(text):
    """A label without the marks of mathematical type: $C^H$ gives Cᴴ."""
    text = text.replace("C^H", "Cᴴ").replace(r"\theta", "θ").replace(NO_WIDTH, "")
    return re.sub(r"[${}]", "", text).replace("\n", " ")


def number(value):
    """Seven digits for the page and the file; what is not finite is None."""
    value = float(value)
    return float(f"{value:.7g}") if math.isfinite(value) else None


def band(axes, x, y, bottom, label):
    """A grey area from `bottom` up to y(x), that is read back as a curve: an error bar."""
    area = axes.fill_between(
        x, y, bottom, color=BAND_COLOUR, alpha=BAND_ALPHA, lw=0, zorder=0, label=label
    )
    area.upper_edge = numpy.column_stack([x, y])
    return area


def name_unseen(axis, quantity):
    """Names the quantity of an axis for the CSV file alone: beside words, or around a circle, it
    would be in the way.
    """
    axis.set_label_text(quantity)
    axis.label.set_visible(False)


def is_data(artist):
    return not str(artist.get_label()).startswith("_")


def curve_of(line, axes):
    """A curve as the page draws it; None where it stands in no data coordinates.

    @throws ValueError of a line that matplotlib draws as steps: its points alone would make
        straight segments of it
    """
    if line.get_drawstyle() != "default":
        raise ValueError(
            f"curve `{line.get_label()}` is drawn with `{line.get_drawstyle()}`, expected"
            " `default`: only the points of a curve are read back. Plot the corners of the steps"
            " as points."
        )
    transform = line.get_transform()
    if transform == axes.get_xaxis_transform():  # a line across the panel, or marks at its edge
        x = numpy.asarray(line.get_xdata(orig=False), dtype=float)
        return {"across": "x", "at": number(x[0])} if len(x) == 2 and x[0] == x[1] else None
    if transform == axes.get_yaxis_transform():
        y = numpy.asarray(line.get_ydata(orig=False), dtype=float)
        return {"across": "y", "at": number(y[0])} if len(y) == 2 and y[0] == y[1] else None
    if transform != axes.transData:
        return None
    x, y = (
        numpy.asarray(values, dtype=float)
        for values in (line.get_xdata(orig=False), line.get_ydata(orig=False))
    )
    marked = line.get_markevery()
    shown = range(len(x)) if marked is None else sorted(int(i) for i in marked)
    marker = line.get_marker()
    hollow = str(line.get_markerfacecolor()) in ("white", "none", "w")
    curve = {
        "label": plain(str(line.get_label())) if is_data(line) else "",
        "points": [[number(a), number(b)] for a, b in zip(x, y)],
        "colour": to_hex(
            line.get_color()
            if line.get_linestyle() not in ("None", "")
            else line.get_markeredgecolor()
            if hollow
            else line.get_markerfacecolor()
        ),
        "dash": getattr(line, "dashes", DASHES.get(line.get_linestyle(), [])),
        "width": number(line.get_linewidth()),
        "marker": marker if isinstance(marker, str) and marker not in ("None", "", " ") else "",
        "hollow": hollow,
    }
    if line.is_dashed() and line.get_linestyle() == "--" and not is_data(line):
        curve["dash"] = [3, 3]
    if line.get_gid():
        curve["note"] = line.get_gid()
    if marked is not None:
        curve["shown"] = list(shown)
    return curve


def words_of(axes):
    """Words that stand at a point of a panel, such as the slope of a triangle: what the page writes
    there too.
    """
    return [
        {
            "text": plain(note.get_text()),
            "at": [number(value) for value in note.xy],
            "shift": [number(value) for value in note.xyann],  # points, up is positive
            "side": [note.get_ha(), note.get_va()],
            "colour": to_hex(note.get_color()),
        }
        for note in axes.texts
        if isinstance(note, Annotation)
        and note.get_text()
        and note.xycoords == "data"
        and note.anncoords == "offset points"
    ]


def own_ticks(axis):
    """The places that an axis names in place of round numbers, if it does."""
    locator = axis.get_minor_locator()
    if not isinstance(locator, FixedLocator):
        return {}
    return {"ticks": [number(place) for place in locator()]}


def panel_of(axes):
    curves = [curve_of(line, axes) for line in axes.lines]
    for area in axes.collections:
        if getattr(area, "upper_edge", None) is not None:
            curves.append(
                {
                    "label": area.get_label(),
                    "points": [[number(a), number(b)] for a, b in area.upper_edge],
                    "colour": BAND_COLOUR.lower(),
                    "dash": [],
                    "width": 0,
                    "marker": "",
                    "hollow": False,
                    "fill": True,
                }
            )
    low_high = {"x": sorted(axes.get_xlim()), "y": sorted(axes.get_ylim())}
    return {
        "title": plain(axes.get_title(loc="left") or axes.get_title()),
        **{
            key: {
                **own_ticks(axis),
                "label": plain(getattr(axes, f"get_{key}label")()),
                "log": getattr(axes, f"get_{key}scale")() == "log",
                "range": [number(v) for v in low_high[key]],
            }
            for key, axis in (("x", axes.xaxis), ("y", axes.yaxis))
        },
        "curves": [curve for curve in curves if curve],
        "words": words_of(axes),
    }


def shared_labels(panels):
    """Panels of a row or a column share the label of an axis, which one of them carries."""
    for key in "xy":
        for some in (panels, panels[::-1]):
            last = ""
            for panel in some:
                last = panel[key]["label"] = panel[key]["label"] or last
    return panels


def has_words(axis):
    """Whether an axis has words at its ticks, groups of cases or loads, instead of numbers."""
    return isinstance(axis.get_major_locator(), FixedLocator)


def cartesian(figure):
    return [axes for axes in figure.axes if axes.get_visible() and axes.name == "rectilinear"]


def panels_of(figure):
    """What the page needs to draw the figure again, or None where it has no curve, or words at its
    axes.

    @return list of {"title", "x" and "y" {"label", "log", "range"}, "curves"}
    """
    all_axes = cartesian(figure)
    if len(all_axes) < len(figure.axes):
        if any(axes.get_visible() for axes in figure.axes if axes not in all_axes):
            return None
    for axes in all_axes:
        if any(has_words(axis) for axis in (axes.xaxis, axes.yaxis)):
            return None
    panels = shared_labels([panel_of(axes) for axes in all_axes])
    return (
        panels if any(curve.get("label") for panel in panels for curve in panel["curves"]) else None
    )


def category(axis, place):
    """The words at the tick nearest to a place, empty where ticks are numbers."""
    if not has_words(axis):
        return ""
    ticks = list(axis.get_ticklocs())
    nearest = min(range(len(ticks)), key=lambda i: abs(ticks[i] - place), default=None)
    return (
        ""
        if nearest is None
        else plain(axis.get_major_formatter()(ticks[nearest], nearest)).replace("- ", "-")
    )


def bar_rows(axes, panel):
    """Rows of the bars: a bar that lies begins at the edge of its logarithmic axis, one that stands
    upon others.
    """
    rows = []
    for bars in axes.containers:
        if str(bars.get_label()).startswith("_"):
            continue
        for bar in bars.patches:
            if bars.orientation == "horizontal":
                x, y = bar.get_x() + bar.get_width(), category(
                    axes.yaxis, bar.get_y() + 0.5 * bar.get_height()
                )
            else:
                x, y = category(axes.xaxis, bar.get_x() + 0.5 * bar.get_width()), bar.get_height()
            rows.append(
                [
                    panel["title"],
                    plain(bars.get_label()),
                    "",
                    panel["x"]["label"],
                    x,
                    panel["y"]["label"],
                    y,
                ]
            )
    return rows


def rows_of(figure):
    """The data of a figure as rows under HEADER; none for a picture without curves and bars."""
    rows = []
    visible = [axes for axes in figure.axes if axes.get_visible()]
    for axes, panel in zip(visible, shared_labels([panel_of(axes) for axes in visible])):
        for curve in panel["curves"]:
            if not curve.get("label"):
                continue
            for i in curve.get("shown", range(len(curve["points"]))):
                x, y = curve["points"][i]
                if x is not None and y is not None:
                    rows.append(
                        [
                            panel["title"],
                            curve["label"],
                            curve.get("note", ""),
                            panel["x"]["label"],
                            x,
                            panel["y"]["label"],
                            0 if str(curve.get("note", "")).startswith(ROUND_OFF_NOTE) else y,
                        ]
                    )
        rows += bar_rows(axes, panel)
    return rows


def csv_text(rows, header=HEADER):
    """Rows as CSV; numbers with seven digits."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(
        [f"{v:.7g}" if isinstance(v, (float, numpy.floating)) else v for v in row] for row in rows
    )
    return file.getvalue()
