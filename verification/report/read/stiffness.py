# SPDX-License-Identifier: MIT
"""The one C^H and D^H of a cell that a page speaks of, whichever of its runs made it: the centre of
the best guaranteed bracket.
"""
import math

import numpy

BRACKETS = {"C": "bracket", "D": "bending_bracket"}


def best_run(cell, key):
    """The homogenize.json of a cell that knows C or D best: of the drawing rather than of a mesh,
    then by the narrowest bracket, whichever run of the page made it; None where none has it.
    """
    known = [(cell.command, cell.homogenize or {}), *cell.others]
    known = [value for _, value in known if value.get(key) is not None]

    def rank(value):
        bracket = value.get(BRACKETS[key]) or {}
        width = bracket.get("width")
        of = bracket.get("of") or value.get("bracket_of")
        return of != "drawing", width if isinstance(width, (int, float)) else math.inf

    return min(known, key=rank, default=None)


def centre_and_bars(value, key):
    """The centre of the guaranteed bracket of C or D and, entry by entry, how far from it the truth
    may lie; the matrix itself, with the bars that its run told of it, if any, where the sides are not there.

    With lower <= X <= upper and H half of upper - lower, |X - centre|_ij <= sqrt(H_ii H_jj).
    """
    sides = [value.get(f"{key}_{side}") for side in ("lower", "upper")]
    if None in sides:
        bars = (value.get(BRACKETS[key]) or {}).get("entry_bars")
        return numpy.array(value[key], dtype=float), None if bars is None else numpy.array(bars)
    lower, upper = (numpy.array(side, dtype=float) for side in sides)
    half = numpy.sqrt(numpy.maximum(numpy.diag(upper - lower) / 2.0, 0.0))
    return (lower + upper) / 2.0, numpy.outer(half, half)


def homogenized(cell, key="C"):
    """The centre of the best bracket (3,3) [N/m, N m], or None where no run has it."""
    value = best_run(cell, key)
    return None if value is None else centre_and_bars(value, key)[0]
