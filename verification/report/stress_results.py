# SPDX-License-Identifier: MIT
"""Reads stress.csv and solver.csv of `homespun stress`, and orders the cases: what failed comes first."""
import math
import os
from collections import Counter
from dataclasses import dataclass, field

from figures_stress import margin_figure, margin_table, solver_figure
from stored import VERDICTS, latest, read_csv
from style import seconds, three

AGAIN = "Run `homespun stress` again."
HEADER = "group,case,expected,outcome,figure,limit,verdict,repeats,seconds,derivation".split(",")
SOLVER_HEADER = "parameter,value,cell,order,dofs,iterations,seconds,seconds_total,repeats,outcome".split(",")
MARKS = {"PASS": "✓", "FAIL": "✗", "INCONCLUSIVE": "?"}
ORDER = {"FAIL": 0, "INCONCLUSIVE": 1, "PASS": 2}


@dataclass
class Stress:
    """The cases of one folder, rows of stress.csv, and of solver.csv where it is there."""
    folder: str
    name: str
    rows: list = field(default_factory=list)
    solver: list = field(default_factory=list)


def read_stress(folder, name, path, faults, missing):
    """@return Stress, whose rows are in the order of the file"""
    rows = latest(read_csv(path, HEADER, faults, missing, AGAIN), ("group", "case"), path, missing)
    for row in rows:
        if row["verdict"] not in VERDICTS:
            faults.append(f"{path}, line {row['line']}: `verdict` is `{row['verdict']}`, expected one of "
                          f"{', '.join(VERDICTS)}. {AGAIN}")
    if not rows:
        missing.append({"what": f"stress cases of {name}", "why": f"{path} has no complete row"})
    solver, solver_path = [], os.path.join(folder, "solver.csv")
    if os.path.isfile(solver_path):
        solver = latest(read_csv(solver_path, SOLVER_HEADER, faults, missing, AGAIN),
                        ("parameter", "value", "cell", "order"), solver_path, missing)
    else:
        missing.append({"what": f"iterations of the solver of {name}", "why": f"{solver_path} does not exist"})
    return Stress(folder, name, rows, solver)


def number_or_text(value):
    """A figure with three digits where it is one number; it may be words."""
    try:
        return three(float(value))
    except ValueError:
        return value


def case_of(row):
    """One case as the template shows it."""
    repeats = row["repeats"]
    return {"group": row["group"], "case": row["case"], "expected": row["expected"], "outcome": row["outcome"],
            "figure": number_or_text(row["figure"]) if row["figure"] else "–",
            "limit": row["limit"] or "–", "verdict": row["verdict"],
            "mark": MARKS[row["verdict"]], "repeats": "–" if repeats != repeats else three(int(repeats)),
            "seconds": seconds(row["seconds"])}


def words_of(count):
    """12 of 13 cases hold, 1 fails."""
    total = sum(count.values())
    words = [f"{count['PASS']} of {total} cases hold"]
    if count["FAIL"]:
        words.append(f"{count['FAIL']} fail{'s' if count['FAIL'] == 1 else ''}")
    if count["INCONCLUSIVE"]:
        words.append(f"{count['INCONCLUSIVE']} cannot be judged")
    return ", ".join(words)


def solver_rows(rows):
    """The table of the solver as the template shows it."""
    return [[row["parameter"], three(row["value"]), row["cell"], f"P{row['order']:g}",
             *(three(int(row[key])) if row[key] == row[key] else "–" for key in ("dofs", "iterations")),
             seconds(row["seconds"]), seconds(row["seconds_total"]), row["outcome"]] for row in rows]


def draw(stress, gallery):
    """The pictures of the page: margins, iterations, times; those without data are left out."""
    name = "" if stress.name == "stress" else stress.name + ": "
    wanted = [
        (margin_figure(stress.rows), "stress-margins", f"{name}how far each case is from its limit: its figure over its "
         "limit, a line for each group, cases from top to bottom in their order. Right of 1 a case fails. At the right: "
         "cases that hold of all, and refusals, which have no figure.", margin_table(stress.rows))]
    if stress.solver:
        wanted += [
            (solver_figure(stress.solver, "iterations"), "stress-solver-iterations", f"{name}iterations of the conjugate "
             "gradients of the cell problem, the most of its three loads, against what makes it hard.", None),
            (solver_figure(stress.solver, "seconds"), "stress-solver-seconds",
             f"{name}time of preconditioner and solve of the same.", None)]
    return [gallery.add(figure, file, caption, table=table) for figure, file, caption, table in wanted if figure]


def stress_contents(stress, gallery):
    """Pictures, counts, the cases that did not hold, and all cases by group; in each group what failed comes first."""
    rows = stress.rows
    groups = []
    for name in dict.fromkeys(row["group"] for row in rows):
        some = sorted((row for row in rows if row["group"] == name), key=lambda row: ORDER[row["verdict"]])
        count = Counter(row["verdict"] for row in some)
        groups.append({"name": name, "cases": [case_of(row) for row in some],
                       "counts": [name] + [three(int(v)) for v in (len(some), count["PASS"], count["FAIL"],
                                                              count["INCONCLUSIVE"])]
                       + [seconds(sum(row["seconds"] for row in some if row["seconds"] > 0) or math.nan)],
                       "worst": min(ORDER[row["verdict"]] for row in some)})
    groups.sort(key=lambda group: group["worst"])  # stable: the order of the file among equals
    not_held = sorted((row for row in rows if row["verdict"] != "PASS"), key=lambda row: ORDER[row["verdict"]])
    return {"name": stress.name, "sentence": words_of(Counter(row["verdict"] for row in rows)) + ".",
            "pictures": draw(stress, gallery), "solver": solver_rows(stress.solver), "groups": groups, "cases": [case for group in groups for case in group["cases"]],
            "failures": [case_of(row) for row in not_held]}
