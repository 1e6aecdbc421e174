# SPDX-License-Identifier: MIT
"""What the report shows of `homespun bend`: how far an up-sampled sheet that bends is off in
position and normal, and what terms of edges and the deflection of the cell gain, apart.
"""
import math

from markupsafe import Markup, escape

from figures.bend import (HEADER, LOOKS, curve_figure, dot_figure, dot_rows, is_worth_a_figure,
                          ordered_methods)
from figures.style import number_with_bar, seconds, three
from page.tables import length, length_with_bar
from page.words import listed
from page.wrinkle_contents import wrinkle_rows, wrinkle_sentences
from read.bend_results import LINEAR, NORMAL, POSITION, radius_of

QUANTITIES = (POSITION, NORMAL)
DEGREES = 180.0 / math.pi
DOTS = Markup(
    "A sheet of <code>{cell}</code>, {cells} × {cells} cells, under each load: mean error of its"
    " vertices against {reference}, with error bars (below the size of the mark where none is seen)."
    " k is the curvature of the homogenized sheet, root mean square, that the load makes in linear"
    " theory, and ε the side of the cell."
    " Names in bend.csv, from top to bottom: {methods}."
)
CURVES = Markup(
    "The same errors against curvature, over the size of a fluctuation, k ε² or k ε: level where an"
    " error is proportional to the curvature.{linear}{shaded} Vertical lines: error bars."
)


def with_bar(what, row):
    """An error and its bar in the unit of its quantity: 6.60 ± 0.036 µm, 0.136 ± 0.00080°."""
    value, bar = what.of(row), what.of(row, "bar")
    if what is POSITION:
        return length_with_bar(value, bar)
    return f"{number_with_bar(DEGREES * value, DEGREES * bar)}°"


def radius_words(row):
    return f"{100.0 * radius_of(row):.3g} cm"


def span(pairs, text):
    """a (load) to b (load), the smallest and the largest.

    @param pairs [(load, value)]
    @param text of a value
    """
    low, high = (end(pairs, key=lambda pair: pair[1]) for end in (min, max))
    ends = dict.fromkeys(f"{text(load)} ({load})" for load, _ in (low, high))
    return " to ".join(ends)


def errors(sheets, method, what):
    """Over the loads, the error of a method with its bar; empty where there is none."""
    rows = {bent.load: bent.rows[method] for bent in sheets if bent.known(method, what)}
    pairs = [(load, what.of(row)) for load, row in rows.items()]
    return span(pairs, lambda load: with_bar(what, rows[load])) if pairs else ""


def times(gains):
    """1.07 (twist) to 1.09 (pressure)."""
    factors = {gain.load: max(gain.factor, 1.0 / gain.factor) for gain in gains}
    return span(list(factors.items()), lambda load: three(factors[load]))


def gain_words(gains, subject):
    """What makes an error how much smaller, over all loads; empty without any.

    @param subject and verb, such as `terms of edges make it`
    """
    of = by_state(gains)
    parts = []
    for state, words in (
        ("smaller", "{} times smaller"),
        ("larger", "{} times larger"),
        ("same", "no different, within the error bars, under {}"),
        ("unknown", "smaller or larger under {}, which no error bar tells"),
        ("none", "zero, as it was, under {}"),
    ):
        if some := of.get(state):
            loads = listed(gain.load for gain in some)
            parts.append(words.format(times(some) if "times" in words else loads))
    return f"{subject} {', '.join(parts)}" if parts else ""


def by_state(gains):
    of = {}
    for gain in gains:
        of.setdefault(gain.state, []).append(gain)
    return of


def gains_of(sheets, what):
    """(by terms of edges, by the deflection of the cell on the better of the others)"""
    edges = [bent.gain(what, "affine+edges", "affine") for bent in sheets]
    cell = [bent.gain(what, bent.best(), bent.base(what)) for bent in sheets]
    return [gain for gain in edges if gain], [gain for gain in cell if gain]


def gains_nothing(sheets, what):
    """Loads under which the deflection of the cell gains nothing by more than the bars, neither alone
    nor beside the terms of edges.
    """
    return [
        bent.load
        for bent in sheets
        for pair in [
            (bent.gain(what, bent.best(), bent.base(what)), bent.gain(what, "localized", "affine"))
        ]
        if any(pair) and all(gain is None or gain.state in ("same", "larger") for gain in pair)
    ]


