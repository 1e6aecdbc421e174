# SPDX-License-Identifier: MIT
"""In what several cells or versions differ: every quantity they share, in percent of the first of
them, those that differ by more than their bars before those that do not.
"""
import math

from figures import style
from figures.style import number_with_bar, percent
from page import tables
from page.bars import bar_of
from page.entries import ENTRIES, MICRO
from read.schema import main_method
from read.stiffness import best_run, centre_and_bars

SAME = 1e-6  # relative; what differs by less is the same to round-off
UNKNOWN = " (one bar is not known)"


def differences(results, subjects):
    """{"rows": [[quantity, value of each, difference of each from the first]], "same": [names]}."""
    rows, same = [], []
    for name, unit, values in quantities(results, subjects):
        known = [pair for pair in values if pair is not None]
        if len(known) < 2 or values[0] is None:
            continue
        told = [difference(values[0], pair) for pair in values[1:]]
        if all(pair is None or is_same(values[0], pair) for pair in values[1:]):
            same.append(name + UNKNOWN * any(text.endswith(UNKNOWN) for text in told))
            continue
        largest = max(
            math.inf if not pair or is_zero(values[0]) else abs(pair[0] / values[0][0] - 1.0)
            for pair in values[1:]
        )
        texts = ["–" if pair is None else number_with_bar(*pair) for pair in values]
        rows.append((largest, [f"{name} [{unit}]", *texts, *told]))
    rows.sort(key=lambda row: -row[0])
    return {"rows": [row for _, row in rows], "same": same}


def is_same(one, other):
    """Whether two (value, bar) may be equal."""
    scale = max(abs(one[0]), abs(other[0]))
    bars = sum(bar for bar in (one[1], other[1]) if bar > 0.0)
    return abs(one[0] - other[0]) <= max(bars, SAME * scale)


def is_zero(pair):
    """Whether a (value, bar) may be zero, of which nothing is a percentage."""
    return abs(pair[0]) <= max(pair[1], 0.0) or not pair[0]


def difference(one, other):
    """+12 ± 3 %, from the first to another; the bar holds both, as far as they are known."""
    if other is None:
        return "–"
    bars = [bar / abs(value) for value, bar in (one, other) if bar > 0.0 and value]
    unknown = UNKNOWN * (math.isnan(one[1]) != math.isnan(other[1]))
    if is_same(one, other):
        return ("within the bars" if one[1] > 0.0 or other[1] > 0.0 else "0") + unknown
    if is_zero(one):
        return "from zero"
    change = 100.0 * (other[0] / one[0] - 1.0)
    bar = 100.0 * abs(other[0] / one[0]) * sum(bars)
    sign = "+" if change > 0.0 else "−"
    return f"{sign}{number_with_bar(abs(change), bar)} %{unknown}"


def quantities(results, subjects):
    """(name, unit, [(value, bar) of each subject or None])"""
    cells = [results.cells[s.name] for s in subjects]
    for key, factor, unit in (("C", 1.0, "N/m"), ("D", MICRO, "10⁻⁶ N m")):
        known = [best_run(cell, key) for cell in cells]
        pairs = [None if value is None else centre_and_bars(value, key) for value in known]
        for name, i, j in ENTRIES:
            yield f"{key}{name}", unit, [entry_of(pair, i, j, factor) for pair in pairs]
    densities = [(cell.homogenize or {}).get("areal_density") for cell in cells]
    yield "areal density", "kg/m²", [(float(d), math.nan) if d else None for d in densities]
    for strain in tables.CHOSEN_STRAINS:
        every = [errors_of(results, s, strain) for s in subjects]
        for load in style.ordered_loads(load for some in every for load in some):
            name = f"mean error, {load} at {percent(strain)}"
            yield name, "1/1000 of a cell side", [some.get(load) for some in every]


def entry_of(pair, i, j, factor):
    if pair is None:
        return None
    matrix, bars = pair
    return factor * float(matrix[i, j]), math.nan if bars is None else factor * float(bars[i, j])


def errors_of(results, subject, strain):
    """load -> (error, bar) [1/1000 of a cell side] of the method that the page speaks of."""
    rows = results.reached(subject.name)
    reference = tables.main_reference(rows)
    found = {}
    for load in {row["load"] for row in rows}:
        here = {
            row["method"]: row
            for row in rows
            if (row["load"], row["reference"]) == (load, reference)
            and math.isclose(row["strain"], strain, rel_tol=1e-6)
        }
        row = here.get(main_method(here))
        if row and row["error_mean_per_cell"] >= style.ROUND_OFF:
            side = row["error_mean_m"] / row["error_mean_per_cell"]
            bar = bar_of(row) / side
            found[load] = (1e3 * row["error_mean_per_cell"], 1e3 * bar)
    return found
