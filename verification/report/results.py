# SPDX-License-Identifier: MIT
"""Reads the folders that `homespun strain` and `homespun homogenize` write, and judges them.

A piece that is absent is noted (`Results.missing`) and the report goes on without it; a piece that is
there but makes no sense is a fault. All faults of all folders are collected and raised together.
"""
import csv
import json
import math
import os
from dataclasses import dataclass, field

import numpy

from cell_results import Cell, read_cell, read_fields

STRAIN_HEADER = ("cell,load,strain,reference,method,cells,coarse_triangles,fine_triangles,error_mean_m,"
                 "error_rms_m,error_max_m,error_mean_per_cell,error_mean_per_fluctuation,"
                 "reference_uncertainty_m,seconds_method,seconds_reference").split(",")
UNCERTAINTY_HEADER = ("cell,load,reference,strain,cells,p1_minus_p2_m,p1_minus_refined_p2_m,"
                      "p2_minus_refined_p2_m,uncertainty_per_strain_and_side").split(",")
STEPS_HEADER = ("cell,load,reference,strain,seconds_coarse_solve,seconds_upsample,seconds_fine_step,"
                "coarse_iterations,fine_iterations,fine_dofs,ranks").split(",")
TEXT_COLUMNS = {"cell", "load", "reference", "method"}
NEEDED_NUMBERS = {"strain"}  # every other number may be empty or nan
UNREACHED = "unreached"
VERDICTS = ("PASS", "FAIL", "INCONCLUSIVE")


class BadResults(Exception):
    """Result files that cannot be used; one message per fault."""

    def __init__(self, faults):
        super().__init__("\n".join(faults))
        self.faults = list(faults)

    def __reduce__(self):  # so that the faults survive the way between processes
        return BadResults, (self.faults,)


@dataclass
class Study:
    """What one result folder says about itself."""
    folder: str
    name: str
    info: dict = field(default_factory=dict)      # study.json
    verdicts: list = field(default_factory=list)  # verdicts.json


@dataclass
class Results:
    """Everything that is reported. Rows are dictionaries with the columns of their file."""
    studies: list = field(default_factory=list)
    cells: dict = field(default_factory=dict)  # name -> Cell, in the order they were found
    strain: list = field(default_factory=list)
    uncertainty: list = field(default_factory=list)
    steps: list = field(default_factory=list)
    missing: list = field(default_factory=list)  # {"what", "why"}

    def reached(self, cell=None):
        """Rows of strain.csv with an error in them."""
        return [row for row in self.strain if row["method"] != UNREACHED
                and not math.isnan(row["error_mean_m"]) and cell in (None, row["cell"])]

    def unreached(self):
        return [row for row in self.strain if row["method"] == UNREACHED]


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


