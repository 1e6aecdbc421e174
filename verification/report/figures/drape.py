# SPDX-License-Identifier: MIT
"""Curves of a draped cloth: error, height and energies against time, and the time of a step."""
import math

import numpy
from matplotlib import pyplot, ticker
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures import style
from figures.plot_data import band, label_of, name_unseen
from figures.sheet import unit_of
from read import schema
from read.drape_results import reference_member

ENERGY_ROUND_OFF = 1e-14  # of the largest energy: sums of squares of positions carry 16 digits
BLOWN = 1e3  # times the largest value of the first cloth
LAW_COLOURS = (style.BLUE, "#332288", style.GREEN)  # of the laws of coarse cloths, as the schema has them
NODAL_WARPING = "nodal-warping"  # the paper's membrane, which has no law
SHELL_LINE = "--"
LAW_LINES = (":", "-.", (0, (5, 1)))  # of the laws of a sheet in space, in the order of the schema
FALL = 3.0  # a height that ranges over so many times that of the others gets a panel of its own


def ordered(names, known):
    """Known names in their order, then the others as they come."""
    names = list(dict.fromkeys(names))
    return [name for name in known if name in names] + [name for name in names if name not in known]


def known_variants():
    """Membranes of coarse cloths, in their order."""
    return (*schema.laws("is_of_coarse_cloth"), NODAL_WARPING)


def ordered_variants(names):
    return ordered(names, known_variants())


def known_references():
    """References, in their order."""
    return ("shell", *schema.laws("is_of_space"))


def reference_lines():
    """{member: line style} of the references, in their order."""
    return dict(zip(map(reference_member, known_references()), (SHELL_LINE, *LAW_LINES)))


def ordered_references(names):
    return ordered(names, known_references())


def variant_colour(name):
    """Methods may have coarse cloths of their own."""
    known = dict(zip(schema.laws("is_of_coarse_cloth"), LAW_COLOURS))
    return {NODAL_WARPING: style.ORANGE, **style.METHOD_COLOURS, **known}.get(name, style.PURPLE)


def curve(rows, key, factor=1.0):
    """(time, value) in the order of time, without empty fields."""
    pairs = sorted((row["time_s"], factor * row[key]) for row in rows if not math.isnan(row[key]))
    return numpy.array([p[0] for p in pairs]), numpy.array([p[1] for p in pairs])


def error_time_curves(rows):
    """Mean error against time: a column per variant, a row per reference, a colour per method; log
    y.

    @return figure, or None where no row has an error above zero
    """
    rows = [row for row in rows if row["error_mean_m"] > 0.0]
    if not rows:
        return None
    variants = ordered_variants(row["variant"] for row in rows)
    references = ordered_references(row["reference"] for row in rows)
    methods = style.ordered_methods(row["method"] for row in rows)
    largest = [
        max(row["error_mean_m"] for row in rows if row["variant"] == variant)
        for variant in variants
    ]
    factor, unit = unit_of(largest[0])
    bars = [row["reference_uncertainty_m"] for row in rows if row["reference_uncertainty_m"] > 0.0]
    # The first steps from a common start are arbitrarily small: four decades below the best cloth's
    # largest do.
    lower = max(min([row["error_mean_m"] for row in rows] + bars), 1e-4 * min(largest))
    lower = 10.0 ** math.floor(math.log10(factor * lower) - 0.2)
    upper = 10.0 ** math.ceil(math.log10(1.2 * factor * max(largest)))
    size = (0.9 + max(2.3 * len(variants), 4.2), 0.5 + 2.5 * len(references))
    figure, grid = pyplot.subplots(
        len(references),
        len(variants),
        squeeze=False,
        sharex=True,
        sharey=True,
        layout="constrained",
        figsize=size,
    )
    for axes in grid[-1]:
        axes.set_xlabel("time [s]")
    for line, reference in zip(grid, references):
        for axes, variant in zip(line, variants):
            here = [r for r in rows if r["variant"] == variant and r["reference"] == reference]
            time, bar = curve(
                [r for r in here if r["method"] == here[0]["method"]],
                "reference_uncertainty_m",
                factor,
            )
            if len(time):
                band(axes, time, bar, lower / 100.0, "uncertainty of the reference")
            for method in methods:
                time, value = curve(
                    [r for r in here if r["method"] == method], "error_mean_m", factor
                )
                if len(time):
                    axes.plot(
                        time,
                        value,
                        color=style.method_colour(method, methods),
                        marker="o" if len(time) < 12 else "",
                        label=label_of(method),
                    )
            axes.set(yscale="log", ylim=(lower, upper))
            axes.yaxis.set_minor_locator(ticker.NullLocator())
            axes.set_title(
                f"{variant} against {reference}",
                loc="left",
                fontweight="bold",
                fontsize=9 if len(variants) < 3 else 7.0,
            )
        line[0].set_ylabel(f"mean error [{unit}]")
    handles = [
        Line2D([], [], color=style.method_colour(m, methods), lw=2.0, label=label_of(m))
        for m in methods
    ]
    if bars:
        handles.append(Patch(color="#BDBDBD", alpha=0.55, label="uncertainty of the reference"))
    figure.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=len(handles))
    return figure


