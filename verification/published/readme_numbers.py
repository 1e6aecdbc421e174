# SPDX-License-Identifier: MIT
"""Holds the numbers of a text in Markdown against the published tables.

A number is marked by a comment just before it, which names table, row and column:

    <!-- published: errors.csv layered/strip-2 localized -->8.8

A row is named by its first columns, joined by `/`. With `*` the name stands for several rows, and
the column ends in `:min`, `:max`, `:median` (of the rows in which the law holds), `:sum` or
`:count`; the last three take one row of each case (without_twins()). `A/B` in place of a column is
the ratio of two, `A>B:count` the number of rows where one is larger, `A=TEXT:count` of those where
it is a text. Names with blanks stand in quotes.
Every number that has no mark is a fault, outside of code and of the kinds that are no results
(ALLOWED).
"""
import csv
import fnmatch
import math
import os
import re
import shlex
import statistics

MARK = re.compile(r"<!--\s*published:\s*((?s:.)*?)\s*-->")
NUMBER = r"[−-]?\d+(?:,\d{3})*(?:\.\d+)?(?:e[−+-]?\d+)?"
BARE = re.compile(rf"(?<![\w.^/-]){NUMBER}(?![\w^]|\.\d|/)")
FOLDS = {"min": min, "max": max, "median": statistics.median, "sum": sum, "count": len}

# Numbers that are no results, by kind.
ALLOWED = {
    "exit statuses": r"[Ee]xit status(?:es)?[^.\n]*(?:\n[^.\n]+)?",
    "sizes that a command asks for": r"\d+ x\s\d+",
    "the paper's size": r"800 coarse and 288,000 fine triangles|800 triangles",
    "strains at which errors are told": r"\b10?\s%\s+strain",
    "the unit of a table": r"1/1000|1000ths",
    "equations and figures of the paper": (
        r"(?:Eq\.|Equation|Figures?|Figs?\.) \d+(?:(?: and |, )\d+)*"
    ),
    "axes": r"\baxis \d|\b11, 22, 12\b",
    "versions": (
        r"(?:Debian|version|C\+\+|homespun|homespun_|GCC|deal\.II|HDF5|Eigen|Python)"
        r"\s?\d+(?: or \d+|(?:\.\d+)*\S*)"
    ),
    "counts of commands": r"\b\d+ commands?\b",
    "ranks and threads": r"\b\d+ (?:MPI )?(?:ranks?|threads?|cores?|processors?)\b",
    "times": r"\b\d+(?:\.\d+)?(?: to \d+)? (?:s|min|minutes|hours?|milliseconds)\b",
    "dimensions": r"\b[23]D\b|\bin 3 dimensions\b",
}


def read_tables(folder):
    """{FILE: [row]} of the published tables."""
    tables = {}
    for name in sorted(os.listdir(folder)):
        if name.endswith(".csv"):
            with open(os.path.join(folder, name), encoding="utf-8", newline="") as file:
                tables[name] = with_twins_marked(list(csv.DictReader(file)))
    return tables


def is_printed_as(value, text):
    """Whether a number, rounded to the digits of a text, is that text. Zeros at the end of a whole
    number may be rounding, behind three digits that are not.
    """
    text = text.replace(",", "").replace("−", "-")
    try:
        value = float(value)
    except ValueError:
        return False
    if not math.isfinite(value):
        return False
    if "e" in text:
        digits = len(text.split("e")[0].lstrip("-").replace(".", "")) - 1
        return math.isclose(float(f"{value:.{digits}e}"), float(text), rel_tol=1e-12)
    decimals = len(text.split(".")[1]) if "." in text else 0
    whole = text.lstrip("-")
    zeros = max(0, min(len(whole) - len(whole.rstrip("0")), len(whole) - 3)) if not decimals else 0
    return any(
        float(f"{round(value, places):.{decimals}f}") == float(text)
        for places in ({decimals} if decimals else {0, -zeros})
    )


def value_of(row, column):
    """The number in a column, or the ratio A/B of two; None where the row has none, or where A of
    A>B is not larger, or A of A=TEXT another text.
    """
    if "=" in column:
        name, text = column.split("=")
        return 1.0 if row[name] == text else None
    if ">" in column:
        one, other = (value_of(row, name) for name in column.split(">"))
        return one if None not in (one, other) and one > other else None
    parts = [row[name] for name in column.split("/")]
    if "" in parts:
        return None
    return float(parts[0]) / (float(parts[1]) if len(parts) > 1 else 1.0)


def is_lost(row):
    """Whether the law has lost ellipticity at the strain of a row."""
    return bool(row.get("law_lost_at")) and float(row["strain"]) >= float(row["law_lost_at"])


