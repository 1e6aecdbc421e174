# SPDX-License-Identifier: MIT
"""The answer of the page: what up-sampling does to the error of its own coarse cloth under each
load, what that cloth does to the error of the coarse mesh alone, and why error is left, in
sentences that need no other part of the page.
"""
import math

from figures import style
from figures.run_time import speed_ratio
from figures.strain import error_figure
from figures.style import percent, three
from page import tables
from page.answer_pictures import as_homespun, sheet_of_answer
from page.bars import bar_of, law_lost, undecided
from page.budget_contents import validity_text
from page.headline import (
    PAPER,
    finer_mesh_sentence,
    headline,
    infinite_line,
    own_methods_sentence,
)
from page.words import capital, change_of, judged_sentence, listed, share
from read import schema
from read.budget_results import base_rows, levels
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
LIKELY = "most likely because"  # an inference: the budget splits the error of `localized`
UNTOLD = "≈ 0"  # a change that the error bars cannot tell
UNKNOWN = "open"  # a change that no claim bears: beyond the law, or without bars that decide
SECOND_CAUSE = 0.25  # share of the error from which a second cause is named
VALIDITY_LIMIT = 0.01  # of a cell side
PANEL = (1.4, 1.5)  # inches of a panel of the small Figure 3


def answer_of(results, name, gallery):
    """What stands on the first screen of one cell, or None where no error is known.

    @return {"name", "strain", "reference", "lines", "figure", "ratio", "side", "quick"}; a line is
            {"load", "title", "change", "mark", "coarse", "total", "sentence", "valid"}; "law" is
            law_sentence() at the largest chosen strain
    """
    lost = {
        (row["load"], row["reference"]): row["elliptic_up_to"]
        for row in results.validity
        if row["cell"] == name
    }
    rows = [
        {**row, "law_lost_at": lost.get((row["load"], row["reference"]), math.nan)}
        for row in results.reached(name)
    ]
    reference = tables.main_reference(rows)
    of_laws = rows
    rows = [row for row in rows if row["reference"] == reference]
    strains = tables.nearest_strains(rows)
    if not strains:
        return None
    here = [row for row in rows if row["strain"] == strains[0]]
    budget = levels([b for b in results.budget if (b["cell"], b["reference"]) == (name, reference)])
    gains = [g for g in results.gains if (g["cell"], g["reference"]) == (name, reference)]
    bases = {
        (gain["load"], gain["method"]): gain["base"]
        for gain in gains
        if gain["strain"] == strains[0]
    }
    lines = []
    for load in sheets_first(row["load"] for row in here):
        some = {row["method"]: row for row in here if row["load"] == load}
        method = main_method(some)
        if method in some and "affine" in some:
            parts = budget.get((load, strains[0]), {}).get("all")
            base = some.get(bases.get((load, method)))
            line = line_of(load, some["affine"], base, some[method], parts)
            if method != PAPER and PAPER in some:
                line["paper"] = change_between(some["affine"], some[PAPER])
                line["beside"] += of_the_paper(line["paper"])
            if line["mark"] != "open":  # where the bar is named already
                line["sentence"] += beside_the_bar(some[method])
            lines.append({**line, "valid": valid_up_to(results, name, load, reference, method)})
    if not lines:
        return None
    side = cell_side(results, name)
    ratio = speed_ratio(rows, reference)
    chosen = {load: main_method({r["method"] for r in here if r["load"] == load})
              for load in {r["load"] for r in here}}
    spoken_of = style.ordered_methods(chosen.values())
    own = style.ordered_methods(r["method"] for r in rows if not schema.is_of_homespun(r["method"]))
    figure, _ = error_figure(
        *as_homespun(rows, base_rows(rows, gains), chosen), [reference], side, panel=PANEL
    )
    ways = [way for way in results.run_time if way["cell"] == name]
    finer = finer_mesh_sentence(rows, ways, reference)
    return {
        "name": name,
        "strain": percent(strains[0]),
        "reference": reference,
        "side": tables.length(side) if side else None,
        "ratio": None if ratio is None else three(ratio),
        "headline": " ".join(
            part for part in (headline(lines, percent(strains[0]), listed(spoken_of)), finer,
                              own_methods_sentence(here)) if part
        ),
        "lines": lines,
        "shown": [line for line in lines if not style.is_infinite(line["load"])],
        "infinite": infinite_line(lines),
        "no_cause": " ".join(
            part for part in (no_cause_sentence(lines, percent(strains[0])),
                              likely_sentence(lines, listed(spoken_of))) if part
        ),
        "law": law_sentence(of_laws, [f for f in results.forces if f["cell"] == name], reference,
                            strains[-1]),
        "sheet": sheet_of_answer(results.cells.get(name), lines, gallery),
        "figure": gallery.add(
            figure,
            f"{name}-answer",
            f"{name}: mean error per vertex, in cell sides, against strain, compared with the"
            f" reference {reference}: the coarse mesh alone (affine), the paper's method"
            f" ({PAPER})"
            + (f", homespun ({listed(spoken_of)}) and its coarse cloth, not up-sampled"
               if spoken_of != [PAPER] else "")
            + "." + judged_sentence(own)
            + " Grey: up to the error bar of the smallest error. All laws and variants: below.",
            plotted=False,
        ),
    }


