# SPDX-License-Identifier: MIT
"""What the page shows of `homespun stress`: its cases in order, what failed first, and the pictures
of margins and solver.
"""
import math
from collections import Counter

from figures.stress import margin_figure, margin_table, solver_figure
from figures.style import seconds, three
from read.verdicts import MARKS, ORDER, WORDS, words_of


def case_of(row):
    """One case as the template shows it."""
    repeats = row["repeats"]
    return {
        "group": row["group"],
        "case": row["case"],
        "expected": row["expected"],
        "outcome": row["outcome"],
        "figure": three(row["figure"]),
        "limit": row["limit"] or "–",
        "derivation": row["derivation"],
        "verdict": row["verdict"],
        "mark": MARKS[row["verdict"]],
        "word": WORDS[row["verdict"]],
        "repeats": "–" if repeats != repeats else three(int(repeats)),
        "seconds": seconds(row["seconds"]),
    }


def solver_rows(rows):
    """The table of the solver as the template shows it."""
    return [
        [
            row["parameter"],
            three(row["value"]),
            row["cell"],
            f"P{row['order']:g}",
            *(
                three(int(row[key])) if row[key] == row[key] else "–"
                for key in ("dofs", "iterations")
            ),
            seconds(row["seconds"]),
            seconds(row["seconds_total"]),
            row["outcome"],
        ]
        for row in rows
    ]


def draw(stress, gallery):
    """The pictures of the page: margins, iterations, times; those without data are left out."""
    name = "" if stress.name == "stress" else stress.name + ": "
    wanted = [
        (
            margin_figure(stress.rows),
            "stress-margins",
            (
                f"{name}how far each case is from its limit: its figure over its limit, a line for"
                " each group, cases from top to bottom in their order. Right of 1 a case fails. At"
                " the right: cases that hold of all, and those without a number."
            ),
            margin_table(stress.rows),
        )
    ]
    if stress.solver:
        wanted += [
            (
                solver_figure(stress.solver, "iterations"),
                "stress-solver-iterations",
                (
                    f"{name}iterations of the conjugate gradients of the cell problem, the most of"
                    " its three loads, against what makes it hard."
                ),
                None,
            ),
            (
                solver_figure(stress.solver, "seconds"),
                "stress-solver-seconds",
                f"{name}time of preconditioner and solve of the same.",
                None,
            ),
        ]
    return [
        gallery.add(figure, file, caption, table=table)
        for figure, file, caption, table in wanted
        if figure
    ]


def stress_contents(stress, gallery):
    """Pictures, counts, the cases that did not hold, and all cases by group; in each group what
    failed comes first.
    """
    rows = stress.rows
    groups = []
    for name in dict.fromkeys(row["group"] for row in rows):
        some = sorted(
            (row for row in rows if row["group"] == name), key=lambda row: ORDER[row["verdict"]]
        )
        count = Counter(row["verdict"] for row in some)
        groups.append(
            {
                "name": name,
                "cases": [case_of(row) for row in some],
                "counts": (
                    [name]
                    + [
                        three(int(v))
                        for v in (len(some), count["PASS"], count["FAIL"], count["INCONCLUSIVE"])
                    ]
                    + [
                        seconds(
                            sum(row["seconds"] for row in some if row["seconds"] > 0) or math.nan
                        )
                    ]
                ),
                "worst": min(ORDER[row["verdict"]] for row in some),
            }
        )
    groups.sort(key=lambda group: group["worst"])  # stable: the order of the file among equals
    not_held = sorted(
        (row for row in rows if row["verdict"] != "PASS"), key=lambda row: ORDER[row["verdict"]]
    )
    return {
        "name": stress.name,
        "sentence": words_of(Counter(row["verdict"] for row in rows), "case") + ".",
        "pictures": draw(stress, gallery),
        "solver": solver_rows(stress.solver),
        "groups": groups,
        "cases": [case for group in groups for case in group["cases"]],
        "failures": [case_of(row) for row in not_held],
    }
