# SPDX-License-Identifier: MIT
"""The first sentence of a page: in which sheets up-sampling is worth it, in which it is not, and
what a finer coarse mesh would change; and the one line of the infinite cloth. All of it is made of
the numbers of the run.
"""
import math

from figures import style
from figures.style import percent, three
from page.words import change_of, listed, share
from read.schema import is_of_homespun, main_method

PAPER = "localized"
MARKS = ("better", "worse", "open", "none")
NO_GAIN = 0.05  # share of the error by which a finer coarse mesh must change it to be worth a word


def headline(lines, strain, method):
    """The sentence over all sheets; of the infinite cloth where there are no sheets.

    @param lines of answer.line_of(), at one strain
    @param strain as text
    @param method the one that is up-sampled with, or several as text
    """
    sheets = [line for line in lines if not style.is_infinite(line["load"])] or lines
    of = {mark: [line for line in sheets if line["mark"] == mark] for mark in MARKS}
    unknown = [line for line in of["open"] if line["change"] == "–"]
    undecided = [line for line in of["open"] if line["change"] != "–"]
    parts = []
    if of["better"]:
        parts.append(f"pays in {named(of['better'])}")
    if of["worse"]:
        parts.append(f"does not pay in {named(of['worse'])}")
    if undecided:
        parts.append(f"makes no difference that can be told in {listed(loads_of(undecided))}")
    if of["none"]:
        parts.append(f"has nothing to add in {listed(loads_of(of['none']))}")
    if unknown:
        parts.append(f"cannot be judged in {listed(loads_of(unknown))}, where no base was run")
    return f"At {strain} strain up-sampling ({method}) {'; it '.join(parts)}."


def named(lines):
    """strip-1 (−19 %) and strip-2 (−88 % of the error of its coarse cloth)."""
    words = [f"{line['load']} ({line['change']})" for line in lines]
    return listed(words[:-1] + [words[-1][:-1] + " of the error of its coarse cloth)"])


def loads_of(lines):
    return [line["load"] for line in lines]


def infinite_line(lines):
    """All loads of the infinite cloth as one line of the table, or None where there are none."""
    some = [line for line in lines if style.is_infinite(line["load"])]
    if not some:
        return None
    marks = {line["mark"] for line in some}
    known = [line for line in some if line["left_per_cell"] >= style.ROUND_OFF]
    left = (
        f"at most {three(100.0 * max(line['left_per_cell'] for line in known))} % of a cell side is"
        f" left ({max(known, key=lambda line: line['left_per_cell'])['load']})"
        if known
        else "nothing is left, to round-off"
    )
    others = [line for line in some if line["mark"] not in ("better", "none")]
    words = f"Without edges {left}."
    if others:
        words += f" Up-sampling does not pay in {listed(loads_of(others))}."
    gains = [line["gain"] for line in some if not math.isnan(line["gain"])]
    return {
        "load": ", ".join(loads_of(some)),
        "title": "Infinite cloth",
        "change": span_of(gains),
        "mark": marks.pop() if len(marks) == 1 else "none" if not others else "open",
        "coarse": "",
        "total": "",
        "paper": "",
        "sentence": words,
        "short": words,
        "beside": "",
        "valid": " / ".join(dict.fromkeys(line["valid"] for line in some)),
    }


def span_of(gains):
    """−100 %, or −97 to −100 %, of gains."""
    ends = list(dict.fromkeys(change_of(end(gains)) for end in (min, max))) if gains else ["–"]
    return f"{ends[0].removesuffix(' %')} to {ends[1]}" if len(ends) > 1 else ends[0]


def finer_mesh_sentence(rows, ways, reference):
    """What coarse quads of half a cell side, or the next smaller ones there are, would leave of the
    error of the paper's method; empty where the run has no such way.

    @param rows of strain.csv of one cell with an error
    @param ways rows of runtime.csv of it
    """
    found = []
    for row in rows:
        if row["method"] != PAPER or row["reference"] != reference or style.is_infinite(row["load"]):
            continue
        quads = math.isqrt(int(row["coarse_triangles"]) // 2)
        known = {
            int(way["way"].rpartition("-")[2]): way["error_mean_per_cell"]
            for way in ways
            if (way["load"], way["strain"], way["reference"]) == (row["load"], row["strain"], reference)
            and way["way"].startswith(PAPER + "-")
            and way["way"].removeprefix(PAPER + "-").isdigit()
            and not math.isnan(way["error_mean_per_cell"])
        }
        finer = [n for n in known if n >= 2 * quads]
        # Both against the same solution, which is not that of the row.
        if finer and known.get(quads, 0.0) >= style.ROUND_OFF:
            n = min(finer)
            found.append((row, n / row["cells"], known[n] / known[quads]))
    if not found:
        return ""
    row, per_cell, left = found[0]
    where = f"({row['load']}, {percent(row['strain'])})"
    quads = f"{three(per_cell).rstrip('0').rstrip('.')} coarse quads per cell side"
    if abs(1.0 - left) < NO_GAIN:
        return f"{quads} would change the error of the paper's method by less than 5 % {where}."
    change = "take away" if left < 1.0 else "add"
    return f"{quads} would {change} {share(abs(1.0 - left))} % of the error of the paper's method {where}."


def own_methods_sentence(here):
    """How methods that are none of homespun's stand beside those of homespun, in the sheets if there
    are any; empty where none was judged.

    @param here rows of strain.csv of one cell, reference and strain, with an error
    """
    sheets = [row for row in here if not style.is_infinite(row["load"])] or here
    parts = []
    for own in dict.fromkeys(r["method"] for r in sheets if not is_of_homespun(r["method"])):
        ratios, names, closer = [], [], []
        for row in [row for row in sheets if row["method"] == own]:
            error = row["error_mean_m"]
            others = {one["method"]: one["error_mean_m"] for one in sheets
                      if one["load"] == row["load"] and is_of_homespun(one["method"])}
            n = sum(other < error for other in others.values())
            closer.append(f"{n} of {len(others)} ({row['load']})")
            if (best := others.get(main_method(others), 0.0)) > style.ROUND_OFF * error:
                ratios.append(f"{three(error / best)} ({row['load']})")
                names.append(main_method(others))
        said = f"{listed(closer)} methods of homespun are closer than {own}"
        if ratios:
            said += f", whose error is {listed(ratios)} times that of {listed(list(dict.fromkeys(names)))}"
        parts.append(f"{said}.")
    return " ".join(parts)