def first_sentence(sheets):
    """Where positions gain nothing from the deflection of the cell that; else what all terms leave."""
    row = next(iter(sheets[0].rows.values()))
    radius = f"a radius of {radius_words(row)} ({1.0 / row['curvature_times_cell']:.3g} cell sides"
    bent = (
        f"Bent to {radius}, linear theory)"
        if row["reference"] == LINEAR
        else f"At large turns ({row['reference']}), under loads that in linear theory bend to {radius})"
    )
    if nothing := gains_nothing(sheets, POSITION):
        of = by_state(gains_of(sheets, POSITION)[1])
        where = "any load" if len(nothing) == len(sheets) else listed(nothing)
        rest = ""
        if "smaller" in of:
            rest += f"; elsewhere it makes their error {times(of['smaller'])} times smaller"
        if "larger" in of:
            rest += (
                f"; with all terms their error is {times(of['larger'])} times that of the better of"
                " the sheets without it"
            )
        return (
            f"{bent}, positions gain nothing beyond the error bars from the deflection of the cell under"
            f" {where}{rest}."
        )
    best = sheets[0].best()
    with_all = "with all terms" if best == "full" else LOOKS[best][0]
    return (
        f"{bent}, positions are {errors(sheets, best, POSITION)} off {with_all}, and normals"
        f" {errors(sheets, best, NORMAL)}."
    )


def size_sentences(sheets):
    """What the methods leave, position and normal."""
    return [
        f"{what.name.capitalize()}s: "
        + "; ".join(
            f"{words} {error}"
            for method, words in (
                ("flat", "flat triangles are off by"),
                ("affine", "the homogenized sheet by"),
                ("localized", "with the deflection of the cell by"),
                ("full", "with all terms by"),
            )
            if (error := errors(sheets, method, what))
            and not (method == "localized" and sheets[0].best() == "full")
        )
        + "."
        for what in QUANTITIES
    ]


def gain_sentences(sheets):
    """The two gains over all loads, position and normal, as far as first_sentence() has not said it."""
    found = []
    for what in QUANTITIES:
        edges, cell = gains_of(sheets, what)
        nothing = gains_nothing(sheets, what) if what is POSITION else []
        if nothing:  # which the first sentence says, as it says what is smaller and larger
            told = ("smaller", "larger")
            cell = [one for one in cell if one.load not in nothing and one.state not in told]
        words = [
            gain_words(edges, "terms of edges make it"),
            gain_words(
                cell, f"the deflection of the cell makes {'what is left' if edges else 'it'}"
            ),
        ]
        if any(words):
            found.append(
                f"Error of the {what.name}s of the homogenized sheet:"
                f" {'; '.join(one for one in words if one)}."
            )
    if not any("full" in bent.rows for bent in sheets):
        found.append("What clamps and free edges add is not known of this cell, and left in all errors.")
    return found


def losses(sheets):
    """Where the deflection of the cell alone, without terms of edges, is farther off."""
    parts = []
    for what in QUANTITIES:
        some = [bent.gain(what, "localized", "affine") for bent in sheets]
        some = [gain for gain in some if gain and gain.state == "larger"]
        if some:
            loads = (f"{100.0 / gain.factor - 100.0:.2g} % ({gain.load})" for gain in some)
            parts.append(f"of {what.name}s by {listed(loads)}")
    if not parts:
        return []
    return [
        "Without terms of edges the deflection of the cell makes errors larger, by more than their bars:"
        f" {'; '.join(parts)}."
    ]


def beyond_linear(run, cell, sheets):
    """How the error of the best method, over its curvature, has grown at the tightest radius."""
    shown = next(iter(sheets[0].rows.values()))
    rows = run.of(cell, shown["reference"])
    tightest = max(row["curvature_times_cell"] for row in rows)
    if shown["reference"] == LINEAR or tightest <= shown["curvature_times_cell"]:
        return []
    there = {
        (row["load"], row["method"]): row for row in rows if row["curvature_times_cell"] == tightest
    }
    sentences = []
    for what in QUANTITIES:
        grown = {}
        for bent in sheets:
            here, row = bent.rows.get(bent.best()), there.get((bent.load, bent.best()))
            if here and row and what.of(here) > 0 and math.isfinite(what.of(row)):
                grown[bent.load] = what.relative(row) / what.relative(here)
        if grown:
            sentences.append(
                f"Under loads that in linear theory bend to a radius of {1.0 / tightest:.3g} cell sides,"
                f" {what.name} errors over the load are"
                f" {span(list(grown.items()), lambda load, its=grown: three(its[load]))}"
                f" times those at {1.0 / shown['curvature_times_cell']:.3g} cell sides."
            )
    return sentences


def roll_sentences(run, cell):
    """Where the curvature of the table exceeds that up to which D^H holds."""
    radius, rows = run.least_radius(cell), run.of(cell)
    beyond = sorted({
        row["curvature_times_cell"]
        for row in rows
        if radius and row["curvature_per_m"] * radius > 1.0
    })
    if not beyond:
        return []
    return [
        f"Dᴴ holds to 2 % along every direction down to a radius of {length(radius)}:"
        f" curvatures × cell side from {three(beyond[0])} are tighter, and a cell then stretches where"
        " it bends, which no method here knows."
    ]


