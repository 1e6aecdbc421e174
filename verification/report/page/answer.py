# SPDX-License-Identifier: MIT
"""The answer of the page: what up-sampling does to the error under each load, and why, in
sentences that need no other part of the page.
"""
import math

from figures import style
from figures.run_time import speed_ratio
from figures.strain import error_figure
from figures.style import percent, three
from page import tables
from page.budget_contents import validity_text
from read import schema
from read.budget_results import levels
from read.results import cell_side
from read.schema import main_method

# What each part of the budget is, after "because"; only parts of the sum are causes.
CAUSES = {
    "slip": "clamped edges slip by a part of a cell, which the anchor leaves out",
    "selvedge": "free edges are stiffer or softer than the rest",
    "bulk": "the cell resists gradients of strain",
    "layer": "near the edges the cells do not repeat",
    "rest": "cells are not small beside the sheet and its corners",
    "macro-law": "the cloth answers finite strain otherwise than small strain",
    "modes": "a cell answers finite strain otherwise than small strain",
    "coarse-mesh": "the coarse mesh is too coarse",
    "blending": "strain is averaged between coarse triangles",
    "solver": "the solvers stopped early",
}
# What a term of a method takes away of the budget, which is that of `localized`.
TAKEN_AWAY = {"edges": ("slip", "selvedge", "bulk", "layer"), "cubic": ("macro-law",),
              "modes": ("modes",)}
PAPER = "localized"
SECOND_CAUSE = 0.25  # share of the error from which a second cause is named
VALIDITY_LIMIT = 0.01  # of a cell side
PANEL = (1.78, 1.32)  # inches of a panel of the small Figure 3


def answer_of(results, name, gallery):
    """What stands on the first screen of one cell, or None where no error is known.

    @return {"name", "strain", "reference", "lines", "figure", "ratio", "side", "quick"}; a line is
            {"load", "title", "change", "mark", "sentence", "valid"}
    """
    rows = results.reached(name)
    reference = tables.main_reference(rows)
    rows = [row for row in rows if row["reference"] == reference]
    strains = tables.nearest_strains(rows)
    if not strains:
        return None
    here = [row for row in rows if row["strain"] == strains[0]]
    budget = levels([row for row in results.budget if row["cell"] == name])
    lines = []
    for load in sheets_first(row["load"] for row in here):
        some = {row["method"]: row for row in here if row["load"] == load}
        method = main_method(some)
        if method in some and "affine" in some:
            parts = budget.get((load, strains[0]), {}).get("all")
            line = line_of(load, some["affine"], some[method], parts)
            line["sentence"] += beside_the_paper(some[method], some.get(PAPER))
            if line["mark"] != "open":  # where the bar is named already
                line["sentence"] += beside_the_bar(some[method])
            lines.append({**line, "valid": valid_up_to(results, name, load, reference, method)})
    if not lines:
        return None
    side = cell_side(results, name)
    ratio = speed_ratio(results.reached(name), reference)
    methods = style.ordered_methods(
        {"affine", PAPER}
        | {
            main_method({r["method"] for r in here if r["load"] == load})
            for load in {r["load"] for r in here}
        }
    )
    figure, _ = error_figure(rows, methods, [reference], side, panel=PANEL)
    return {
        "name": name,
        "strain": percent(strains[0]),
        "reference": reference,
        "side": tables.length(side) if side else None,
        "ratio": None if ratio is None else three(ratio),
        "lines": lines,
        "figure": gallery.add(
            figure,
            f"{name}-answer",
            f"{name}: mean error per vertex, in cell sides, against strain, of the coarse mesh"
            f" alone (orange), by the paper's method (blue)"
            + "".join(f", by {m} ({style.colour_name(m, methods)})" for m in methods[2:])
            + f", against {reference}. Grey: not resolved by the reference. All laws and variants"
            " stand below.",
            plotted=False,
        ),
    }


def sheets_first(loads):
    """Loads in their order, but what a cloth with edges does before the endless one."""
    return sorted(style.ordered_loads(loads), key=lambda load: style.is_infinite(load))


def line_of(load, affine, best, parts):
    """One load: the change of the error in percent, and its sentence.

    @param best row of the method that the page speaks of
    """
    title = schema.loads().get(load, {}).get("label", load)
    before, after = (row["error_mean_per_cell"] for row in (affine, best))
    bar = best["reference_uncertainty_m"]
    if before < style.ROUND_OFF and after < style.ROUND_OFF:
        change, mark = "0", "none"
        words = "nothing is to be added: the coarse mesh alone is exact to round-off."
    elif after < style.ROUND_OFF:
        change, mark = "−100 %", "better"
        words = "up-sampling takes away all of the error, to round-off."
    else:
        gain = 1.0 - after / before if before > 0.0 else -math.inf
        change, mark = change_of(gain), "better" if gain > 0.0 else "worse"
        left = best["error_mean_m"]
        words = sentence_of(gain, after, left, why(parts, best.get("method", PAPER), left, best.get("reference")))
        if abs(affine["error_mean_m"] - best["error_mean_m"]) <= bar:
            mark = "open"
            words = (
                "up-sampling makes no difference that the error bar of the reference"
                f" ({tables.length(bar)}) could tell."
            )
    return {
        "load": load,
        "title": title,
        "change": change,
        "mark": mark,
        "sentence": capital(words),
    }