def no_cause_sentence(lines, strain):
    """Once for all loads whose error budget did not run."""
    some = [line["load"] for line in lines if line["has_cause"] is False]
    return (
        f"Why error is left was not measured in {listed(some)}: the error budget did not run there at"
        f" {strain}."
        if some
        else ""
    )


def likely_sentence(lines, method):
    """What a likely cause is; empty where none is named."""
    return (
        "Most likely: the largest part of the error of the paper's method that the terms of"
        f" {method} do not remove; the error of {method} itself was not split."
        if any(LIKELY in line["sentence"] for line in lines)
        else ""
    )


def sheets_first(loads):
    """Loads in their order, but what a cloth with edges does before the endless one."""
    return sorted(style.ordered_loads(loads), key=lambda load: style.is_infinite(load))


def line_of(load, affine, base, best, parts):
    """One load: the change of the error by up-sampling in percent, that by its coarse cloth, both
    together, and its sentence.

    @param base row of the coarse cloth of the method, not up-sampled, or None
    @param best row of the method that the page speaks of
    """
    title = schema.loads().get(load, {}).get("label", load)
    after, left = best["error_mean_per_cell"], best["error_mean_m"]
    method = best.get("method", PAPER)
    reason = why(parts, method, left, best.get("reference"))
    size = f"{tables.length(left)} ({three(100.0 * after)} % of a cell side) are left"
    size += f" {reason}" if reason else ""
    short = f"{tables.length_with_bar(left, bar_of(best))}, {three(100.0 * after)} % of a cell side"
    short += f", {reason}" if reason else ""
    line = {
        "load": load, "title": title, "change": "–", "mark": "open", "coarse": "", "total": "",
        "paper": "", "short": f"{short}.", "beside": "", "gain": math.nan, "left_per_cell": after, "has_cause": None,
        "lost": law_lost(best),
        "bar_per_cell": bar_of(best) * (after / left if left > 0.0 else 0.0), "why_open": "",
    }
    if after >= style.ROUND_OFF:
        line["has_cause"] = bool(reason)
    if base is None:
        words = (
            f"what up-sampling takes away is not known, because no base was among the methods"
            f" ({method}-micro, affine+p2); {size}."
        )
    else:
        line["change"], line["mark"], words = of_upsampling(base, best, size)
        if line["change"] == UNKNOWN:
            line["why_open"] = undecided(base, best)
        before = base["error_mean_per_cell"]
        if after < style.ROUND_OFF:
            line["short"] = words
        if before >= style.ROUND_OFF:
            line["gain"] = 1.0 if after < style.ROUND_OFF else 1.0 - after / before
        if base["method"] != "affine":
            line["coarse"] = change_between(affine, base)
            line["total"] = change_between(affine, best)
            line["beside"] = (
                f" That coarse cloth itself changes the error of the coarse mesh alone by"
                f" {in_words(line['coarse'])}, both together by {in_words(line['total'])}."
            )
    return {**line, "sentence": capital(words), "short": capital(line["short"])}


def of_upsampling(base, best, size):
    """(change, mark, words) from the coarse cloth of a method to the method."""
    before, after = base["error_mean_per_cell"], best["error_mean_per_cell"]
    of_what = (
        "the error of the coarse mesh alone"
        if base["method"] == "affine"
        else f"what its coarse cloth, {base['method']}, leaves"
    )
    lost = law_lost(best)
    if not lost and before < style.ROUND_OFF and after < style.ROUND_OFF:
        return "0", "none", "nothing is to be added: the coarse cloth is exact to round-off."
    if not lost and after < style.ROUND_OFF:
        return "−100 %", "better", f"up-sampling takes away all of {of_what}, to round-off."
    if reason := undecided(base, best):
        return UNKNOWN, "open", f"what up-sampling does to {of_what} is open, because {reason}; {size}."
    bars = bar_of(base) + bar_of(best)
    if abs(base["error_mean_m"] - best["error_mean_m"]) <= bars:
        return UNTOLD, "open", (
            f"up-sampling makes no difference to {of_what} that the error bars of both"
            f" ({tables.length(bars)} together) could tell; {size}."
        )
    gain = 1.0 - after / before if before >= style.ROUND_OFF else -math.inf
    if math.isinf(gain):
        return change_of(gain), "worse", f"up-sampling adds error to none: {size}."
    if gain > 0.0:
        return change_of(gain), "better", (
            f"up-sampling takes away {share(gain)} % of {of_what}; {size}."
        )
    return change_of(gain), "worse", (
        f"up-sampling adds {share(-gain)} % to {of_what}; {size}."
    )