def absent_sentence(run, cell, sheets):
    """Loads that have no error at the curvature that the page speaks of."""
    shown = {bent.load for bent in sheets}
    absent = list(dict.fromkeys(row["load"] for row in run.of(cell) if row["load"] not in shown))
    return [f"No error is known at this radius under {listed(absent)}."] if absent else []


def gain_rows(sheets):
    """Per load the two gains of each quantity."""
    table = []
    for bent in sheets:
        cells = [bent.load]
        for what in QUANTITIES:
            base = bent.base(what)
            for gain in (bent.gain(what, "affine+edges", "affine"),
                         bent.gain(what, bent.best(), base)):
                cells.append(gain_text(gain))
            cells.append(LOOKS[base][0] if base else "–")
        table.append(cells)
    return table


def gain_text(gain):
    if gain is None or gain.state == "none":
        return "–"
    note = {"same": " (within bars)", "unknown": " (no bar)"}.get(gain.state, "")
    return three(gain.factor) + note


def error_groups(sheets):
    """Rows of errors in thousandths of k eps² and k eps, by load."""
    groups = []
    for bent in sheets:
        rows = []
        for method in ordered_methods(bent.rows.values()):
            row, cells = bent.rows[method], []
            for what in QUANTITIES:
                mean, bar, *parts = (
                    1e3 * what.relative(row, part) for part in ("mean", "bar", "interior", "edge")
                )
                cells += [number_with_bar(mean, bar), *map(three, parts)]
            rows.append([LOOKS.get(method, (method,))[0], *cells])
        groups.append({"load": bent.load, "rows": rows})
    return groups


def sizes_of(sheets):
    first = next(iter(sheets[0].rows.values()))
    return (
        f"At a radius of {radius_words(first)}, k ε² is {length(POSITION.size(first))} and k ε"
        f" {three(DEGREES * NORMAL.size(first))}°."
    )


def pictures(run, cell, reference, sheets, gallery):
    rows = run.of(cell)
    first = next(iter(sheets[0].rows.values()))
    methods = listed(
        f"{LOOKS[method][0]} = {method}"
        for method in ordered_methods(row for bent in sheets for row in bent.rows.values())
        if method in LOOKS
    )
    caption = DOTS.format(cell=cell, cells=int(first["cells"]), methods=methods,
                          reference=reference_words(reference))
    found = [
        gallery.add(dot_figure(sheets), f"bend-{cell}", caption, table=(HEADER, dot_rows(sheets)),
                    plotted=False)
    ]
    if is_worth_a_figure(rows):
        radius = run.least_radius(cell)
        shaded = f" Shaded, right of the line: tighter than {length(radius)}, where Dᴴ no longer holds to 2 %." if radius else ""
        linear = " Thin dotted lines: linear theory." if LINEAR in run.references(cell) else ""
        ordered = sorted(rows, key=lambda row: run.references(cell).index(row["reference"]))
        found.append(
            gallery.add(curve_figure(ordered, radius), f"bend-{cell}-curvature",
                        CURVES.format(linear=escape(linear), shaded=escape(shaded)))
        )
    return found


def reference_words(reference):
    return (
        "the resolved plate of its phases in linear theory, where errors are proportional to the"
        " curvature"
        if reference == LINEAR
        else f"the resolved sheet of its phases under the law {reference}, at large turns"
    )


def time_sentence(sheets):
    rows = [next(iter(bent.rows.values())) for bent in sheets]
    spans = []
    for key in ("seconds_reference", "seconds_methods"):
        values = [row[key] for row in rows if math.isfinite(row[key])]
        if not values:
            return []
        spans.append(" to ".join(dict.fromkeys(seconds(end(values)) for end in (min, max))))
    return [f"Run time per load: {spans[0]} the reference, {spans[1]} the homogenized sheets with all methods."]


def bend_contents(run, gallery):
    """Per cell sentences, figures and tables."""
    cells = []
    for name in run.names():
        reference, *others = run.references(name)
        sheets = run.sheets(name, reference)
        if not sheets:
            continue
        wrinkles = [row for row in run.wrinkles if row["cell"] == name]
        cells.append(
            {
                "name": name,
                "sentences": [first_sentence(sheets)]
                + size_sentences(sheets)
                + gain_sentences(sheets)
                + absent_sentence(run, name, sheets)
                + roll_sentences(run, name),
                "more": losses(sheets) + beyond_linear(run, name, sheets) + time_sentence(sheets),
                "pictures": pictures(run, name, reference, sheets, gallery),
                "gains": gain_rows(sheets),
                "tables": [
                    {"reference": reference_words(one), "groups": error_groups(run.sheets(name, one))}
                    for one in (reference, *others)
                ],
                "sizes": sizes_of(sheets),
                "wrinkle_sentences": wrinkle_sentences(wrinkles),
                "wrinkles": wrinkle_rows(wrinkles),
            }
        )
    return {"name": run.name, "cells": cells}