def plot_members(axes, rows, key, factor=1.0, positive=False):
    """A curve for each variant in colour and for each reference in black."""
    for name in members(rows):
        time, value = curve([row for row in rows if row["member"] == name], key, factor)
        if positive:
            time, value = time[value > 0.0], value[value > 0.0]
        if name in reference_lines():
            axes.plot(
                time,
                value,
                color=style.BLACK,
                ls=reference_lines()[name],
                lw=1.6,
                zorder=4,
                label=name,
            )
        else:
            axes.plot(
                time,
                value,
                color=variant_colour(name),
                lw=2.2 if name == known_variants()[0] else 1.5,
                label=name,
            )


def members(rows):
    return ordered([row["member"] for row in rows], (*known_variants(), *reference_lines()))


def member_handles(rows):
    return [
        (
            Line2D(
                [],
                [],
                color=style.BLACK,
                ls=reference_lines()[name],
                lw=1.6,
                label=name,
            )
            if name in reference_lines()
            else Line2D([], [], color=variant_colour(name), lw=2.0, label=name)
        )
        for name in members(rows)
    ]


def with_height(rows, up):
    """Rows with the height of the centre along `up` (3) [m]."""
    return [
        {**row, "height": float(numpy.dot(up, [row[f"centre_{axis}_m"] for axis in "xyz"]))}
        for row in rows
    ]


def free_fall(rows, gravity):
    """(time, height) of the parabola from the first height, or None where the cloth does not start
    at rest.
    """
    first = min(rows, key=lambda row: row["time_s"])
    if gravity is None or first["kinetic_J"] > 0.0:
        return None
    time = numpy.linspace(first["time_s"], max(row["time_s"] for row in rows), 100)
    return (
        time,
        first["height"] - 0.5 * float(numpy.linalg.norm(gravity)) * (time - first["time_s"]) ** 2,
    )


def height_figure(rows, up, gravity):
    """Height of the centre against time.

    A variant that falls would flatten the curves of all others: then a second panel shows those.

    @return (figure, names of those that fall), or None
    """
    rows = [row for row in with_height(rows, up) if not math.isnan(row["height"])]
    if not rows:
        return None
    span = {}
    for name in members(rows):
        heights = [row["height"] for row in rows if row["member"] == name]
        span[name] = max(heights) - min(heights)
    usual = max(span[name] for name in span if name in reference_lines() or name == members(rows)[0])
    falling = [
        name for name in span if name not in reference_lines() and span[name] > FALL * max(usual, 1e-12)
    ]
    staying = [row for row in rows if row["member"] not in falling]
    figure, grid = pyplot.subplots(
        1,
        2 if falling else 1,
        squeeze=False,
        figsize=(9.6 if falling else 5.6, 3.1),
        layout="constrained",
    )
    parabola = free_fall(rows, gravity)
    for axes, some in zip(grid[0], (rows, staying)):
        if parabola is not None:
            axes.plot(
                parabola[0],
                100.0 * parabola[1],
                color="#777777",
                lw=4.0,
                alpha=0.45,
                zorder=0,
                label="free fall",
            )
        plot_members(axes, some, "height", 100.0)
        heights = [100.0 * row["height"] for row in some]
        pad = 0.06 * (max(heights) - min(heights)) or 1.0
        axes.set(xlabel="time [s]", ylim=(min(heights) - pad, max(heights) + pad))
    grid[0][0].set_ylabel("height of the centre [cm]")
    if falling:
        grid[0][0].set_title("all", loc="left", fontweight="bold")
        grid[0][1].set_title("without " + ", ".join(falling), loc="left", fontweight="bold")
    handles = member_handles(rows)
    if parabola is not None:
        handles.append(
            Line2D([], [], color="#777777", lw=4.0, alpha=0.45, label="free fall, −½ g t²")
        )
    figure.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4)
    return figure, falling