def read_csv(path, header, faults, missing):
    """Rows of a CSV file as dictionaries, each with its line number under `line`.

    A last line without its newline is what an interrupted run leaves: it is left out and noted, never
    read, since a number cut short still looks like a number.
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
            faults.append(f"{path}, line {number}: found {len(fields)} fields, expected {len(header)}. "
                          "Remove the line and run the study again with --resume.")
            continue
        row = {"line": number}
        for key, raw in zip(header, (value.strip() for value in fields)):
            row[key] = raw if key in TEXT_COLUMNS else number_of(raw, key, path, number, faults)
        for key in TEXT_COLUMNS.intersection(header):
            if not row[key]:
                faults.append(f"{path}, line {number}: `{key}` is empty, expected a name. "
                              "Remove the line and run the study again with --resume.")
        rows.append(row)
    return rows


def number_of(raw, key, path, line, faults):
    """A number, nan where the field is empty; what is not a number is a fault."""
    try:
        value = float(raw) if raw else math.nan
    except ValueError:
        value = None
    sound = value is not None and not math.isinf(value)
    if sound and key in NEEDED_NUMBERS:
        sound = value > 0
    elif sound:
        sound = math.isnan(value) or value >= 0
    if not sound:
        wanted = "a number above zero" if key in NEEDED_NUMBERS else "a number, zero or above, or nothing"
        faults.append(f"{path}, line {line}: `{key}` is `{raw}`, expected {wanted}. "
                      "Remove the line and run the study again with --resume.")
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


def check_study(value, path, faults):
    """study.json with the types the report relies on; absent keys are fine."""
    wanted = {"left_out": list, "notes": list, "provenance": dict, "command": str,
              "seconds_total": (int, float), "peak_memory_bytes": (int, float)}
    for key, kind in wanted.items():
        if value.get(key) is not None and not isinstance(value[key], kind):
            faults.append(f"{path}: key `{key}` is a {type(value[key]).__name__}, expected "
                          f"{kind.__name__ if isinstance(kind, type) else 'a number'}. Run the study again.")
            value = {**value, key: None}
    for i, item in enumerate(value.get("left_out") or []):
        if not isinstance(item, dict) or "what" not in item or "why" not in item:
            faults.append(f"{path}: left_out[{i}] needs `what` and `why`. Run the study again.")
            value = {**value, "left_out": None}
            break
    return value


def read_folder(folder, results, faults):
    """Adds what one result folder holds to the results."""
    if not os.path.isdir(folder):
        faults.append(f"{folder}: no such folder. Give the --output folder of `homespun strain`.")
        return
    study = Study(folder, os.path.basename(os.path.normpath(os.path.abspath(folder))))

    def path_of(name, consequence):
        path = os.path.join(folder, name)
        if os.path.isfile(path):
            return path
        results.missing.append({"what": consequence, "why": f"{path} does not exist"})
        return None

    cell_folders = {name: os.path.join(folder, name) for name in sorted(os.listdir(folder))
                    if any(os.path.isfile(os.path.join(folder, name, file))
                           for file in ("homogenize.json", "cell.h5"))}
    if any(os.path.isfile(os.path.join(folder, file)) for file in ("homogenize.json", "cell.h5")):
        cell_folders[study.name] = folder  # the output of `homespun homogenize` alone
    if not cell_folders and not os.path.isfile(os.path.join(folder, "strain.csv")):
        faults.append(f"{folder}: holds no results: neither strain.csv nor CELL/homogenize.json. "
                      "Give the --output folder of `homespun strain` or `homespun homogenize`.")
        return
    results.studies.append(study)

    if path := path_of("study.json", "command, sizes and provenance of the study"):
        if value := read_json(path, faults):
            study.info = check_study(value, path, faults)
    if path := path_of("verdicts.json", "verdicts"):
        if value := read_json(path, faults):
            study.verdicts = check_verdicts(value, path, faults)
    if path := path_of("strain.csv", "error against strain"):
        keys = ("cell", "load", "strain", "reference", "method")
        rows = latest(read_csv(path, STRAIN_HEADER, faults, results.missing), keys, path, results.missing)
        if not rows:
            results.missing.append({"what": "error against strain", "why": f"{path} has no complete row"})
        results.strain += rows
    keys = ("cell", "load", "reference", "strain")
    if path := path_of("uncertainty.csv", "error bar of the references from P1, P2 and refined P2"):
        results.uncertainty += latest(read_csv(path, UNCERTAINTY_HEADER, faults, results.missing), keys,
                                      path, results.missing)
    if path := path_of("steps.csv", "time per load step"):
        results.steps += latest(read_csv(path, STEPS_HEADER, faults, results.missing), keys, path,
                                results.missing)
    for name, cell_folder in cell_folders.items():
        if name in results.cells:
            results.missing.append({"what": f"cell `{name}` of {folder}",
                                    "why": f"a cell of this name was read from {results.cells[name].folder}"})
        else:
            results.cells[name] = read_cell(name, cell_folder, read_json, faults, results.missing)


def read_results(folders):
    """Reads result folders.

    @return Results
    @throws BadResults with every fault of every file
    """
    results, faults = Results(), []
    for folder in folders:
        read_folder(folder, results, faults)
    for row in results.strain:
        results.cells.setdefault(row["cell"], Cell(row["cell"]))
    if faults:
        raise BadResults(faults)
    return results


def cell_side(results, name):
    """Side of a cell [m], sqrt(|Y|); None where nothing tells it."""
    cell = results.cells.get(name)
    if cell is not None and cell.side:
        return cell.side
    sides = [row["error_mean_m"] / row["error_mean_per_cell"] for row in results.reached(name)
             if row["error_mean_per_cell"] > 0]
    return float(numpy.median(sides)) if sides else None


__all__ = ["BadResults", "Results", "cell_side", "read_fields", "read_results"]
