# SPDX-License-Identifier: MIT
"""The table of a run: a row per mutant, and what the rows amount to."""
import csv
import os
import pathlib

COLUMNS = ["mutant", "kind", "file", "noticed_by_test", "seconds_to_notice", "tests_at",
           "noticed_by_program", "program_at", "builds"]
NOT_YET = "not asked"


class Table:
    """Rows by mutant. It is written as a whole and then renamed: what stands there is sound."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.rows = {}
        if self.path.exists():
            with open(self.path, newline="", encoding="utf-8") as file:
                reader = csv.DictReader(file)
                if reader.fieldnames != COLUMNS:
                    raise SystemExit(f"{self.path}: found the columns {reader.fieldnames}; expected"
                                     f" {COLUMNS}: take another folder, or move the file away")
                self.rows = {row["mutant"]: row for row in reader}

    def add(self, row):
        self.rows[row["mutant"]] = {column: str(row[column]) for column in COLUMNS}
        unfinished = self.path.with_suffix(".unfinished")
        with open(unfinished, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(self.rows.values())
            file.flush()
            os.fsync(file.fileno())
        os.replace(unfinished, self.path)


def new_row(mutant):
    return {**dict.fromkeys(COLUMNS, ""), "mutant": mutant.name, "kind": mutant.kind,
            "file": mutant.file, "noticed_by_test": NOT_YET, "noticed_by_program": NOT_YET,
            "builds": "true"}


def executed_in(work):
    """Names of the mutants in lines that the program executes, as executed.py found; or None."""
    path = pathlib.Path(work) / "executed.csv"
    if not path.exists():
        return None
    with open(path, newline="", encoding="utf-8") as file:
        return {row["mutant"] for row in csv.DictReader(file) if row["executed"] == "true"}


def score(rows, executed):
    """How many mutants tests and program notice, each of those it was asked about; who remain."""
    rows = [row for row in rows if row["builds"] == "true"]

    def asked(who):
        return [row for row in rows if row[who] != NOT_YET]

    def noticed(those, who):
        return f"{sum(bool(row[who]) for row in those)} of {len(those)}"
    tests = asked("noticed_by_test")
    programs = [row for row in asked("noticed_by_program")
                if executed is None or row["mutant"] in executed]
    where = "" if executed is None else " in lines that it executes"
    quiet = [row["mutant"] for row in tests
             if not row["noticed_by_test"] and row["noticed_by_program"] in ("", NOT_YET)]
    return (f"{len(rows)} mutants build; tests notice {noticed(tests, 'noticed_by_test')}, "
            f"the program {noticed(programs, 'noticed_by_program')}{where}; "
            f"unnoticed: {', '.join(quiet) or 'none'}")
