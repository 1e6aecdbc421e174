# SPDX-License-Identifier: MIT
"""The answer of the page: what up-sampling does to the error under each load, and why, in
sentences that need no other part of the page.
"""
import math

from figures import style
from figures.run_time import METHOD, speed_ratio
from figures.strain import error_figure
from figures.style import percent, three
from page import tables
from page.budget_contents import validity_text
from read.budget_results import levels
from read.results import cell_side

# A load as a picture in words, and the same where the subject is the cloth.
LOADS = {
    "periodic-11": "Endless cloth, stretched along axis 1",
    "periodic-22": "Endless cloth, stretched along axis 2",
    "periodic-12": "Endless cloth, sheared",
    "uniaxial-1": "Endless cloth, pulled along axis 1 with free sides",
    "uniaxial-2": "Endless cloth, pulled along axis 2 with free sides",
    "strip-1": "Sheet pulled along axis 1",
    "strip-2": "Sheet pulled along axis 2",
    "shear-frame": "Sheet sheared in a frame",
}
# What each part of the budget is, after "because"; only parts of the sum are causes.
CAUSES = {
    "scale": "near the edges the cells do not repeat",
    "nonlinearity": "a cell answers finite strain otherwise than small strain",
    "coarse-mesh": "the coarse mesh is too coarse",
    "blending": "strain is averaged between coarse triangles",
    "solver": "the solvers stopped early",
    "convention": "the anchor holds the corners of the cell still",
}
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
        if METHOD in some and "affine" in some:
            parts = budget.get((load, strains[0]), {}).get("all")
            lines.append(
                {
                    **line_of(load, some["affine"], some[METHOD], parts),
                    "valid": valid_up_to(results, name, load, reference),
                }
            )
    if not lines:
        return None
    side = cell_side(results, name)
    ratio = speed_ratio(results.reached(name), reference)
    methods = ["affine", METHOD]
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
            f" alone (orange) and with up-sampling (blue), against {reference}. Grey: not resolved"
            " by the reference. All laws and variants stand below.",
            plotted=False,
        ),
    }


def sheets_first(loads):
    """Loads in their order, but what a cloth with edges does before the endless one."""
    return sorted(style.ordered_loads(loads), key=lambda load: style.is_infinite(load))


def line_of(load, affine, localized, parts):
    """One load: the change of the error in percent, and its sentence."""
    title = LOADS.get(load, load)
    before, after = (row["error_mean_per_cell"] for row in (affine, localized))
    bar = localized["reference_uncertainty_m"]
    if before < style.ROUND_OFF and after < style.ROUND_OFF:
        change, mark = "0", "none"
        words = "nothing is to be added: the coarse mesh alone is exact to round-off."
    elif after < style.ROUND_OFF:
        change, mark = "−100 %", "better"
        words = "up-sampling takes away all of the error, to round-off."
    else:
        gain = 1.0 - after / before if before > 0.0 else -math.inf
        change, mark = change_of(gain), "better" if gain > 0.0 else "worse"
        words = sentence_of(gain, after, localized["error_mean_m"], parts)
        if abs(affine["error_mean_m"] - localized["error_mean_m"]) <= bar:
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


def sentence_of(gain, left_per_cell, left, parts):
    if math.isinf(gain):
        return f"up-sampling adds {tables.length(left)} of error to none {why(parts)}."
    size = f"{tables.length(left)}, {three(100.0 * left_per_cell)} % of a cell side"
    if gain > 0.0:
        size = size.replace(", ", " (") + ")"
    if gain > 0.0:
        return f"up-sampling takes away {share(gain)} % of the error; {size} are left {why(parts)}."
    return f"up-sampling makes the error {share(-gain)} % worse ({size}) {why(parts)}."


def why(parts):
    """What the error that is left comes from, in words; from the budget where there is one.

    @param parts part -> row of budget.csv over the whole sheet, or None
    """
    if not parts:
        return "for a reason that was not measured: the error budget did not run at this level"
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


def valid_up_to(results, name, load, reference):
    """The strain up to which the mean error stays within 1 % of the cell side, as text."""
    return next(
        (
            validity_text(row)
            for row in results.validity
            if (row["cell"], row["load"], row["reference"]) == (name, load, reference)
            and float(row["limit"]) == VALIDITY_LIMIT
            and row["measure"].startswith("cell")
        ),
        "–",
    )