def change_of(gain):
    """−74 % of a gain of 0.74, +58 % of a gain of −0.58."""
    if math.isinf(gain):
        return "new"
    sign = "−" if gain > 0.0 else "+"
    return f"{sign}{share(abs(gain))} %"


def share(value):
    """A share in percent: whole numbers, and one digit where that would say 0 or 100."""
    whole = f"{100.0 * value:.0f}"
    if whole in ("0", "100"):
        return f"{100.0 * value:.2g}" if value < 0.5 else f"{100.0 * value:.4g}"
    return whole


def beside_the_paper(best, paper):
    """How far another method than the paper's takes its error."""
    if paper is None or best["method"] == PAPER:
        return ""
    error, of_paper = best["error_mean_per_cell"], paper["error_mean_per_cell"]
    if not of_paper > style.ROUND_OFF:
        return ""
    if abs(paper["error_mean_m"] - best["error_mean_m"]) <= best["reference_uncertainty_m"]:
        return f" The paper's method, {PAPER}, differs from {best['method']} by less than the bar."
    more = of_paper / error if error > 0.0 else math.inf
    return (
        f" The paper's method, {PAPER}, leaves {three(float(more))} times as much as"
        f" {best['method']}."
        if more >= 1.0
        else f" The paper's method, {PAPER}, leaves less: {three(float(more))} times as much as"
        f" {best['method']}."
    )


def beside_the_bar(best):
    """How well the error that is left is known: both sides share a mesh, the truth has none.

    Against the limit of fine meshes the mean error is at most the sum of both (triangle inequality).
    """
    left, bar = best["error_mean_m"], best["reference_uncertainty_m"]
    if not bar > 0.0 or best["error_mean_per_cell"] < style.ROUND_OFF:
        return ""
    if left > bar:
        return f" The reference's own error bar is {tables.length(bar)}."
    return (
        f" The reference's own error bar, {tables.length(bar)}, is not smaller than that: both sides"
        " share its mesh, and of the limit of fine meshes is known only that the error is at most"
        f" {tables.length(left + bar)}."
    )


def sentence_of(gain, left_per_cell, left, reason):
    if math.isinf(gain):
        return f"up-sampling adds {tables.length(left)} of error to none {reason}."
    size = f"{tables.length(left)}, {three(100.0 * left_per_cell)} % of a cell side"
    if gain > 0.0:
        size = size.replace(", ", " (") + ")"
    if gain > 0.0:
        return f"up-sampling takes away {share(gain)} % of the error; {size} are left {reason}."
    return f"up-sampling makes the error {share(-gain)} % worse ({size}) {reason}."


def taken_away(method, reference):
    """The parts of the budget that a method takes away against a law."""
    cubic = reference in schema.laws("has_second_order")
    return {
        part
        for term in schema.terms(method)
        if cubic or term != "cubic"
        for part in TAKEN_AWAY.get(term, ())
    }


def why(parts, method=PAPER, left_m=0.0, reference=None):
    """What the error that is left comes from, in words; from the budget where there is one.

    The budget is that of the paper's method, whose shares are of its error; another method leaves
    what it does not take away, of which the largest part is named without a share, where it is not
    small beside the error.

    @param parts part -> row of budget.csv over the whole sheet, or None
    @param left_m the error that is left, 0 where it is not known [m]
    """
    if not parts:
        return "for a reason that was not measured: the error budget did not run at this level"
    if method != PAPER:
        gone = taken_away(method, reference)
        left = [part for part in CAUSES if part in parts and part not in gone]
        left = [part for part in left if parts[part]["mean_m"] > SECOND_CAUSE * left_m]
        if not left:
            return "for a reason that no part of the error budget has, as a higher order in strain"
        return f"above all because {CAUSES[max(left, key=lambda part: parts[part]['mean_m'])]}"
    known = [(parts[part]["share"], part) for part in CAUSES if part in parts]
    known = sorted((pair for pair in known if pair[0] > 0.0), reverse=True)
    if not known:
        return "because parts of the error compensate each other"
    named = known[:1] + [pair for pair in known[1:2] if pair[0] >= SECOND_CAUSE]
    return " and ".join(
        f"{'because ' if i == 0 else ''}{CAUSES[part]} ({share(value)} % of it)"
        for i, (value, part) in enumerate(named)
    )


def capital(text):
    return text[:1].upper() + text[1:]


def valid_up_to(results, name, load, reference, method):
    """The strain up to which the mean error stays within 1 % of the cell side, as text."""
    return next(
        (
            validity_text(row)
            for row in results.validity
            if (row["cell"], row["load"], row["reference"], row["method"])
            == (name, load, reference, method)
            and float(row["limit"]) == VALIDITY_LIMIT
            and row["measure"].startswith("cell")
        ),
        "–",
    )
