# SPDX-License-Identifier: MIT
"""Reads the JSON and CSV files of a result folder, number by number, with one message per fault."""
import csv
import json
import math
import os

import numpy

TEXT_COLUMNS = {"cell", "load", "reference", "method", "scene", "variant", "term", "present", "group", "case",
                "expected", "outcome", "verdict", "study", "quantity", "h_unit", "part", "region", "way", "measure",
                "relation", "parameter"}
FREE_TEXT_COLUMNS = {"figure", "limit", "judgement", "note", "derivation"}  # may be empty
NEEDED_NUMBERS = {"strain", "h"}  # above zero; every other number may be empty or nan
TIMES = {"time_s"}           # needed, zero or above
SIGNED_NUMBERS = {"centre_x_m", "centre_y_m", "centre_z_m", "elastic_J", "gravity_J",
                  "value", "observed_order", "order", "order_lowest", "richardson_limit", "share"}
VERDICTS = ("PASS", "FAIL", "INCONCLUSIVE")
RESUME = "Remove the line and run the study again with --resume."


class BadResults(Exception):
    """Result files that cannot be used; one message per fault."""

    def __init__(self, faults):
        super().__init__("\n".join(faults))
        self.faults = list(faults)

    def __reduce__(self):  # so that the faults survive the way between processes
        return BadResults, (self.faults,)


def lies_within(path, folder):
    """Whether a file that results name lies in their folder, links followed: results from elsewhere open nothing else."""
    base = os.path.realpath(folder)
    return os.path.commonpath([os.path.realpath(path), base]) == base


def read_json(path, faults):
    """The object in a JSON file, or None with a fault."""
    try:
        with open(path, encoding="utf-8") as file:
            value = json.load(file)
    except json.JSONDecodeError as error:
        faults.append(f"{path}, line {error.lineno}: not valid JSON ({error.msg}). "
                      "The file is truncated or was edited: run the command that wrote it again.")
        return None
    except (OSError, UnicodeDecodeError) as error:
        faults.append(f"{path}: cannot be read ({error}). Check the file and its permissions.")
        return None
    if not isinstance(value, dict):
        faults.append(f"{path}: found a {type(value).__name__}, expected an object {{...}}. "
                      "Run the command that wrote it again.")
        return None
    return value


def read_csv(path, header, faults, missing, advice=RESUME):
    """Rows of a CSV file as dictionaries, each with its line number under `line`.

    A last line without its newline is what an interrupted run leaves: it is left out and noted, never
    read, since a number cut short still looks like a number.

    @param advice what to do about a line that makes no sense
    """
    try:
        with open(path, encoding="utf-8", newline="") as file:
            text = file.read()
    except (OSError, UnicodeDecodeError) as error:
        faults.append(f"{path}: cannot be read ({error}). Check the file and its permissions.")
        return []
    lines = text.splitlines()
    if not lines or lines[0].strip().split(",") != header:
        found = lines[0][:80] if lines else "an empty file"
        faults.append(f"{path}, line 1: found `{found}`, expected the header `{','.join(header)}`. "
                      "Move the file away and run the study again.")
        return []
    if not text.endswith("\n") and len(lines) > 1:
        missing.append({"what": f"line {len(lines)} of {path}",
                        "why": "it has no end of line: the run was interrupted while it was written. "
                               "Run the study again with --resume"})
        lines.pop()
    rows = []
    for number, fields in enumerate(csv.reader(lines[1:]), start=2):
        if not fields:
            continue
        if len(fields) != len(header):
            faults.append(f"{path}, line {number}: found {len(fields)} fields, expected {len(header)}. {advice}")
            continue
        row = {"line": number}
        for key, raw in zip(header, (value.strip() for value in fields)):
            text = key in TEXT_COLUMNS or key in FREE_TEXT_COLUMNS
            row[key] = raw if text else number_of(raw, key, path, number, faults, advice)
        for key in TEXT_COLUMNS.intersection(header):
            if not row[key]:
                faults.append(f"{path}, line {number}: `{key}` is empty, expected a name. {advice}")
        rows.append(row)
    return rows


def number_of(raw, key, path, line, faults, advice=RESUME):
    """A number, nan where the field is empty; what is not a number is a fault."""
    try:
        value = float(raw) if raw else math.nan
    except ValueError:
        value = None
    if key in NEEDED_NUMBERS:
        wanted, sound = "a number above zero", value is not None and 0 < value
    elif key in TIMES:
        wanted, sound = "a number, zero or above", value is not None and 0 <= value
    elif key in SIGNED_NUMBERS:
        wanted, sound = "a number or nothing", value is not None
    else:
        wanted, sound = "a number, zero or above, or nothing", value is not None and not value < 0
    if not sound or math.isinf(value):
        faults.append(f"{path}, line {line}: `{key}` is `{raw}`, expected {wanted}. {advice}")
        return math.nan
    return value


def latest(rows, keys, path, missing):
    """Of rows with the same keys the last one: a resumed study may have repeated a row."""
    unique = {}
    for row in rows:
        unique[tuple(row[key] for key in keys)] = row
    if len(unique) < len(rows):
        missing.append({"what": f"{len(rows) - len(unique)} repeated rows of {path}",
                        "why": "of rows with the same " + ", ".join(keys) + " the last one is shown"})
    return list(unique.values())


def is_stiffness(value):
    """Whether a value of a JSON file is a 3 x 3 matrix of finite numbers."""
    try:
        array = numpy.array(value, dtype=float)
    except (TypeError, ValueError):
        return False
    return array.shape == (3, 3) and bool(numpy.isfinite(array).all())


def check_verdicts(value, path, faults):
    """The list of verdicts, each with claim, verdict, value, limit and command."""
    verdicts = value.get("verdicts")
    if not isinstance(verdicts, list):
        faults.append(f"{path}: key `verdicts` is missing or not a list. Run the study again.")
        return []
    for i, verdict in enumerate(verdicts):
        if not isinstance(verdict, dict) or not isinstance(verdict.get("claim"), str) \
                or verdict.get("verdict") not in VERDICTS:
            faults.append(f"{path}: verdicts[{i}] needs a `claim` and a `verdict` out of "
                          f"{', '.join(VERDICTS)}. Run the study again.")
            return []
    return verdicts
