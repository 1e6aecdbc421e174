# SPDX-License-Identifier: MIT
"""Claims by what they speak of, and under each that fails or is open why, and what to do."""
import re
from collections import Counter

from page import tables
from page.answer import why
from page.headline import PAPER
from read import schema
from read.budget_results import levels
from read.verdicts import KINDS, MARKS, ORDER, WORDS, words_of

STATES = "The states that were asked for exist, and are stable (nothing is up-sampled here)"
# What to do where claims.json has no advice of the claim.
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
METHOD = re.compile(r": ([\w+-]+) is closer to ([\w-]+) than ")
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
    value = float(strain[1]) / (100.0 if strain[2] else 1.0)
    method = METHOD.search(verdict["claim"])
    known = levels([row for row in budget if row["cell"] == case[1]
                    and (method is None or row["reference"] == method[2])])
    near = [key for key in known if key[0] == case[2] and abs(key[1] / value - 1.0) < 1e-6]
    left = why(
        known[near[0]]["all"] if near else None,
        method[1] if method else PAPER,
        reference=method[2] if method else None,
    )
    return f"The error is left {left}." if left else ""


def advice_of(verdict):
    """What a reader can do about a claim that does not hold. What condemns is said of failures."""
    known = schema.claims().get(verdict.get("id"), {})
    advice = known.get("advice")
    if verdict["verdict"] == "INCONCLUSIVE":
        return advice or OPEN[verdict["kind"]]
    return advice or known.get("advice_if_failed") or OF_KIND[verdict["kind"]]


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