TWINS = {"strip-2": "strip-1", "cantilever-2": "cantilever-1"}  # loads that differ by the axis


def with_twins_marked(rows):
    """Rows, with `twin` where one says what that of its twin load has said: the cell looks the same
    along both axes, as all its errors under both loads tell. Two errors are the same that differ by
    no more than the sum of their bars; without bars, that are equal.
    """
    places = {
        (row["cell"], row["load"], row.get("strain"), row.get("what")): row
        for row in rows
        if "cell" in row and "load" in row
    }
    pairs = {}  # {(cell, load): [(error, that of the twin)]}
    for (cell, load, *level), row in places.items():
        twin = places.get((cell, TWINS.get(load), *level), {})
        pairs.setdefault((cell, load), []).extend(
            (row[name], twin.get(name), row[f"{name}_bar"], twin.get(f"{name}_bar"))
            for name in row if f"{name}_bar" in row
        )
    alike = {
        key
        for key, some in pairs.items()
        if any(one for one, *_ in some)
        and all(
            one == two
            or all((one, two, *bars)) and abs(float(one) - float(two)) <= sum(map(float, bars))
            for one, two, *bars in some
        )
    }
    return [
        {**row, "twin": "yes" * ((row.get("cell"), row.get("load")) in alike)} for row in rows
    ]


def without_twins(rows):
    """One row of each case."""
    return [row for row in rows if not row.get("twin")]


class Checker:
    """Faults of one text."""

    def __init__(self, tables, keys):
        """@param keys {FILE: columns that name a row}"""
        self.tables, self.keys, self.faults = tables, keys, []

    def fault(self, line, text):
        self.faults.append(f"line {line + 1}: {text}")

    def rows_named(self, line, file, name):
        if file not in self.tables:
            self.fault(
                line, f"{file} is not published; expected one of {', '.join(self.tables) or 'none'}"
            )
            return []
        rows = [
            row
            for row in self.tables[file]
            if fnmatch.fnmatchcase("/".join(row[key] for key in self.keys[file]), name)
        ]
        if not rows:
            self.fault(line, f"{file} has no row `{name}`")
        return rows

    def check_number(self, line, mark, text):
        """A mark FILE ROW COLUMN[:FOLD], and what stands behind it."""
        words = shlex.split(mark)
        if len(words) != 3:
            self.fault(
                line, f"the mark `{mark}` names {len(words)} things, expected FILE ROW COLUMN"
            )
            return
        file, name, column = words
        column, _, fold = column.partition(":")
        rows = self.rows_named(line, file, name)
        if not rows:
            return
        unknown = [part for part in re.split("[/>]", column.split("=")[0]) if part not in rows[0]]
        if unknown:
            self.fault(line, f"{file} has no column `{unknown[0]}`")
        elif len(rows) > 1 and fold not in FOLDS:
            self.fault(
                line,
                (
                    f"{file} has {len(rows)} rows `{name}`; expected one, or COLUMN:min, :max,"
                    " :median, :sum or :count"
                ),
            )
        else:
            if fold in ("median", "sum", "count"):
                rows = without_twins(rows)
            if fold == "median":
                rows = [row for row in rows if not is_lost(row)]
            values = [value for row in rows if (value := value_of(row, column)) is not None]
            value = FOLDS[fold](values) if fold else values[0] if values else math.nan
            if not is_printed_as(value, text):
                self.fault(line, f"says {text}; {file}, {name}, {column} has {value:.8g}")


def faults_of(text, tables, keys):
    """One sentence per number of a text that is not what the tables have, or that nothing says
    where it is from.
    """
    checker = Checker(tables, keys)
    text = re.sub(r"^```.*?^```", lambda m: "\n" * m.group().count("\n"), text, flags=re.M | re.S)

    def marked(match):
        line = text.count("\n", 0, match.start())
        checker.check_number(line, match.group(1), match.group(2))
        return "\n" * match.group().count("\n")

    rest = re.sub(MARK.pattern + rf"[\s`*]*({NUMBER})", marked, text)
    if leftover := MARK.search(rest):
        checker.fault(
            rest.count("\n", 0, leftover.start()),
            f"behind the mark `{leftover.group(1)}` stands no number",
        )
    for kind in (r"<!--.*?-->", r"`[^`\n]*`", r"\]\([^)]*\)", *ALLOWED.values()):
        rest = re.sub(
            kind,
            lambda m: "\n" * m.group().count("\n"),
            rest,
            flags=re.S if kind.startswith("<") else 0,
        )
    for match in BARE.finditer(rest):
        checker.fault(
            rest.count("\n", 0, match.start()),
            f"{match.group()} has no mark `<!-- published: FILE ROW COLUMN -->`",
        )
    return checker.faults