def change_between(one, other):
    """How the error changes from one row to another: −74 %, +58 %, or what the bars cannot tell."""
    before, after = one["error_mean_per_cell"], other["error_mean_per_cell"]
    if not law_lost(other) and max(before, after) < style.ROUND_OFF:
        return UNTOLD
    if undecided(one, other):
        return UNKNOWN
    if abs(other["error_mean_m"] - one["error_mean_m"]) <= bar_of(one) + bar_of(other):
        return UNTOLD
    return change_of(1.0 - after / before if before >= style.ROUND_OFF else -math.inf)


def in_words(change):
    return {UNTOLD: "less than the bar", UNKNOWN: "an amount that is open"}.get(change, change)


def of_the_paper(change):
    """What the paper's method does to the coarse mesh alone, which is its coarse cloth."""
    return f" The paper's method, {PAPER}, changes the error of the coarse mesh alone by {in_words(change)}."


def beside_the_bar(best):
    """How well the error that is left is known: what it may change by in the limit of fine meshes,
    method and reference together.
    """
    left, bar = best["error_mean_m"], bar_of(best)
    if not bar > 0.0 or best["error_mean_per_cell"] < style.ROUND_OFF:
        return ""
    if left > bar:
        return f" The error bar of that error is {tables.length(bar)}."
    return (
        f" Its error bar, {tables.length(bar)}, is not smaller than that: of the limit of fine meshes"
        f" is known only that the error is at most {tables.length(left + bar)}."
    )


def law_sentence(rows, forces, reference, strain):
    """What another law of the reference changes on sheets at a strain: the force of the resolved
    sheet, and the error that the method of the page leaves against it, where neither law is lost;
    empty where there is none.

    @param rows of one cell with an error, forces rows of forces.csv of it
    """
    here = [r for r in rows if r["strain"] == strain and not style.is_infinite(r["load"])]
    lost = {(r["reference"], r["load"]) for r in here if law_lost(r)}
    error, force = {}, {}
    for load in {row["load"] for row in here}:
        method = main_method(
            [r["method"] for r in here if (r["load"], r["reference"]) == (load, reference)]
        )
        for row in here:
            if (row["load"], row["method"]) == (load, method):
                error[row["reference"], load] = row["error_mean_per_cell"]
    for row in forces:
        if row["method"] == "resolved" and row["strain"] == strain:
            force[row["reference"], row["load"]] = row["force_per_width_N_per_m"]
    parts = []
    for law in schema.laws():
        if law in (reference, "linear"):
            continue
        loads = style.ordered_loads(load for one, load in error if one == law)
        is_open = [load for load in loads if {(law, load), (reference, load)} & lost]
        ratios = [
            [of[law, load] / of[reference, load] for load in loads if load not in is_open
             and of.get((reference, load), 0.0) > style.ROUND_OFF and (law, load) in of]
            for of in (force, error)
        ]
        if all(ratios):
            parts.append(
                f"with {law} instead of {reference} sheets take {span(ratios[0])} times the force, and"
                f" the error that is left is {span(ratios[1])} times as large"
                + (f" (open in {listed(is_open)}, where a law is lost)" if is_open else "")
            )
    return f"What another law would change, at {percent(strain)}: {'; '.join(parts)}." if parts else ""


def span(values):
    """The smallest and largest of some numbers, or one where they print alike."""
    ends = [three(float(end(values))) for end in (min, max)]
    return " to ".join(dict.fromkeys(ends))


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
    """What the error that is left comes from, in words; empty where no budget was made.

    The budget is that of the paper's method, whose shares are of its error; another method leaves
    what it does not take away, of which the largest part is named without a share, where it is not
    small beside the error.

    @param parts part -> row of budget.csv over the whole sheet, or None
    @param left_m the error that is left, 0 where it is not known [m]
    """
    if not parts:
        return ""
    if method != PAPER:
        gone = taken_away(method, reference)
        left = [part for part in CAUSES if part in parts and part not in gone]
        left = [part for part in left if parts[part]["mean_m"] > SECOND_CAUSE * left_m]
        if not left:
            return "for a reason that no part of the error budget has, as a higher order in strain"
        return f"{LIKELY} {CAUSES[max(left, key=lambda part: parts[part]['mean_m'])]}"
    known = [(parts[part]["share"], part) for part in CAUSES if part in parts]
    known = sorted((pair for pair in known if pair[0] > 0.0), reverse=True)
    if not known:
        return "because parts of the error compensate each other"
    named = known[:1] + [pair for pair in known[1:2] if pair[0] >= SECOND_CAUSE]
    return " and ".join(
        f"{'because ' if i == 0 else ''}{CAUSES[part]} ({share(value)} % of it)"
        for i, (value, part) in enumerate(named)
    )


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
