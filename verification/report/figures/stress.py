# SPDX-License-Identifier: MIT
"""The stability map: how far each axis goes, where and why it ends, and what theory says of it."""
import math

from matplotlib import pyplot, ticker
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures import style

# How an axis ended: colour and hatch of its bar, words of the legend.
ENDS = {
    "error": (style.BLUE, "", "ends: the answer is wrong"),
    "solver": (style.ORANGE, "///", "ends: refused, or the solver gave up"),
    "repetition": (style.VERMILLION, "xx", "ends: the same again gave other numbers"),
    "cap": (style.SKY, "...", "not tried further (time or size)"),
    "ladder": ("#B9B9B9", "", "no value that was tried is wrong"),
}


def power(value):
    """A value for people: 10^12 where it is a power of ten, else two digits."""
    if not value > 0.0:
        return "none"
    exponent = round(math.log10(value))
    if abs(value / 10.0**exponent - 1.0) < 1e-6 and abs(exponent) > 2:
        return f"$10^{{{exponent}}}$"
    if 1e-3 <= value < 1e5:
        return f"{value:.3g}"
    exponent = math.floor(math.log10(value))
    return f"${value / 10.0**exponent:.2g}\\cdot10^{{{exponent}}}$"


def limits_figure(rows):
    """A bar per axis up to the largest value that is right, a cross where it ends, a black mark
    where theory sees its end or promises none before. Axes of one cell or scene stand together.
    @return figure, or None where there is no row
    """
    rows = sorted(rows, key=lambda row: list(dict.fromkeys(r["of"] for r in rows)).index(row["of"]))
    seen = [
        row[key] for row in rows for key in ("reached", "end", "theory") if row[key] == row[key]
    ]
    if not seen:
        return None
    left = 10.0 ** (math.floor(math.log10(min(seen))) - 1)
    right = 10.0 ** (math.ceil(math.log10(max(seen))) + 1)
    places, headings, place = [], [], 0.0
    for k, row in enumerate(rows):
        if k == 0 or row["of"] != rows[k - 1]["of"]:
            headings.append((place, row["of"]))
            place += 1.0
        places.append(place)
        place += 1.0
    figure, axes = pyplot.subplots(figsize=(9.2, 0.9 + 0.2 * place), layout="constrained")
    for y, row in zip(places, rows):
        colour, hatch, _ = ENDS[row["ended_by"]]
        reached = row["reached"]
        if reached == reached:
            axes.barh(y, reached - left, 0.68, left, color=colour, hatch=hatch, edgecolor="white",
                      lw=0.0)
        if row["end"] == row["end"]:
            axes.plot(row["end"], y, "X", color=style.VERMILLION, ms=5.5, mew=0, zorder=4)
        if row["theory"] == row["theory"]:
            axes.plot([row["theory"]] * 2, [y - 0.42, y + 0.42], color=style.BLACK, lw=2, zorder=5)
    names = axes.secondary_yaxis("right")
    names.set_yticks(places, [power(row["reached"]) for row in rows])
    names.tick_params(length=0.0)
    names.spines["right"].set_visible(False)
    for y, name in headings:
        axes.text(0.0, y, name, transform=axes.get_yaxis_transform(), fontweight="bold",
                  fontsize=8, va="center")
    axes.set(xscale="log", xlim=(left, right), ylim=(place - 0.4, -0.6),
             xlabel="largest value that is right (right: its number; unit in the table)")
    axes.set_yticks(places, [row["axis"] for row in rows])
    axes.tick_params(axis="y", length=0.0)
    axes.xaxis.set_major_locator(ticker.LogLocator(numticks=12))
    axes.xaxis.set_minor_locator(ticker.NullLocator())
    axes.grid(axis="y", visible=False)
    there = {row["ended_by"] for row in rows}
    handles = [
        Patch(facecolor=colour, hatch=hatch, edgecolor="white", lw=0.0, label=label)
        for name, (colour, hatch, label) in ENDS.items()
        if name in there
    ] + [
        Line2D([], [], ls="", marker="X", color=style.VERMILLION, mew=0, ms=6,
               label="first that is wrong"),
        Line2D([], [], ls="", marker="|", color=style.BLACK, ms=9, mew=2, label="theory"),
    ]
    figure.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3)
    return figure
