# SPDX-License-Identifier: MIT
"""Claims by what they speak of, and under each that fails or is open why, and what to do."""
import re
from collections import Counter

from page import tables
from page.answer import why
from page.headline import PAPER
from read.budget_results import levels
from read.verdicts import KINDS, MARKS, ORDER, WORDS, words_of

# What to do, by words of the claim; the first that is found counts.
ADVICE = (
    (
        "than affine at strain",
        "Under this load take the coarse mesh alone (`affine`), or remove the cause: a finer coarse"
        " mesh, a cell cut at another place (see the notes on the place of the cut), a smaller"
        " strain.",
    ),
    (
        "than affine on the largest sheet",
        "This is of the paper's method alone (`localized`), in linear theory. It says nothing of"
        " up-sampling with all terms (`full`), which the page of `homespun strain` judges.",
    ),
    (
        "than its base at strain",
        "Under this load take the coarse cloth that the limit names, without up-sampling: nothing that"
        " up-sampling adds to it pays here.",
    ),
    (
        "than localized at strain",
        "Under this load take the paper's method (`localized`): the terms that the other one adds"
        " do not pay on this cell.",
    ),
    (
        "find an equilibrium",
        "Read the table only up to the last strain that was reached; `--strains` with smaller steps"
        " may get further. Soft shear beside stiff tension loses its equilibrium early: that is the"
        " cell, not the solver.",
    ),
    (
        "every level has an equilibrium",
        "Read the curve up to the last level that was reached; more `--steps` may get further. A"
        " stress may be more than the cloth bears: prescribe the strain instead.",
    ),
    (
        "every strain has a periodic state",
        "Read the margin up to the last strain that was reached; smaller strains show where the"
        " path ends. The cloth itself may have no state beyond.",
    ),
    (
        "agree on what is stable",
        "Take the levels named as open: a finer mesh of the cell has more waves and a lower margin.",
    ),
    (
        "is a minimum of the energy",
        "From the first such level on (`stable` of load.csv) the cloth takes another way than this"
        " curve.",
    ),
    (
        "is a minimum of the reference's energy",
        "Do not rest a decision on the levels named: the reference may have found one equilibrium"
        " of several. Smaller strains have one.",
    ),
    (
        "what the parts leave of the error",
        "Take the causes from the smaller strain. Where the bar is above a fifth of the error, the"
        " budget cannot say at this strain what the error is made of; the error itself stands.",
    ),
    (
        "error bar of the reference covers",
        "Take the distance as the error bar: solve the reference finer (`--order 2`), or with more"
        " cells in its error bar.",
    ),
    ("what the solvers leave undone", "Run again: a solve ended early; its row in steps.csv says which."),
    (
        "strain squared",
        "Give `--strains` with three or more small levels, such as 1e-4,1e-3,1e-2; if it stays, the"
        " cell or the law is at fault at these strains, or the program is.",
    ),
    ("second code", "Two programs differ on one problem: report it, with the cell."),
    ("second solver", "Two programs differ on one problem: report it, with the cell."),
    ("runs to its end", "Read the message in the claim; other parts are not touched by it."),
    ("bracket", "Narrow it: `homespun homogenize CELL.prm --tolerance 1e-4`."),
    ("faceted", "Give the triangles curved sides: `Mesh.ElementOrder = 2` in Gmsh."),
    ("single element across", "Mesh finer there, or compute with `--order 2`."),
    ("observed order", "Let it refine further: leave out `--quick`."),
)
STATES = "The states that were asked for exist, and are stable (nothing is up-sampled here)"
OF_KIND = {
    "program": "The program, not the cell, is in question here: report it, with the cell and this"
    " page.",
    "input": "Mend cell, mesh or scene: `homespun check CELL.prm --output out/check` shows the"
    " places.",
    "method": "What the claim says of the method does not hold here: do not rest on it in this case.",
}
OPEN = {
    "program": "Not decided, and nothing says that the program is wrong: let it run further, without"
    " `--quick` or with more levels.",
    "input": "Not decided: a finer mesh, or a run without `--quick`, narrows the bar.",
    "method": "Not decided: let it run further, without `--quick`, or with a reference that is"
    " solved finer.",
}
LEVEL = re.compile(r"([\w.-]+), (periodic-\d\d|uniaxial-\d|strip-\d|shear-frame)\b")
METHOD = re.compile(r": ([\w+-]+) is closer to ")
STRAIN = re.compile(r"\bat (?:strain )?(\d[\d.e-]*)( %)?")


