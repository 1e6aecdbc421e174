# SPDX-License-Identifier: MIT
"""C^H and D^H entry by entry, each under one name and with its guaranteed bar."""
import math

import numpy

from figures.style import bar_beside, beside_bar

# All six of a symmetric matrix in Voigt order 11, 22, 12, for all tables of the report.
ENTRIES = (("11", 0, 0), ("22", 1, 1), ("12", 0, 1), ("66", 2, 2), ("16", 0, 2), ("26", 1, 2))
MICRO = 1e6
ELEMENTS = {1: "linear triangles", 2: "quadratic triangles"}


def entry_texts(homogenize, key, factor=1.0):
    """name -> (value, bar) of C or D as text, with as many digits as the bar justifies; "–" where
    there is no matrix, or no bar.

    @param homogenize homogenize.json
    """
    matrix = (homogenize or {}).get(key)
    if matrix is None:
        return {name: ("–", "–") for name, _, _ in ENTRIES}
    bracket = homogenize.get("bracket" if key == "C" else "bending_bracket") or {}
    bars = bracket.get("entry_bars")
    largest = numpy.abs(numpy.array(matrix, dtype=float)).max()
    texts = {}
    for name, i, j in ENTRIES:
        value = matrix[i][j] if abs(matrix[i][j]) > 1e-9 * largest else 0.0
        bar = bars[i][j] if bars else math.nan
        text = beside_bar(factor * value, factor * bar)
        texts[name] = (
            text,
            "–" if math.isnan(bar) else bar_beside(text, factor * matrix[i][j], factor * bar),
        )
    return texts


def stiffness_rows(cell):
    """[name, C, bar, D, bar] as text: N/m and 1e-6 N m."""
    C, D = entry_texts(cell.homogenize, "C"), entry_texts(cell.homogenize, "D", MICRO)
    return [[name, *C[name], *D[name]] for name, _, _ in ENTRIES]


def with_bar(text_and_bar):
    """`2840 ± 3.1` of (value, bar); the value alone where there is no bar."""
    value, bar = text_and_bar
    return value if bar == "–" or value == "–" else f"{value} ± {bar}"


def source_of(homogenize, command):
    """Where a C^H comes from, in words: `homogenize, quadratic triangles`."""
    return ", ".join([command] + [ELEMENTS[o] for o in [homogenize.get("order")] if o in ELEMENTS])


def other_stiffnesses(cell):
    """{"names", "rows"} where runs of the page used several C^H of one cell; None where there is
    one.
    """
    if not cell.others:
        return None
    every = [(cell.command, cell.homogenize), *cell.others]
    texts = [entry_texts(value, "C") for _, value in every]
    return {
        "names": [source_of(value, command) for command, value in every],
        "rows": [[f"C{name}", *(with_bar(text[name]) for text in texts)] for name, _, _ in ENTRIES],
    }
