# SPDX-License-Identifier: MIT
"""The error budget as stacked shares, and error against run time of every way with its Pareto
front.
"""
import math

from matplotlib import pyplot
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures import style
from figures.plot_data import BAND_ALPHA, BAND_COLOUR, band, name_unseen
from read import schema
from read.budget_results import BESIDE_THE_SUM, PARTS, levels, pareto_front, unexplained

PART_COLOURS = {
    "slip": style.BLUE,
    "selvedge": style.SKY,
    "bulk": "#882255",
    "layer": style.PURPLE,
    "rest": "#7F7F7F",
    "macro-law": style.VERMILLION,
    "modes": style.ORANGE,
    "coarse-mesh": style.GREEN,
    "blending": style.YELLOW,
    "time-step": "#B0B0B0",
    "solver": style.BLACK,
}
SMALL = 0.005  # a share below this is not drawn: it would be thinner than a line


def budget_figure(rows, strains, side):
    """Shares of the parts in the measured error, stacked up and, where they compensate, down; one
    panel per strain.

    The total is the line at 1, the diamond the sum of the parts; the number is what they leave.
    @return figure, or None without a level whose error is above round-off
    """
    table = {
        key: regions["all"]
        for key, regions in levels(rows).items()
        if regions["all"]["total"]["mean_per_cell"] > style.ROUND_OFF
    }
    strains = [s for s in strains if any(key[1] == s for key in table)]
    if not strains:
        return None
    loads = style.ordered_loads(load for load, _ in table)
    figure, grid = pyplot.subplots(
        1,
        len(strains),
        squeeze=False,
        sharey=True,
        layout="constrained",
        figsize=(0.8 + (0.85 * len(loads) + 0.6) * len(strains), 4.0),
    )
    drawn = set()
    for axes, strain in zip(grid[0], strains):
        for x, load in enumerate(loads):
            parts = table.get((load, strain))
            if parts:
                draw_stack(axes, x, parts, drawn)
        axes.axhline(1.0, color="#222222", lw=1.1, ls=(0, (4, 2)), zorder=4)
        axes.axhline(0.0, color="#222222", lw=0.6)
        axes.set_title(f"{style.percent(strain)} strain", loc="left")
        axes.set_xticks(range(len(loads)), [load.replace("-", "-\n", 1) for load in loads])
        name_unseen(axes.xaxis, "load")
        axes.set_xlim(-0.6, len(loads) - 0.4)
        axes.grid(axis="x", visible=False)
    grid[0][0].set_ylabel("share of the measured error")
    handles = [
        Patch(color=PART_COLOURS[part], label=label)
        for part, label in PARTS.items()
        if part in drawn
    ]
    handles += [
        Line2D([], [], color="#222222", lw=1.1, ls=(0, (4, 2)), label="measured error"),
        Line2D(
            [],
            [],
            ls="",
            marker="D",
            color="white",
            markeredgecolor="#222222",
            label="sum of the parts (with what it leaves unexplained)",
        ),
    ]
    figure.legend(handles=handles, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def draw_stack(axes, x, parts, drawn):
    """One load: positive shares upwards from zero, negative ones downwards, parts that cancel each
    other side by side.
    """
    up = down = 0.0
    for part in PARTS:
        share = parts[part]["share"] if part in parts else math.nan
        if part in BESIDE_THE_SUM or not abs(share) >= SMALL:
            continue
        drawn.add(part)
        axes.bar(
            x,
            share,
            0.62,
            bottom=up if share > 0 else down,
            color=PART_COLOURS[part],
            edgecolor="white",
            linewidth=0.5,
            zorder=2,
            label=PARTS[part],
        )
        if share > 0:
            up += share
        else:
            down += share
    share = parts["sum"]["share"]
    axes.bar(x, share, 0.0, lw=0, label="sum of the parts")  # its number, for the CSV file
    axes.plot(x, share, "D", color="white", markeredgecolor="#222222", ms=5, zorder=5)
    axes.annotate(
        f"{100 * unexplained(parts):.2g} %",
        (x, max(up, share, 1.0)),
        xytext=(0, 4),
        textcoords="offset points",
        ha="center",
        fontsize=7.5,
        zorder=6,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
    )


OTHER = "other"
FAMILIES = {
    "fine": ("resolved sheet", "s", "#666666"),
    "affine": ("coarse motion alone", "o", style.VERMILLION),
    "localized": ("localized, the paper's method", "o", style.BLUE),
    **{
        name: (name, "o", colour)
        for name, colour in style.METHOD_COLOURS.items()
        if name not in ("affine", "localized")
    },
    OTHER: ("other terms", "o", style.SPARE_COLOURS[0]),
    "voigt": ("Voigt stiffness, localized", "^", style.PURPLE),
    "reuss": ("Reuss stiffness, localized", "v", style.PURPLE),
    "nodal": ("the paper's nodal warping, localized", "D", style.GREEN),
}
BAR_LABEL = "error bar of the best reference"


def method_of(way):
    """The method of a coarse cloth, like full of full-20; of other ways their first word."""
    name, _, quads = way.rpartition("-")
    return name if quads.isdigit() else way.partition("-")[0]


def is_method(way):
    return method_of(way) == "affine" or bool(schema.terms(method_of(way)))


def family(way):
    """What a point is drawn as: a method without a colour of its own as all such."""
    name = method_of(way)
    return name if name in FAMILIES else OTHER


def label_of(way):
    """What stands beside a point: the quads per side of coarse cloths, the name of the resolved
    ways.
    """
    name, detail = method_of(way), way.rpartition("-")[2]
    if family(way) == OTHER:
        return way
    return detail if name == "fine" or is_method(way) else ""


def front_line(front, end):
    """Times and errors of the Pareto front with its corners as points: the least error until the
    next way is done.

    @param end time at which the line ends [s]
    """
    times, errors = [w["seconds"] for w in front], [w["error_mean_per_cell"] for w in front]
    return [time for pair in zip(times, times[1:] + [end]) for time in pair], [
        error for error in errors for _ in range(2)
    ]


# Of a label beside its point: shift in points, and which of its edges lies there.
SIDES = (
    ((0, -6), "center", "top"),
    ((0, 6), "center", "bottom"),
    ((6, 0), "left", "center"),
    ((-6, 0), "right", "center"),
)
SHARE_BEFORE = {"left": 0.0, "bottom": 0.0, "center": 0.5, "right": 1.0, "top": 1.0}
LETTERS = 7.5  # their height [points]; 0.6 of it wide


def add_labels(axes, ways):
    """Writes what each point is below it, or on the side where it covers the fewest points and labels.

    @param axes of a figure that is laid out
    """
    points = [
        axes.transData.transform((way["seconds"], way["error_mean_per_cell"]))
        * 72.0 / axes.figure.dpi
        for way in ways
    ]
    taken = [(x - 3.5, y - 3.5, x + 3.5, y + 3.5) for x, y in points]
    for (x, y), way in zip(points, ways):
        text = label_of(way["way"])
        if not text:
            continue
        width = 0.6 * LETTERS * len(text)

        def box(side):
            (dx, dy), horizontal, vertical = side
            left = x + dx - SHARE_BEFORE[horizontal] * width
            low = y + dy - SHARE_BEFORE[vertical] * LETTERS
            return left, low, left + width, low + LETTERS

        def overlaps(side):
            left, low, right, high = box(side)
            return sum(l < right and r > left and b < high and t > low for l, b, r, t in taken)

        side = min(SIDES, key=overlaps)
        taken.append(box(side))
        axes.annotate(
            text,
            (way["seconds"], way["error_mean_per_cell"]),
            xytext=side[0],
            textcoords="offset points",
            ha=side[1],
            va=side[2],
            fontsize=LETTERS,
            color=FAMILIES[family(way["way"])][2],
        )


def way_figure(ways, side):
    """Error against time of every way, Pareto front as a step line; None without a way that has
    both.

    @param ways rows of runtime.csv of one load and strain
    """
    known = [w for w in ways if w["seconds"] > 0 and w["error_mean_per_cell"] > 0]
    if not known:
        return None
    figure, axes = pyplot.subplots(figsize=(7.4, 4.3), layout="constrained")
    bar = next(
        (
            w["reference_uncertainty_m"] / side
            for w in known
            if side and w["reference_uncertainty_m"] > 0
        ),
        None,
    )
    low = min(w["error_mean_per_cell"] for w in known) / 2.5
    high = max(w["error_mean_per_cell"] for w in known) * 2.0
    left, right = min(w["seconds"] for w in known) / 2.0, max(w["seconds"] for w in known) * 3.0
    if bar:
        band(axes, [left, right], [bar, bar], low, BAR_LABEL)
    front = pareto_front(known)
    axes.plot(*front_line(front, right), color="#222222", lw=1.0, zorder=1)
    for way in known:
        name, marker, colour = FAMILIES[family(way["way"])]
        on_front = way in front
        axes.plot(
            way["seconds"],
            way["error_mean_per_cell"],
            marker,
            color=colour if on_front else "white",
            markeredgecolor=colour,
            mew=1.3,
            ms=7,
            zorder=3,
            label=name,
            gid=way["way"],
        )
    style.log_axes(axes)
    axes.set_xlim(left, right)
    axes.set_ylim(low, high)
    axes.set(xlabel="median time to the positions [s]", ylabel="mean error [cell sides]")
    shown = list(dict.fromkeys(family(w["way"]) for w in known))
    handles = [
        Line2D(
            [], [], ls="", marker=FAMILIES[f][1], color=FAMILIES[f][2], ms=7, label=FAMILIES[f][0]
        )
        for f in FAMILIES
        if f in shown
    ]
    handles.append(Line2D([], [], color="#222222", lw=1.0, label="Pareto front (filled)"))
    if bar:
        handles.append(Patch(color=BAND_COLOUR, alpha=BAND_ALPHA, label=BAR_LABEL))
    figure.legend(handles=handles, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.draw_without_rendering()  # which lays it out
    add_labels(axes, known)
    return figure
