# SPDX-License-Identifier: MIT
"""Reads the folders that `homespun strain`, `homogenize`, `drape`, `stress` and `converge` write, and judges them.

A piece that is absent is noted (`Results.missing`) and the report goes on without it; a piece that is
there but makes no sense is a fault. All faults of all folders are collected and raised together.
"""
import math
import os
from dataclasses import dataclass, field

import numpy

from budget_results import read_budget
from cell_results import Cell, read_cell, read_fields
from converge_results import read_convergence
from drape_results import read_drape
from stored import BadResults, check_verdicts, latest, read_csv, read_json
from stress_results import read_stress
from versions import is_inside, lists_all, merged, place_of, with_parts

STRAIN_HEADER = ("cell,load,strain,reference,method,cells,coarse_triangles,fine_triangles,error_mean_m,"
                 "error_rms_m,error_max_m,error_mean_per_cell,error_mean_per_fluctuation,"
                 "reference_uncertainty_m,seconds_method,seconds_reference").split(",")
UNCERTAINTY_HEADER = ("cell,load,reference,strain,cells,p1_minus_p2_m,p1_minus_refined_p2_m,"
                      "p2_minus_refined_p2_m,uncertainty_per_strain_and_side").split(",")
STEPS_HEADER = ("cell,load,reference,strain,seconds_coarse_solve,seconds_upsample,seconds_fine_step,"
                "coarse_iterations,fine_iterations,fine_dofs,ranks").split(",")
UNREACHED = "unreached"


@dataclass
class Study:
    """What one result folder says about itself."""
    folder: str
    name: str
    info: dict = field(default_factory=dict)      # study.json, or what drape.json says alike
    verdicts: list = field(default_factory=list)  # verdicts.json
    place: str = ""                               # folder of the version: that of `verify`, or its own
    lists_all: bool = False                       # of `homespun verify`: the claims of every part, and nothing else


@dataclass
class Results:
    """Everything that is reported. Rows are dictionaries with the columns of their file."""
    studies: list = field(default_factory=list)
    cells: dict = field(default_factory=dict)  # name -> Cell, in the order they were found
    strain: list = field(default_factory=list)
    uncertainty: list = field(default_factory=list)
    steps: list = field(default_factory=list)
    budget: list = field(default_factory=list)
    run_time: list = field(default_factory=list)
    validity: list = field(default_factory=list)
    drapes: list = field(default_factory=list)  # Drape, one per scene
    stress: list = field(default_factory=list)  # Stress, one per folder
    convergence: list = field(default_factory=list)  # Convergence, one per folder
    missing: list = field(default_factory=list)  # {"what", "why"}
    subjects: list = field(default_factory=list)  # Subject: each cell in each version

    def reached(self, cell=None):
        """Rows of strain.csv with an error in them."""
        return [row for row in self.strain if row["method"] != UNREACHED
                and not math.isnan(row["error_mean_m"]) and cell in (None, row["cell"])]

    def claims(self):
        """(study, verdict) of every claim; the folder of a `verify` lists those of all its parts, which then stand back."""
        listed = {study.place for study in self.studies if study.lists_all}
        return [(study, verdict) for study in self.studies if study.lists_all or study.place not in listed
                for verdict in study.verdicts]

    def unreached(self):
        return [row for row in self.strain if row["method"] == UNREACHED]


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


def read_folder(folder, results, faults, is_listed=False):
    """Adds what one result folder holds to the results.

    @param is_listed whether a folder of `verify` around it lists its claims, so that it needs no list of its own
    """
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

    def holds(*names):
        return any(os.path.isfile(os.path.join(folder, name)) for name in names)

    cell_folders = {name: os.path.join(folder, name) for name in sorted(os.listdir(folder))
                    if holds(os.path.join(name, "homogenize.json"), os.path.join(name, "cell.h5"))}
    if holds("homogenize.json", "cell.h5"):
        cell_folders[study.name] = folder  # the output of `homespun homogenize` alone
    has_drape, has_stress = holds("drape.json", "drape.csv", "motion.csv"), holds("stress.csv")
    has_convergence = holds("converge.csv")
    # A draped or stressed cell has a folder of its own too; its page is about motion, not about strain.
    has_strain = holds("strain.csv") or (bool(cell_folders) and not has_drape and not has_stress and not has_convergence)
    if not (has_drape or has_stress or has_strain or has_convergence) and holds("verdicts.json"):
        path = os.path.join(folder, "verdicts.json")
        study.lists_all = True
        study.verdicts = check_verdicts(read_json(path, faults) or {"verdicts": []}, path, faults)
        results.studies.append(study)
        return
    if not (has_drape or has_stress or has_strain or has_convergence):
        faults.append(f"{folder}: holds no results: neither strain.csv nor CELL/homogenize.json nor drape.json nor "
                      "stress.csv nor converge.csv. Give the --output folder of `homespun strain`, `homogenize`, `drape`, "
                      "`stress`, `converge` or `verify`.")
        return
    results.studies.append(study)
    if has_drape and (drape := read_drape(folder, path_of, faults, results.missing)):
        results.drapes.append(drape)
        study.info = {key: drape.info[key] for key in ("command", "provenance") if drape.info.get(key)}
    if has_stress:
        path = os.path.join(folder, "stress.csv")
        results.stress.append(read_stress(folder, study.name, path, faults, results.missing))
    if has_convergence:
        path = os.path.join(folder, "converge.csv")
        results.convergence.append(read_convergence(folder, study.name, path, faults, results.missing))
    if has_strain or holds("study.json"):
        if path := path_of("study.json", "command, sizes and provenance of the study"):
            if value := read_json(path, faults):
                study.info = {**study.info, **check_study(value, path, faults)}
    if (holds("verdicts.json") or not is_listed) and (path := path_of("verdicts.json", "verdicts")):
        if value := read_json(path, faults):
            study.verdicts = check_verdicts(value, path, faults)
    if has_strain:
        read_strain(folder, cell_folders, path_of, results, faults)


def read_strain(folder, cell_folders, path_of, results, faults):
    """Adds the tables of `homespun strain` and its cells to the results."""
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
    read_budget(path_of, results, faults)
    for name, cell_folder in cell_folders.items():
        results.cells[name] = read_cell(name, cell_folder, read_json, faults, results.missing)


def read_results(folders):
    """Reads result folders.

    @return Results
    @throws BadResults with every fault of every file
    """
    faults, parts = [], []
    folders = with_parts(folders)
    listing = [folder for folder in folders if lists_all(folder)]
    for folder in folders:
        part = Results()
        read_folder(folder, part, faults, any(is_inside(folder, other) for other in listing))
        parts.append((folder, part))
    if faults:
        raise BadResults(faults)
    results = merged(parts, folders, Results, Cell)
    for study in results.studies:
        study.place = place_of(study.folder, folders)
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
