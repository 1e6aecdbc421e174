# SPDX-License-Identifier: MIT
"""Reads stress.csv, the cases of `homespun stress`, and orders them: what failed comes first."""
import math
from collections import Counter
from dataclasses import dataclass, field

from stored import VERDICTS, latest, read_csv
from style import seconds, three

AGAIN = "Run `homespun stress` again."
HEADER = "group,case,expected,outcome,figure,limit,verdict,repeats,seconds".split(",")
MARKS = {"PASS": "✓", "FAIL": "✗", "INCONCLUSIVE": "?"}
ORDER = {"FAIL": 0, "INCONCLUSIVE": 1, "PASS": 2}


@dataclass
class Stress:
    """The cases of one folder, rows of stress.csv."""
    folder: str
    name: str
    rows: list = field(default_factory=list)


def read_stress(folder, name, path, faults, missing):
    """@return Stress, whose rows are in the order of the file"""
    rows = latest(read_csv(path, HEADER, faults, missing, AGAIN), ("group", "case"), path, missing)
    for row in rows:
        if row["verdict"] not in VERDICTS:
            faults.append(f"{path}, line {row['line']}: `verdict` is `{row['verdict']}`, expected one of "
                          f"{', '.join(VERDICTS)}. {AGAIN}")
    if not rows:
        missing.append({"what": f"stress cases of {name}", "why": f"{path} has no complete row"})
    return Stress(folder, name, rows)


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


def stress_contents(stress):
    """Counts, the cases that did not hold, and all cases by group; in each group what failed comes first."""
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
            "groups": groups, "cases": [case for group in groups for case in group["cases"]],
            "failures": [case_of(row) for row in not_held]}
