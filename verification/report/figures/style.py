# SPDX-License-Identifier: MIT
"""How the figures and the numbers look: one place for fonts, colours, names and rounding.

Colours are those of Okabe and Ito (2008), wine and olive of Tol, which readers with any colour
vision tell apart; phases of a cell go from light to dark with stiffness, so that they survive a
black-and-white print.
"""
import math

import matplotlib
from matplotlib import colors, ticker

from read import schema

matplotlib.use("Agg")  # no display on a compute node

BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, VERMILLION, PURPLE = (
    "#000000",
    "#E69F00",
    "#56B4E9",
    "#009E73",
    "#F0E442",
    "#0072B2",
    "#D55E00",
    "#CC79A7",
)

# What the curves of a first screen are called: readers need no name of a method for it.
COARSE, PAPER, CLOTH, HOMESPUN = (
    "coarse mesh", "paper", "coarse cloth of homespun", "homespun"
)
METHOD_COLOURS = {
    COARSE: VERMILLION,
    PAPER: BLUE,
    CLOTH: GREEN,
    HOMESPUN: BLACK,
    "affine": VERMILLION,
    "localized": BLUE,
    "localized+p2": "#999933",
    "localized+edges": "#882255",
    "localized+cubic+modes": SKY,
    "base": GREEN,
    "full": BLACK,
}
METHOD_LABELS = {"localized": "localized (the paper's method)",
                 "base": "base: coarse cloth of the page's method, not up-sampled"}
SPARE_COLOURS = ("#332288", "#44AA99", "#8A3A00", "#117733")
OWN_COLOURS = (PURPLE, ORANGE)  # of methods that were judged
COLOUR_NAMES = {VERMILLION: "orange", BLUE: "blue", "#999933": "olive", "#882255": "wine",
                SKY: "light blue", BLACK: "black", "#332288": "indigo", "#44AA99": "teal",
                GREEN: "green", ORANGE: "yellow", PURPLE: "pink",
                "#8A3A00": "brown", "#117733": "dark green"}

# Line style and marker of the methods where one law is shown: they survive black and white.
METHOD_STYLES = {
    COARSE: ("--", "s"), PAPER: (":", "^"), CLOTH: ("-.", "D"), HOMESPUN: ("-", "o"),
    "affine": ("--", "s"), "localized": (":", "^"), "base": ("-.", "D"), "full": ("-", "o"),
    "localized+p2": ("-.", "v"), "localized+edges": ("--", "P"),
    "localized+cubic+modes": (":", "X"),
}
SPARE_METHOD_STYLES = (("-.", "<"), ("--", ">"), (":", "X"), ("-", "p"))
OWN_STYLES = (((0, (7, 2, 1, 2, 1, 2)), "*"), ((0, (10, 2)), "h"), ((0, (3, 1)), "p"))

# Line style, marker and colour of the reference laws, in the order of the schema.
LAW_STYLES = ((":", "s", BLACK), ("-", "o", BLUE), ("--", "^", VERMILLION), ("-.", "v", PURPLE))
OTHER_LAW = ("-.", "D", GREEN)

# Colour and marker of the loads, in the order of the schema.
LOAD_STYLES = ((SKY, "v"), (BLUE, "^"), (PURPLE, "D"), ("#999933", "X"), (BLACK, "<"), ("#7F7F7F", ">"),
               (GREEN, "s"), (ORANGE, "o"), (VERMILLION, "P"))

# Two errors that differ by less than this part of a cell side are the same in double precision:
# positions of a sheet of 20 cells carry 16 digits, and solvers stop some digits earlier.
ROUND_OFF = 1e-11
ROUND_OFF_TEXT = "10⁻¹¹ cell sides"

RC = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.labelsize": 9,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "legend.fontsize": 8,
    "axes.grid": True,
    "grid.color": "#D9D9D9",
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.4,
    "lines.markersize": 4,
    "legend.frameon": False,
    "figure.dpi": 100,
    "savefig.dpi": 160,
    "svg.hashsalt": "homespun",  # the same input gives the same file
    "pdf.fonttype": 42,
}


def use():
    """Sets matplotlib up for all figures of the report."""
    matplotlib.rcParams.update(RC)


def is_judged(method):
    """Whether a method has none of the looks of homespun's: somebody's own, that was judged."""
    return method not in METHOD_COLOURS and not schema.is_of_homespun(method)


def place_of(method, methods):
    """Place of a method among those of its kind that take spare looks in turn: that of a judged
    method does not change with what else is shown.
    """
    some = [name for name in methods
            if name not in METHOD_COLOURS and is_judged(name) == is_judged(method)]
    return some.index(method) if method in some else 0


def method_colour(method, methods=()):
    """Colour of a method; methods that the report does not know take the spare colours in turn."""
    if method in METHOD_COLOURS:
        return METHOD_COLOURS[method]
    colours = OWN_COLOURS if is_judged(method) else SPARE_COLOURS
    return colours[place_of(method, methods) % len(colours)] if method in methods else BLACK


def colour_name(method, methods=()):
    """The colour of a method, in a word."""
    return COLOUR_NAMES[method_colour(method, methods)]


def method_style(method, methods=()):
    """(line style, marker) of a method."""
    if method in METHOD_STYLES:
        return METHOD_STYLES[method]
    styles = OWN_STYLES if is_judged(method) else SPARE_METHOD_STYLES
    return styles[place_of(method, methods) % len(styles)]


def line_of(number):
    """(colour, line style) of one of several things that have no colour of their own."""
    colours = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY, BLACK)
    return colours[number % len(colours)], ("-", "--", "-.", ":")[number % 4]


def reference_style(reference):
    """(line style, marker) of a reference law."""
    return law_style(reference)[:2]


