# SPDX-License-Identifier: MIT
"""Holds the numbers of a text in Markdown against the published tables.

A table is marked by the line before it, a single number by a comment just before the number:

    <!-- published: errors.csv: {cell} | {load} | {localized} ± {reference_bar} | {affine} -->
    <!-- published: errors.csv layered/strip-2 localized -->8.8

Of a table without `: ...` the headers are names of columns. Each cell must be what the file has, to
the digits of the text, and each row of the file must stand in the table, unless the mark begins
`published: part of FILE`. Cells that are empty, as the first of a group of rows says it, repeat the
one above; of names what follows a comma is for readers.

A row is named by its first columns, joined by `/`; with `*` it stands for several, of which the
column says `:min`, `:max`, `:median`, `:sum` or `:count`. Names with blanks stand in quotes. Every number that
has no mark is a fault, outside of code and of the kinds that are no results (ALLOWED).
"""
import csv
import fnmatch
import math
import os
import re
import shlex
import statistics

MARK = re.compile(r"<!--\s*published:\s*(.*?)\s*-->")
NUMBER = r"[−-]?\d+(?:,\d{3})*(?:\.\d+)?(?:e[−+-]?\d+)?"
BARE = re.compile(rf"(?<![\w.^/-]){NUMBER}(?![\w^]|\.\d|/)")
FOLDS = {"min": min, "max": max, "median": statistics.median, "sum": sum, "count": len}

# Numbers that are no results, by kind.
ALLOWED = {
    "exit statuses": r"[Ee]xit status(?:es)?[^.\n]*(?:\n[^.\n]+)?",
    "sizes that a command asks for": r"\d+ x \d+(?: cells)?",
    "the paper's size": r"800 coarse and 288,000 fine triangles|800 triangles",
    "strains at which errors are told": r"\b(?:1 %|10 %|1 % and 10 %) strain",
    "the unit of a table": r"1/1000|1000ths",
    "equations and figures of the paper": (
        r"(?:Eq\.|Equation|Figures?|Figs?\.) \d+(?:(?: and |, )\d+)*"
    ),
    "axes": r"\baxis \d|\b11, 22, 12\b",
    "versions": (
        r"(?:Debian|version|C\+\+|homespun|homespun_|GCC|deal\.II|HDF5|Eigen|Python)"
        r"\s?\d+(?:\.\d+)*\S*"
    ),
    "counts of commands": r"\b\d+ commands?\b",
    "ranks and threads": r"\b\d+ (?:MPI )?(?:ranks?|threads?|cores?|processors?)\b",
    "dimensions": r"\b[23]D\b|\bin 3 dimensions\b",
}


def read_tables(folder):
    """{FILE: [row]} of the published tables."""
    tables = {}
    for name in sorted(os.listdir(folder)):
        if name.endswith(".csv"):
            with open(os.path.join(folder, name), encoding="utf-8", newline="") as file:
                tables[name] = list(csv.DictReader(file))
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
        for places in {decimals, -zeros}
    )


def words_of(text):
    """A name as the tables have it: without backticks and what is said of it."""
    return text.replace("`", "").split(",")[0].strip()


