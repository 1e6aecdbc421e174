# SPDX-License-Identifier: MIT
"""Reads budget.csv, runtime.csv, validity.csv and gains.csv of a strain study, and what follows from
their rows alone.
"""
import math

from read import schema
from read.stored import read_csv

# In their order, and what each is called in a figure.
PARTS = {
    "slip": "1 slip of clamped edges, anchor",
    "selvedge": "1 tension of free edges",
    "bulk": "1 strain gradients",
    "layer": "1 modes near edges",
    "rest": "1 rest: higher order in the cell, corners",
    "macro-law": "2 geometric nonlinearity, macro law",
    "modes": "2 geometric nonlinearity, modes",
    "coarse-mesh": "3 coarse mesh",
    "cell": "4 cell discretization",
    "blending": "5 strain averaging, blending",
    "time-step": "6 time step",
    "solver": "7 solver tolerance",
    "precision": "8 float against double",
    "reference": "the reference's own discretization",
    "resolution": "change of the resolved homogenized sheet from a mesh half as fine",
}
BESIDE_THE_SUM = ("cell", "reference", "precision", "resolution")
REGIONS = ("interior", "boundary", "corner")


def read_budget(path_of, results, faults):
    """Adds the four tables to the results; one that was left out is noted as such."""
    for name, rows, consequence in (
        ("budget.csv", results.budget, "the error budget"),
        ("runtime.csv", results.run_time, "error against run time of every way"),
        ("validity.csv", results.validity, "the range of validity"),
        ("gains.csv", results.gains, "gains of the coarse cloth and of up-sampling"),
    ):
        if path := path_of(name, consequence):
            rows += read_csv(path, faults, results.missing)


def base_rows(rows, gains, base="base"):
    """Rows of strain.csv once more, as those of `base`: of each level the one that is the base of the
    method that the page speaks of, where it is not the coarse mesh alone.
    """
    known = {level_of(row) + (row["method"],): row for row in rows}
    methods = {}
    for row in rows:
        methods.setdefault(level_of(row), []).append(row["method"])
    found = [
        known.get(level_of(gain) + (gain["base"],))
        for gain in gains
        if gain["base"] != "affine"
        and gain["method"] == schema.main_method(methods.get(level_of(gain), ()))
    ]
    return [{**row, "method": base} for row in found if row]


def level_of(row):
    return row["cell"], row["load"], row["reference"], row["strain"]


def levels(rows):
    """(load, strain) -> region -> part -> row, of one cell, levels with a total alone.

    Of several reference laws, as a study that was taken up again with others leaves them, the one
    counts that claims speak of.
    """
    table = {}
    law = schema.main_reference(row["reference"] for row in rows)
    for row in (row for row in rows if row["reference"] == law):
        table.setdefault((row["load"], row["strain"]), {}).setdefault(row["region"], {})[
            row["part"]
        ] = row
    return {key: regions for key, regions in table.items() if "total" in regions.get("all", {})}


def unexplained(parts, of="unexplained"):
    """Mean of what the parts leave of the error over its mean, or with `unexplained-bar` how large
    that may be; nan where it is not known or the error is zero.
    """
    total = parts["total"]["mean_m"]
    return parts[of]["mean_m"] / total if total > 0 and of in parts else math.nan


def worst_error(way, side):
    """Error of a way with the error bar of the best solution added; P2 is that solution, its error
    is the bar.
    """
    bar = way["reference_uncertainty_m"] / side
    return way["error_mean_per_cell"] + (bar if way["way"] != "fine-p2" and bar > 0 else 0.0)


def pareto_front(ways):
    """The ways that no other beats in both time and error, by time. Ways without either do not
    count.

    @param ways rows with `seconds` and `error_mean_per_cell`
    """
    known = [
        way for way in ways if way["seconds"] > 0 and not math.isnan(way["error_mean_per_cell"])
    ]
    front, best = [], math.inf
    for way in sorted(known, key=lambda w: (w["seconds"], w["error_mean_per_cell"])):
        if way["error_mean_per_cell"] < best:
            front.append(way)
            best = way["error_mean_per_cell"]
    return front