def law_style(law):
    """(line style, marker, colour) of a law."""
    return dict(zip(schema.laws(), LAW_STYLES)).get(law, OTHER_LAW)


def is_infinite(load):
    """Whether a load is one of a cloth without edges."""
    return schema.loads().get(load, {"is_infinite": False})["is_infinite"]


def load_colour(load):
    return load_style(load)[0]


def load_marker(load):
    return load_style(load)[1]


def load_style(load):
    """(colour, marker) of a load."""
    return dict(zip(schema.loads(), LOAD_STYLES)).get(load, (BLACK, "X"))


def ordered_loads(loads):
    """Known loads in the order of the design, then the others by name."""
    loads = set(loads)
    known = schema.loads()
    return [load for load in known if load in loads] + sorted(loads.difference(known))


def ordered_methods(methods):
    """Known methods in the order of the design, then the others by name."""
    methods = set(methods)
    return [m for m in METHOD_COLOURS if m in methods] + sorted(methods.difference(METHOD_COLOURS))


def ordered_references(references):
    references, known = set(references), schema.laws()
    return [r for r in known if r in references] + sorted(references.difference(known))


def ramp(*between, number):
    """So many colours, from the first of the given ones to the last."""
    through = colors.LinearSegmentedColormap.from_list("ramp", between)
    return [colors.to_hex(through(k / max(1, number - 1))) for k in range(number)]


def phase_colours(stiffnesses):
    """One colour per phase, from light (softest) to dark (stiffest)."""
    shades = ramp("#F6ECD6", PURPLE, "#43215F", number=len(stiffnesses))
    order = sorted(range(len(stiffnesses)), key=lambda i: stiffnesses[i])
    result = [None] * len(order)
    for shade, i in zip(shades, order):
        result[i] = shade
    return result


def colours_of_materials(numbers, stiffnesses=None):
    """Material number -> colour, the same in every picture of a cell.

    @param stiffnesses of the materials in the order of their numbers; without them, or where a
        number has none, darker with the number
    """
    if not stiffnesses or any(not 0 <= n < len(stiffnesses) for n in numbers):
        return dict(zip(numbers, phase_colours(numbers)))
    every = phase_colours(stiffnesses)
    return {n: every[n] for n in numbers}


def log_axes(axes):
    """Logarithmic on both axes, strain or time in plain numbers where that is short."""
    axes.set(xscale="log", yscale="log")
    axes.xaxis.set_minor_formatter(ticker.NullFormatter())
    axes.xaxis.set_minor_locator(ticker.LogLocator(subs=(2, 5)))  # each tick takes its time
    # Ten decades of minor ticks are only grey and slow.
    axes.yaxis.set_minor_locator(ticker.NullLocator())


def three(value):
    """A number with three significant digits, for print: 0.0123, 4.56e-7 as 4.56 × 10⁻⁷."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    if isinstance(value, bool) or isinstance(value, str):
        return str(value)
    if value == 0:
        return "0"
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    if isinstance(value, int) and abs(value) < 10**9:
        return f"{value:,}".replace(",", "\u202f").replace("-", "−")
    value = float(f"{value:.2e}")
    exponent = math.floor(math.log10(abs(value)))
    if -4 < exponent < 6:
        return f"{value:.{max(0, 2 - exponent)}f}".replace("-", "−")
    superscript = str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{value / 10 ** exponent:.2f} × 10{superscript}".replace("-", "−")


def number_of(text):
    """The number that three() and beside_bar() print."""
    digits = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-", "\u202f")
    plain = text.translate(digits).replace(" × 10", "e")
    return float(plain)


def bar_beside(text, value, bar):
    """A guaranteed bar with two digits, rounded upwards, of what is printed in place of a value."""
    bar += abs(number_of(text) - value)
    if not 0.0 < bar < math.inf:
        return three(bar)
    last = math.floor(math.log10(bar)) - 1
    units = math.ceil(round(bar / 10.0**last, 9))
    last, units = (last + 1, 10) if units == 100 else (last, units)
    if -6 < last < 5:
        return f"{units * 10.0**last:.{max(0, -last)}f}"
    superscript = str(last + 1).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{units / 10.0:.1f} × 10{superscript}"


def beside_bar(value, bar):
    """A number with as many digits as its error bar justifies, two of the bar, but at most six:
    1001.5633 ± 0.31 as 1001.56, 1001.56 ± 11 as 1002; zero where the bar says no more.
    """
    if math.isnan(bar) or not bar > 0.0:
        return three(value)
    last = math.floor(math.log10(bar)) - 1  # place of the last digit
    if abs(value) < 0.5 * 10.0**last:
        return "0"
    first = math.floor(math.log10(abs(value)))
    if not -6 < first < 6:
        return three(value)
    digits = min(6, max(1, first - last + 1))
    return f"{value:.{max(0, digits - 1 - first)}f}".replace("-", "−")


def number_with_bar(value, bar):
    """A number and its error bar, as many digits as that justifies: 3.75 ± 0.50."""
    if not bar > 0.0 or math.isnan(value):
        return three(value)
    shown = beside_bar(value, bar)
    return f"{shown} ± {bar_beside(shown, value, bar)}"


def percent(strain):
    """A strain as a percentage without trailing zeros: 0.1 gives 10 %."""
    return f"{100 * strain:.6g} %"


def seconds(value):
    """A time in the unit that suits it."""
    if value is None or math.isnan(value):
        return "–"
    for limit, factor, unit in ((1e-3, 1e6, "µs"), (1.0, 1e3, "ms"), (120.0, 1.0, "s")):
        if value < limit:
            return f"{three(float(value * factor))} {unit}"
    return f"{three(float(value / 60.))} min"
