# SPDX-License-Identifier: MIT
"""The published table of runs of `homespun strain`: errors of sheets and their bars, gains, and what
the claims of the run say of them.
"""
import math

from read.schema import claims, loads, main_method, main_reference
from read.stored import BadResults

STRAINS = (0.01, 0.1)
METHODS = {  # column: method
    "affine": "affine",
    "base": "base",
    "localized": "localized",
    "localized_p2": "localized+p2",
    "full_linear_base": "full-p2-micro",
    "full_linear": "full-p2",
    "full": "full",
}
CLAIMS = {  # column, and the claim that stands in it: PASS, FAIL or INCONCLUSIVE
    "full_against_base": ("closer-than.base", "full"),
    "localized_against_affine": ("closer-than.affine", "localized"),
    "full_against_localized": ("closer-than.localized", "full"),
}


def set_of(cell, law):
    """Medians of gains are of one set each: what holds for cells of patches does not for weaves."""
    return "drawn weaves" if "-drawn-" in cell else "weaves" if law == "yarn" else "cells"


def errors(results):
    """Mean errors of the sheets at 1 % and 10 % strain against the law that claims speak of, and
    their bars, in 1/1000 of strain x cell side; gains as gains.csv has them. What was not reached
    is not a number.
    """
    rows = [row for row in results.table("strain.csv") if not loads()[row["load"]]["is_infinite"]]
    law = {
        cell: main_reference(row["reference"] for row in rows if row["cell"] == cell)
        for cell in dict.fromkeys(row["cell"] for row in rows)
    }
    levels = {}  # {(cell, load, strain): {method: row}}
    for row in rows:
        if row["reference"] == law[row["cell"]] and (strain := published_strain(row["strain"])):
            levels.setdefault((row["cell"], row["load"], strain), {})[row["method"]] = row
    gains = {
        (row["cell"], row["load"], published_strain(row["strain"])): row
        for row in results.table("gains.csv")
        if (row["reference"], row["method"]) == (law.get(row["cell"]), "full")
    }
    lost = {
        (row["cell"], row["load"]): row["elliptic_up_to"]
        for row in results.table("validity.csv")
        if row["reference"] == law.get(row["cell"])
    }
    said = results.verdicts()
    for (cell, load, strain), some in levels.items():
        if main_method(some) != "full" and "unreached" not in some:
            continue  # a run without this method
        gain = gains.get((cell, load, strain), {})
        some["base"] = some.get(gain.get("base"))
        words = {"cell": cell, "load": load, "strain": f"{strain:g}", "reference": law[cell]}
        yield {
            "set": set_of(cell, law[cell]),
            **words,
            "cells_per_side": next(row["cells"] for row in some.values() if row),
            **{
                name + ending: per_strain(some.get(method), column)
                for name, method in METHODS.items()
                for ending, column in (("", "error_mean_m"), ("_bar", "error_bar_m"))
            },
            "base_method": gain.get("base", ""),
            **{
                name: gain.get(name, math.nan)
                for name in ("gain_of_coarse_cloth", "gain_of_upsampling", "gain_total")
            },
            "gain_over_localized": (
                per_strain(some.get("localized"), "error_mean_m")
                / per_strain(some.get("full"), "error_mean_m")
            ),
            "bar_safety": max(
                (some[name]["error_bar_safety"] for name in ("base", "full") if some.get(name)),
                default=math.nan,
            ),
            **{
                column: outcome_of(said, claim, {**words, "method": method})
                for column, (claim, method) in CLAIMS.items()
            },
            "law_lost_at": lost.get((cell, load), math.nan),
        }


def published_strain(strain):
    """The published strain that a level is of; None of another level."""
    return next((one for one in STRAINS if math.isclose(one, strain, rel_tol=1e-6)), None)


def per_strain(row, column):
    """A mean distance of a row [1/1000 of strain x cell side]; nan where there is no row."""
    if row is None:
        return math.nan
    return 1000.0 * row[column] * row["error_mean_per_cell"] / row["error_mean_m"] / row["strain"]


def outcome_of(said, claim, words):
    """What a run says of a claim.

    @param said its verdicts
    @throws BadResults where it says nothing
    """
    sentence = claims()[claim]["claim"].format(**words)
    for verdict in said:
        if verdict["claim"] == sentence:
            return verdict["verdict"]
    raise BadResults([f"verdicts.json has no claim `{sentence}`: run the study again"])