def claim_contents(verdict, commands, study, budget):
    """One row; its command only where it is not among those of the page.

    @param study name of its folder, where there are several
    @param budget rows of budget.csv
    """
    value = verdict.get("value")
    row = {
        "claim": f"{study}: {verdict['claim']}" if study else verdict["claim"],
        "kind": verdict["kind"],
        "verdict": verdict["verdict"],
        "mark": MARKS[verdict["verdict"]],
        "word": WORDS[verdict["verdict"]],
        "value": "–" if value is None else tables.shown(value),
        "limit": tables.shown(verdict.get("limit", "")),
        "derivation": verdict["derivation"],
        "command": "" if verdict.get("command") in commands else verdict.get("command", ""),
        "why": "",
        "advice": "",
    }
    if verdict["verdict"] != "PASS":
        row["why"] = cause_of(verdict, budget)
        row["advice"] = advice_of(verdict)
    return row


def cause_of(verdict, budget):
    """Why a claim on the method does not hold, from the budget; of other claims their limit says
    it.
    """
    if verdict["kind"] != "method":
        return ""
    case, strain = LEVEL.search(verdict["claim"]), STRAIN.search(verdict["claim"])
    if not case or not strain:
        return ""
    known = levels([row for row in budget if row["cell"] == case[1]])
    value = float(strain[1]) / (100.0 if strain[2] else 1.0)
    near = [key for key in known if key[0] == case[2] and abs(key[1] / value - 1.0) < 1e-6]
    method = METHOD.search(verdict["claim"])
    left = why(known[near[0]]["all"] if near else None, method[1] if method else PAPER)
    return f"The error is left {left}." if left else ""


def advice_of(verdict):
    """What a reader can do about a claim that does not hold."""
    otherwise = OPEN if verdict["verdict"] == "INCONCLUSIVE" else OF_KIND
    return next(
        (advice for words, advice in ADVICE if words in verdict["claim"]),
        otherwise[verdict["kind"]],
    )


def claim_groups(claims, heading_of=KINDS):
    """[{"kind", "heading", "sentence", "count", "open", "held"}], by kind in their order: what does
    not hold, failures first, and what holds.
    """
    groups = []
    for kind, heading in heading_of.items():
        some = sorted((v for v in claims if v["kind"] == kind), key=lambda v: ORDER[v["verdict"]])
        if some:
            groups.append(
                {
                    "kind": kind,
                    "heading": heading,
                    "sentence": counted(some),
                    "worst": some[0],
                    "open": [v for v in some if v["verdict"] != "PASS"],
                    "held": [v for v in some if v["verdict"] == "PASS"],
                }
            )
    return groups


def headings_of_kinds(up_samples):
    """kind -> heading; a page on which nothing is up-sampled judges no up-sampling."""
    return KINDS if up_samples else {**KINDS, "method": STATES}


def counted(claims):
    """12 of 15 claims hold, 2 fail, 1 is open."""
    return words_of(Counter(v["verdict"] for v in claims), "claim")


def claim_sentence(claims):
    """Counts of all claims, then of each kind."""
    groups = claim_groups(claims)
    return (
        counted(claims) + ": " + "; ".join(f"{g['kind']}: {g['sentence']}" for g in groups) + "."
    )
