# SPDX-License-Identifier: MIT
"""The published table of runs of `homespun bend`: errors of sheets that bend, of position and normal,
and what the claims of the run say of them.
"""
import math

from of_strain import outcome_of

METHODS = ("flat", "affine", "localized", "affine+edges", "full")
BASES = ("affine", "affine+edges")  # without the deflection of the cell
QUANTITIES = {  # what: columns of an error and its bar, power of the cell side in its unit
    "position": ("error_mean_m", "error_bar_m", 2),
    "normal": ("normal_error_mean_rad", "normal_error_bar_rad", 1),
}
CLAIMS = {  # column, and the claim that stands in it: PASS, FAIL or INCONCLUSIVE
    "full_against_base": ("bent-closer.base", "full"),
    "localized_against_affine": ("bent-closer.localized", "localized"),
}


def bending(results):
    """Mean errors and their bars in linear theory, in 1/1000 of curvature x cell side², of normals
    of curvature x cell side. What is not known is not a number.
    """
    levels = {}  # {(cell, load): {method: row}}, of the first curvature: errors are proportional
    for row in results.table("bend.csv"):
        if row["reference"] == "linear":
            levels.setdefault((row["cell"], row["load"]), {}).setdefault(row["method"], row)
    said = results.verdicts()
    for (cell, load), some in levels.items():
        for what, (error, bar, power) in QUANTITIES.items():
            words = {"cell": cell, "load": load, "what": what}
            bases = [per_curvature(some[name], error, power) for name in BASES if name in some]
            yield {
                **words,
                "cells_per_side": next(iter(some.values()))["cells"],
                **{
                    name + ending: per_curvature(some.get(name), column, power)
                    for name in METHODS
                    for ending, column in (("", error), ("_bar", bar))
                },
                "base": min(bases, default=math.nan),
                **{
                    column: outcome_of(said, claim, {**words, "method": method})
                    for column, (claim, method) in CLAIMS.items()
                },
            }


def per_curvature(row, column, power):
    """An error of a row [1/1000 of curvature x cell side^power]; nan where there is no row."""
    if row is None:
        return math.nan
    return 1000.0 * row[column] / (row["curvature_times_cell"] * row["cell_side_m"] ** (power - 1))