def energy_figure(rows):
    """Kinetic and elastic energy, that of the weight, and the largest stretch, against time.

    @return (figure, names of the energies that are zero to round-off and not drawn), or None
        without numbers

    Energies stand on logarithmic axes where they are positive; that of the weight is not. A curve
    is missing where the cloth has no such energy.
    """
    panels = [
        ("kinetic_J", "kinetic energy [J]"),
        ("elastic_J", "elastic energy [J]"),
        ("gravity_J", "energy of the weight [J]"),
        ("max_stretch", "largest stretch [1]"),
    ]
    panels = [(key, label) for key, label in panels if any(abs(row[key]) > 0.0 for row in rows)]
    largest = {key: max(known_sizes(rows, key)) for key, _ in panels}
    scale = max((value for key, value in largest.items() if key.endswith("_J")), default=0.0)
    zero = [k for k, value in largest.items() if k.endswith("_J") and value < ENERGY_ROUND_OFF * scale]
    names = [label.split(" [")[0] for key, label in panels if key in zero]
    panels = [(key, label) for key, label in panels if key not in zero]
    if not panels:
        return None
    figure, grid = pyplot.subplots(
        1, len(panels), squeeze=False, figsize=(0.4 + 3.2 * len(panels), 3.0), layout="constrained"
    )
    first = ordered_variants({row["member"] for row in rows})[0]
    for axes, (key, label) in zip(grid[0], panels):
        log = key not in ("max_stretch", "gravity_J") and not any(row[key] < 0.0 for row in rows)
        plot_members(axes, rows, key, positive=log)
        axes.set(xlabel="time [s]", ylabel=label)
        # A variant that blows up must not flatten the others: it leaves the panel.
        every = [row[key] for row in rows if not math.isnan(row[key])]
        calm = [
            row[key] for row in rows if row["member"] == first and not math.isnan(row[key])
        ] or every
        largest = max(map(abs, calm))
        blown = max(map(abs, every)) > BLOWN * largest > 0.0
        if log:
            axes.set_yscale("log")
            axes.yaxis.set_minor_locator(ticker.NullLocator())
            top = BLOWN * largest if blown else max(every)
            axes.set_ylim(top=top if blown else None)
            if min(value for value in every if value > 0.0) < 1e-8 * top:
                axes.set_ylim(bottom=1e-8 * top)
        else:
            # Four digits where they tell the ticks apart; else what they have in common goes apart.
            axes.yaxis.set_major_formatter(ticker.ScalarFormatter(useOffset=True))
            axes.yaxis.get_major_formatter().set_powerlimits((-4, 5))
            if blown:
                axes.set_ylim(min(calm) - 0.5 * largest, max(calm) + 0.5 * largest)
    figure.legend(
        handles=member_handles(rows), loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4
    )
    return figure, names


def known_sizes(rows, key):
    return [abs(row[key]) for row in rows if not math.isnan(row[key])] or [0.0]


def number(item, key):
    value = item.get(key)
    return math.nan if value is None else float(value)


def light_seconds(run):
    """Coarse step with its up-sampling [s], nan where one is unknown."""
    return number(run, "seconds_per_coarse_step") + number(run, "seconds_per_upsampling")


def main_run(cell):
    """The run that references are held against: the first."""
    return cell.runs[0] if cell.runs else None


def step_bars(cell):
    """Time per step as bars on a log axis: coarse step and up-sampling of each variant, the step of
    each reference.

    @return figure, or None without times
    """
    entries = []
    for name in ordered_variants(run["variant"] for run in cell.runs):
        run = next(run for run in cell.runs if run["variant"] == name)
        entries.append(
            (
                f"{name}\ncoarse step",
                number(run, "seconds_per_coarse_step"),
                variant_colour(name),
                None,
            )
        )
        entries.append(
            (f"{name}\nup-sampling", number(run, "seconds_per_upsampling"), style.SKY, None)
        )
    light = light_seconds(main_run(cell)) if cell.runs else math.nan
    for name in ordered_references(reference["reference"] for reference in cell.references):
        reference = next(r for r in cell.references if r["reference"] == name)
        value = number(reference, "seconds_per_step")
        ratio = value / light if light > 0.0 else math.nan
        entries.append(
            (f"reference {name}\n{workers_of(reference)}".strip(), value, "#555555", ratio)
        )
    entries = [entry for entry in entries if entry[1] > 0.0]
    if not entries:
        return None
    figure, axes = pyplot.subplots(figsize=(8.4, 0.7 + 0.36 * len(entries)), layout="constrained")
    lower = 10.0 ** math.floor(math.log10(min(entry[1] for entry in entries)) - 0.3)
    for i, (_, value, colour, ratio) in enumerate(entries):
        axes.barh(i, value - lower, 0.72, left=lower, color=colour, label="median time per step")
        text = style.seconds(value)
        text += "" if ratio is None or math.isnan(ratio) else f",  {style.three(float(ratio))} ×"
        axes.annotate(
            text, (value, i), xytext=(4, 0), textcoords="offset points", va="center", fontsize=8
        )
    axes.set(xscale="log", xlabel="time per step [s]", ylim=(len(entries) - 0.4, -0.6))
    axes.set_xlim(lower, 6.0 * max(entry[1] for entry in entries))
    axes.set_yticks(range(len(entries)), [entry[0].replace("\n", ", ") for entry in entries])
    name_unseen(axes.yaxis, "part of a step")
    axes.grid(axis="y", visible=False)
    return figure


def workers_of(item):
    """2 ranks × 1 thread, as far as it is known."""
    words = [
        f"{int(number(item, key))} {key[:-1] if number(item, key) == 1 else key}"
        for key in ("ranks", "threads")
        if number(item, key) > 0.0
    ]
    return " × ".join(words)