def pattern_of(template):
    """(expression, columns) of a cell `{localized} ± {reference_bar}`; a group takes a number or a
    name.
    """
    parts = re.split(r"\{([\w+-]+)\}", template.strip())
    expression = "".join(
        "(.+?)" if k % 2 else re.escape(part).replace(r"\ ", r"\s*") for k, part in enumerate(parts)
    )
    return re.compile(expression + r"\Z"), parts[1::2]


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
        if column not in rows[0] and fold != "count":
            self.fault(line, f"{file} has no column `{column}`")
        elif len(rows) > 1 and fold not in FOLDS:
            self.fault(
                line,
                (
                    f"{file} has {len(rows)} rows `{name}`; expected one, or COLUMN:min, :max, :sum"
                    " or :count"
                ),
            )
        else:
            values = (
                [1.0] * len(rows)
                if fold == "count"
                else [float(row[column]) for row in rows if row[column]]
            )
            value = FOLDS[fold](values) if fold else values[0] if values else math.nan
            if not is_printed_as(value, text):
                self.fault(line, f"says {text}; {file}, {name}, {column} has {value:.8g}")

    def check_table(self, line, mark, lines):
        """A mark FILE[: TEMPLATE | ...], and the lines of the table behind it."""
        head, _, templates = mark.partition(":")
        is_part = head.startswith("part of ")
        file = head.removeprefix("part of ").strip()
        if file not in self.tables:
            self.fault(
                line, f"{file} is not published; expected one of {', '.join(self.tables) or 'none'}"
            )
            return
        header, _, *body = [
            [cell.strip() for cell in text.strip().strip("|").split("|")] for text in lines
        ]
        cells = (
            [cell.strip() for cell in templates.split("|")]
            if templates
            else ["{" + words_of(name) + "}" for name in header]
        )
        patterns, above, found = [pattern_of(cell) for cell in cells], {}, set()
        for k, texts in enumerate(body, start=line + 2):
            above = self.check_row(k, file, patterns, texts, above)
            found.add(tuple(above.get(key) for key in self.keys[file]))
        for row in self.tables[file] if not is_part else []:
            if tuple(row[key] for key in self.keys[file]) not in found:
                self.fault(
                    line,
                    f"the table lacks {'/'.join(row[key] for key in self.keys[file])} of {file}",
                )

    def check_row(self, line, file, patterns, texts, above):
        """@return names of this row, those that are empty from the row above"""
        keys, values = dict(above), []
        for (pattern, columns), text in zip(patterns, texts):
            if not text and all(column in self.keys[file] for column in columns):
                continue
            match = pattern.match(text)
            if not match:
                self.fault(line, f"`{text}` is not of the form {pattern.pattern}")
                continue
            for column, part in zip(columns, match.groups()):
                if column in self.keys[file]:
                    keys[column] = words_of(part)
                else:
                    values.append((column, part.strip()))
        if len(texts) != len(patterns):
            self.fault(line, f"has {len(texts)} cells, its mark {len(patterns)}")
        row = next(
            (
                row
                for row in self.tables[file]
                if all(row[key] == keys.get(key) for key in self.keys[file])
            ),
            None,
        )
        if row is None:
            self.fault(
                line, f"{file} has no row {'/'.join(str(keys.get(key)) for key in self.keys[file])}"
            )
            return keys
        for column, text in values:
            if column not in row:
                self.fault(line, f"{file} has no column `{column}`")
            elif not (
                row[column] == text
                or is_printed_as(row[column], text)
                or (text == "–" and not row[column])
            ):
                self.fault(
                    line,
                    (
                        f"says {text}; {file}, {'/'.join(row[key] for key in self.keys[file])},"
                        f" {column} has {row[column] or 'nothing'}"
                    ),
                )
        return keys


def faults_of(text, tables, keys):
    """One sentence per number of a text that is not what the tables have, or that nothing says
    where it is from.
    """
    checker = Checker(tables, keys)
    text = re.sub(r"^```.*?^```", lambda m: "\n" * m.group().count("\n"), text, flags=re.M | re.S)
    lines = text.split("\n")
    k = 0
    while k < len(lines):
        line = lines[k]
        alone = MARK.fullmatch(line.strip())
        if alone and k + 1 < len(lines) and lines[k + 1].lstrip().startswith("|"):
            end = k + 1
            while end < len(lines) and lines[end].lstrip().startswith("|"):
                end += 1
            checker.check_table(k + 1, alone.group(1), lines[k + 1 : end])
            lines[k:end] = [""] * (end - k)
            k = end
            continue
        k += 1
    text = "\n".join(lines)

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
