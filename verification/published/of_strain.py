# SPDX-License-Identifier: MIT
"""The published tables of runs of `homespun strain`: errors, their ladder of methods, times, budget."""
import math
from statistics import median

from read.schema import loads, main_method, main_reference

STRAIN, LARGE_STRAIN, REFERENCE = 0.01, 0.1, "biot"
LADDER = ("affine", "localized", "localized+edges", "localized+cubic+modes", "localized+p2", "full",
          "full-cubic-modes")


def is_sheet(load):
    return not loads()[load]["is_infinite"]


def level(rows, cell, load, strain):
    """{method: row} of one level against the law that the claims of the cell speak of."""
    law = main_reference(row["reference"] for row in rows if row["cell"] == cell)
    return {
        row["method"]: row
        for row in rows
        if (row["cell"], row["load"], row["reference"]) == (cell, load, law)
        and math.isclose(row["strain"], strain, rel_tol=1e-6)
        and not math.isnan(row["error_mean_m"])
    }


def errors(results):
    """Mean errors of the sheets at 1 % strain against biot, in 1/1000 of strain x cell side; shares
    in percent.

    Share of the affine error left: localized / affine. Share of the fluctuation left: localized /
    mean |reference − homogenized sheet resolved on a fine mesh|.
    """
    rows = [
        row
        for row in results.table("strain.csv")
        if row["reference"] == REFERENCE
        and is_sheet(row["load"])
        and math.isclose(row["strain"], STRAIN, rel_tol=1e-6)
    ]
    for cell, load in dict.fromkeys((row["cell"], row["load"]) for row in rows):
        some = {row["method"]: row for row in rows if (row["cell"], row["load"]) == (cell, load)}
        if not {"affine", "localized"} <= some.keys():
            continue
        affine, localized = some["affine"], some["localized"]
        per = {
            name: 1000.0 * row["error_mean_per_cell"] / row["strain"] for name, row in some.items()
        }
        side = affine["error_mean_m"] / affine["error_mean_per_cell"]
        yield {
            "cell": cell,
            "load": load,
            "cells_per_side": affine["cells"],
            "affine": per["affine"],
            "localized": per["localized"],
            "reference_bar": (
                1000.0 * localized["reference_uncertainty_m"] / side / localized["strain"]
            ),
            "share_of_affine_left": 100.0 * per["localized"] / per["affine"],
            "share_of_fluctuation_left": 100.0 * localized["error_mean_per_fluctuation"],
        }


def ladder(results):
    """Mean errors of all methods on the sheets at 1 % and 10 % strain against biot, or of weaves
    against yarn, in 1/1000 of strain x cell side. Columns of 10 % end in `_10`, empty where no
    equilibrium was reached. Gain: localized / main, the method that pages speak of.
    """
    rows = [row for row in results.table("strain.csv") if is_sheet(row["load"])]
    for cell, load in dict.fromkeys((row["cell"], row["load"]) for row in rows):
        small, large = (level(rows, cell, load, strain) for strain in (STRAIN, LARGE_STRAIN))
        if not set(LADDER[:2]) < small.keys() or spoken_of(small) == "localized":
            continue
        localized = small["localized"]
        yield {
            "cell": cell,
            "load": load,
            "reference": localized["reference"],
            "cells_per_side": localized["cells"],
            **of_ladder(small, ""),
            "main_method": spoken_of(small),
            **of_ladder(large, "_10"),
        }


def spoken_of(some):
    """The method that pages speak of among the rows of a level, by method."""
    return main_method(some)


def per_strain(some, method):
    """Mean error of a method at a level [1/1000 of strain x cell side]; nan where it has none."""
    row = some.get(method)
    return math.nan if row is None else 1000.0 * row["error_mean_per_cell"] / row["strain"]


def of_ladder(some, ending):
    """Errors of all methods at one level, the bar of the reference, and the gain."""
    localized = some.get("localized")
    bar = math.nan
    if localized:
        side = localized["error_mean_m"] / localized["error_mean_per_cell"]
        bar = 1000.0 * localized["reference_uncertainty_m"] / side / localized["strain"]
    main = per_strain(some, spoken_of(some))
    values = {
        **{method: per_strain(some, method) for method in LADDER},
        "reference_bar": bar,
        "main": main,
        "gain": per_strain(some, "localized") / main,
    }
    return {name + ending: value for name, value in values.items()}


def times(results):
    """Medians of one load step over strains and sheet loads [ms, s], and their ratio from the
    smallest to the largest load.
    """
    rows = [
        row
        for row in results.table("levels.csv")
        if row["reference_stability"] and is_sheet(row["load"]) and row["reference"] == REFERENCE
    ]
    for cell in dict.fromkeys(row["cell"] for row in rows):
        by_load = {}
        for row in rows:
            if row["cell"] == cell:
                by_load.setdefault(row["load"], []).append(row)
        middle = [
            {
                key: median(row[key] for row in some)
                for key in ("seconds_coarse_solve", "seconds_upsample", "seconds_fine_step")
            }
            for some in by_load.values()
        ]
        ratios = [
            m["seconds_fine_step"] / (m["seconds_coarse_solve"] + m["seconds_upsample"])
            for m in middle
        ]
        fine = [m["seconds_fine_step"] for m in middle]
        yield {
            "cell": cell,
            "coarse_ms": 1e3 * median(m["seconds_coarse_solve"] for m in middle),
            "upsampling_ms": 1e3 * median(m["seconds_upsample"] for m in middle),
            "fine_s_least": min(fine),
            "fine_s_most": max(fine),
            "ratio_least": min(ratios),
            "ratio_most": max(ratios),
            "ranks": rows[0]["ranks"],
        }


def budget(results):
    """What the parts leave of the measured error of each level, and its bar, in percent."""
    if not results.run.holds("budget.csv"):
        return
    levels = {}
    for row in results.table("budget.csv"):
        if row["region"] == "all" and row["reference"] == REFERENCE:
            levels.setdefault((row["cell"], row["load"], row["strain"]), {})[row["part"]] = row[
                "mean_m"
            ]
    for (cell, load, strain), parts in levels.items():
        if parts.get("total", 0.0) > 0.0 and {"unexplained", "unexplained-bar"} <= parts.keys():
            yield {
                "cell": cell,
                "load": load,
                "strain": strain,
                "unexplained": 100.0 * parts["unexplained"] / parts["total"],
                "unexplained_bar": 100.0 * parts["unexplained-bar"] / parts["total"],
            }
