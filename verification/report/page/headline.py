# SPDX-License-Identifier: MIT
"""The first sentence of a page: in which sheets up-sampling is worth it, in which it is not, where
that is open, and what a finer coarse mesh would change; and the one line of the infinite cloth. All
of it is made of the numbers of the run.
"""
import math

from figures import style
from figures.style import percent, three
from page.bars import law_lost
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
    parts = []
    if of["better"]:
        parts.append(f"pays in {named(of['better'])}")
    if of["worse"]:
        parts.append(f"does not pay in {named(of['worse'])}")
    if of["none"]:
        parts.append(f"has nothing to add in {listed(loads_of(of['none']))}")
    parts += open_parts(of["open"])
    return f"At {strain} strain up-sampling ({method}) {'; it '.join(parts)}."


def open_parts(lines):
    """What is said of the loads in which up-sampling is not known to gain or to lose: differences
    within the bars, what nothing decides and why, and what has no base, apart.
    """
    without_base = [line for line in lines if line["change"] == "–"]
    reasons = {}
    for line in lines:
        if line["why_open"]:
            reasons.setdefault(line["why_open"], []).append(line)
    within = [line for line in lines if line not in without_base and not line["why_open"]]
    parts = []
    if within:
        parts.append(f"makes no difference that can be told in {listed(loads_of(within))}")
    if reasons:
        where = [f"{listed(loads_of(some))} ({why})" for why, some in reasons.items()]
        parts.append(f"is open in {listed(where)}")
    if without_base:
        parts.append(f"cannot be judged in {listed(loads_of(without_base))}, where no base was run")
    return parts


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
    worse, is_open = ([line for line in some if line["mark"] == mark] for mark in ("worse", "open"))
    words = f"Without edges {most_left(some)}."
    parts = [f"does not pay in {listed(loads_of(worse))}"] if worse else []
    if parts := parts + open_parts(is_open):
        words += f" Up-sampling {'; it '.join(parts)}."
    gains = [line["gain"] for line in some if line not in is_open and not math.isnan(line["gain"])]
    changes = list(dict.fromkeys(line["change"] for line in some))
    ranges = [line["valid"] for line in some]
    return {
        "load": ", ".join(loads_of(some)),
        "title": "Infinite cloth",
        "change": span_of(gains) if gains else " / ".join(changes),
        "mark": marks.pop() if len(marks) == 1 else "open" if worse or is_open else "none",
        "coarse": "",
        "total": "",
        "paper": "",
        "sentence": words,
        "short": words,
        "beside": "",
        "valid": " / ".join(ranges if len(set(ranges)) > 1 else ranges[:1]),
    }


def most_left(lines):
    """How large the error that is left may be, its bar included, and under which load, of those
    whose law is not lost.
    """
    held = [line for line in lines if not line["lost"]]
    if not held:
        return "what is left is open, because the law is lost"
    known = [line for line in held if line["left_per_cell"] >= style.ROUND_OFF]
    if not known:
        return "nothing is left, to round-off"
    most = {
        line["load"]: line["left_per_cell"] + max(line["bar_per_cell"], 0.0) for line in known
        if not math.isnan(line["bar_per_cell"])
    }
    barless = [line for line in known if line["load"] not in most]
    parts = [f"{three(100.0 * line['left_per_cell'])} % of a cell side, of an error bar that is not"
             f" known, is left in {line['load']}" for line in barless]
    if most:
        load = max(most, key=most.get)
        parts.insert(0, f"at most {three(100.0 * most[load])} % of a cell side is left ({load}),"
                        " error bar included")
    return ", and ".join(parts)


def span_of(gains):
    """−100 %, or −97 to −100 %, of gains."""
    ends = list(dict.fromkeys(change_of(end(gains)) for end in (min, max)))
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
        if law_lost(row):
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
    here = [row for row in here if not law_lost(row)]
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
