# SPDX-License-Identifier: MIT
"""C^H and D^H entry by entry, each under one name and with its guaranteed bar."""
import math

import numpy

from figures.style import bar_beside, beside_bar, three
from read.stiffness import best_run, centre_and_bars

# All six of a symmetric matrix in Voigt order 11, 22, 12, for all tables of the report.
ENTRIES = (("11", 0, 0), ("22", 1, 1), ("12", 0, 1), ("66", 2, 2), ("16", 0, 2), ("26", 1, 2))
MICRO = 1e6
ELEMENTS = {1: "linear triangles", 2: "quadratic triangles"}


def entry_texts(cell, key, factor=1.0):
    """name -> (value, bar) of C or D as text, with as many digits as the bar justifies; "–" where
    there is no matrix, or no bar.
    """
    value = best_run(cell, key)
    if value is None:
        return {name: ("–", "–") for name, _, _ in ENTRIES}
    matrix, bars = centre_and_bars(value, key)
    largest = numpy.abs(matrix).max()
    texts = {}
    for name, i, j in ENTRIES:
        entry = matrix[i, j] if abs(matrix[i, j]) > 1e-9 * largest else 0.0
        bar = bars[i, j] if bars is not None else math.nan
        text = beside_bar(factor * entry, factor * bar)
        texts[name] = (
            text,
            "–" if math.isnan(bar) else bar_beside(text, factor * matrix[i, j], factor * bar),
        )
    return texts


def stiffness_rows(cell):
    """[name, C, bar, D, bar] as text: N/m and 1e-6 N m."""
    C, D = entry_texts(cell, "C"), entry_texts(cell, "D", MICRO)
    return [[name, *C[name], *D[name]] for name, _, _ in ENTRIES]


def bracket_words(cell):
    """Of what the bars of C^H are, in a sentence."""
    value = best_run(cell, "C")
    if value is None or centre_and_bars(value, "C")[1] is None:
        return "No bracket was computed: the stiffness is that of the mesh, and has no bar."
    of = value.get("bracket_of", "mesh")
    return f"Centre of the guaranteed bracket of the {of}; ± is half its width and the rounding of what is shown."


def with_bar(text_and_bar):
    """`2840 ± 3.1` of (value, bar); the value alone where there is no bar."""
    value, bar = text_and_bar
    return value if bar == "–" or value == "–" else f"{value} ± {bar}"


def source_of(homogenize, command):
    """Where a C^H comes from, in words: `homogenize, quadratic triangles`."""
    return ", ".join([command] + [ELEMENTS[o] for o in [homogenize.get("order")] if o in ELEMENTS])


def used_stiffnesses(cell):
    """{"names", "rows"} of the C that the runs of the page computed with, each of its own mesh; of
    runs that agree the first alone. None where that is the C^H of the page, as it prints.
    """
    every = [(cell.command, cell.homogenize or {}), *cell.others]
    shown, columns = entry_texts(cell, "C"), []
    for command, value in every:
        if value.get("C") is None:
            continue
        texts = []
        for name, i, j in ENTRIES:
            size = abs(value["C"][i][j]) / numpy.abs(value["C"]).max()
            texts.append(like(shown[name][0], value["C"][i][j] if size > 1e-9 else 0.0))
        if texts not in [known for _, known in columns]:
            columns.append((source_of(value, command), texts))
    if all(texts == [shown[name][0] for name, _, _ in ENTRIES] for _, texts in columns):
        return None
    return {
        "names": [name for name, _ in columns],
        "rows": [
            [f"C{name}", *(texts[k] for _, texts in columns)] for k, (name, _, _) in enumerate(ENTRIES)
        ],
    }


def like(text, value):
    """A value with as many decimals as another number was printed with."""
    if "×" in text or text == "–":
        return three(float(value))
    return f"{value:.{len(text.partition('.')[2])}f}".replace("-", "−")
