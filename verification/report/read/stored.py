# SPDX-License-Identifier: MIT
"""Reads the JSON and CSV files of a result folder, number by number, with one message per fault."""
import csv
import json
import os

import numpy

from read import schema
from read.verdicts import KINDS

VERDICTS = schema.OUTCOMES
AGAIN = "Run the study again with --overwrite."


class BadResults(Exception):
    """Result files that cannot be used; one message per fault."""

    def __init__(self, faults):
        super().__init__("\n".join(faults))
        self.faults = list(faults)

    def __reduce__(self):  # so that the faults survive the way between processes
        return BadResults, (self.faults,)


def lies_within(path, folder):
    """Whether a file that results name lies in their folder, links followed: results from elsewhere
    open nothing else.
    """
    base = os.path.realpath(folder)
    return os.path.commonpath([os.path.realpath(path), base]) == base


def version_is_known(path, values, faults):
    """Whether this version reads a file, by its `format_version`; older files have none.

    @param values of the file: a dictionary, or the attributes of an HDF5 file
    """
    version, newest = values.get("format_version", 0), schema.format_version()
    if isinstance(version, numpy.ndarray) and version.size == 1:  # as the program writes it
        version = version.item()
    is_number = isinstance(version, (int, numpy.integer)) and not isinstance(version, bool)
    if not is_number or version < 0:
        faults.append(
            f"{path}: found format_version {version}; expected a whole number from 0 to {newest}: the"
            " file is damaged, write it again"
        )
    elif version > newest:
        faults.append(
            f"{path}: found format_version {version}; expected at most {newest}: a newer homespun"
            " wrote the file: read it with that one, or write it again with this one"
        )
    else:
        return True
    return False


def read_json(path, faults):
    """The object in a JSON file, or None with a fault."""
    try:
        with open(path, encoding="utf-8") as file:
            value = json.load(file)
    except json.JSONDecodeError as error:
        faults.append(
            f"{path}, line {error.lineno}: not valid JSON ({error.msg}). "
            "The file is truncated or was edited: run the command that wrote it again."
        )
        return None
    except (OSError, UnicodeDecodeError) as error:
        faults.append(f"{path}: cannot be read ({error}). Check the file and its permissions.")
        return None
    if not isinstance(value, dict):
        faults.append(
            f"{path}: found a {type(value).__name__}, expected an object {{...}}. "
            "Run the command that wrote it again."
        )
        return None
    return value if version_is_known(path, value, faults) else None


def read_csv(path, faults, missing, advice=AGAIN):
    """Rows of a CSV file as dictionaries, each with its line number under `line`; columns, what
    they hold and which of them name a row are those of the schema. Of rows with the same name the
    last one: a run that was killed may leave two.

    A last line without its newline is what an interrupted run leaves: it is left out and noted,
    never read, since a number cut short still looks like a number.

    @param advice what to do about a line that makes no sense
    """
    table = schema.table(os.path.basename(path))
    try:
        with open(path, encoding="utf-8", newline="") as file:
            text = file.read()
    except (OSError, UnicodeDecodeError) as error:
        faults.append(f"{path}: cannot be read ({error}). Check the file and its permissions.")
        return []
    lines = text.split("\n")
    cut = lines.pop()  # what follows the last end of line: nothing in a table that is whole
    if not lines or lines[0].strip().split(",") != table.names:
        found = (lines or [cut])[0][:80] or "an empty file"
        faults.append(
            f"{path}, line 1: found `{found}`, expected the header `{','.join(table.names)}`: a"
            " homespun of another version wrote it, whose revision run.json says; read it with that"
            f" one. {advice}"
        )
        return []
    if cut:
        missing.append(
            {
                "what": f"line {len(lines) + 1} of {path}",
                "why": (
                    "it has no end of line: the run was interrupted while it was written. Run the"
                    " study again, it goes on"
                ),
            }
        )
    rows = []
    for number, fields in enumerate(csv.reader(lines[1:]), start=2):
        if not fields:
            continue
        if len(fields) != len(table.columns):
            faults.append(
                f"{path}, line {number}: found {len(fields)} fields, expected {len(table.columns)}."
                f" {advice}"
            )
            continue
        row = {"line": number}
        for column, field in zip(table.columns, fields):
            row[column.name], expected = column.read(field)
            if expected:
                faults.append(
                    f"{path}, line {number}: `{column.name}` is `{field}`, expected {expected}."
                    f" {advice}"
                )
        rows.append(row)
    return list({tuple(row[key] for key in table.key_names): row for row in rows}.values())


def is_stiffness(value):
    """Whether a value of a JSON file is a 3 x 3 matrix of finite numbers."""
    try:
        array = numpy.array(value, dtype=float)
    except (TypeError, ValueError):
        return False
    return array.shape == (3, 3) and bool(numpy.isfinite(array).all())


def check_verdicts(value, path, faults):
    """The list of verdicts, each with claim, kind, verdict, value, limit, derivation and command.
    """
    verdicts = value.get("verdicts")
    if not isinstance(verdicts, list):
        faults.append(f"{path}: key `verdicts` is missing or not a list. {AGAIN}")
        return []
    for i, verdict in enumerate(verdicts):
        if (
            not isinstance(verdict, dict)
            or not isinstance(verdict.get("claim"), str)
            or verdict.get("verdict") not in VERDICTS
        ):
            faults.append(
                f"{path}: verdicts[{i}] needs a `claim` and a `verdict` out of"
                f" {', '.join(VERDICTS)}. {AGAIN}"
            )
            return []
        if verdict.get("kind") not in KINDS or not isinstance(verdict.get("derivation"), str):
            faults.append(
                f"{path}: verdicts[{i}] has `kind` = `{verdict.get('kind')}` and"
                f" {'a' if 'derivation' in verdict else 'no'} `derivation`; expected a kind out of"
                f" {', '.join(KINDS)} and a sentence: another version of homespun wrote the file."
                f" {AGAIN}"
            )
            return []
    return verdicts
