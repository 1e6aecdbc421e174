# SPDX-License-Identifier: MIT
"""Reads the runs of `homespun strain`, `homogenize`, `drape`, `stress`, `converge`, `bend` and `verify`,
and judges them.

A piece that is absent is noted (`Results.missing`) and the report goes on without it; a piece that
is there but makes no sense is a fault. All faults of all folders are collected and raised together.
"""
import math
import os
from dataclasses import dataclass, field

import numpy

from read.bend_results import read_bend
from read.budget_results import read_budget
from read.cell_results import Cell, read_cell, read_fields
from read.converge_results import read_convergence
from read.drape_results import read_drape
from read.load_results import read_load
from read.runs import COMMANDS, LIST, with_parts
from read.schema import OUTCOMES, NoSchema
from read.stability_results import read_stability
from read.stored import BadResults, check_verdicts, read_csv, read_json
from read.stress_results import read_stress
from read.versions import merged, tags

UNREACHED = "unreached"


@dataclass
class Study:
    """What one run says about itself."""

    folder: str
    name: str
    run: object = None  # Run
    info: dict = field(default_factory=dict)  # study.json, or what drape.json says alike
    verdicts: list = field(default_factory=list)  # verdicts.json
    # Folder of the version: that of `verify`, or its own.
    place: str = ""

    @property
    def lists_all(self):
        """Whether it is that of `homespun verify`: the claims of every part, and nothing else."""
        return self.run is not None and self.run.command == "verify"


# What a study of strain has beside its cells.
OF_STRAIN = (
    "error against strain",
    "error bar of the references from P1, P2 and refined P2",
    "energy of the reference between two sides",
    "time per load step",
    "the error budget",
    "error against run time of every way",
    "the range of validity",
    "gains of the coarse cloth and of up-sampling",
    "forces of the loads",
)


@dataclass
class Results:
    """Everything that is reported. Rows are dictionaries with the columns of their file."""

    studies: list = field(default_factory=list)
    cells: dict = field(default_factory=dict)  # name -> Cell, in the order they were found
    strain: list = field(default_factory=list)
    forces: list = field(default_factory=list)
    uncertainty: list = field(default_factory=list)
    energies: list = field(default_factory=list)
    steps: list = field(default_factory=list)
    budget: list = field(default_factory=list)
    run_time: list = field(default_factory=list)
    validity: list = field(default_factory=list)
    gains: list = field(default_factory=list)
    drapes: list = field(default_factory=list)  # Drape, one per scene
    stress: list = field(default_factory=list)  # Stress, one per folder
    convergence: list = field(default_factory=list)  # Convergence, one per folder
    loads: list = field(default_factory=list)  # LoadRun, one per folder
    stability: list = field(default_factory=list)  # StabilityRun, one per folder
    bends: list = field(default_factory=list)  # BendRun, one per folder
    missing: list = field(default_factory=list)  # {"what", "why"}
    subjects: list = field(default_factory=list)  # Subject: each cell in each version

    def reached(self, cell=None):
        """Rows of strain.csv with an error in them."""
        return [
            row
            for row in self.strain
            if row["method"] != UNREACHED
            and not math.isnan(row["error_mean_m"])
            and cell in (None, row["cell"])
        ]

    def claims(self):
        """(study, verdict) of every claim; the folder of a `verify` lists those of all its parts,
        which then stand back.
        """
        listed = {study.place for study in self.studies if study.lists_all}
        return [
            (study, verdict)
            for study in self.studies
            if study.lists_all or study.place not in listed
            for verdict in study.verdicts
        ]

    def unreached(self):
        return [row for row in self.strain if row["method"] == UNREACHED]


def check_study(value, path, faults):
    """study.json with the types the report relies on; absent keys are fine."""
    wanted = {
        "left_out": list,
        "notes": list,
        "provenance": dict,
        "command": str,
        "seconds_total": (int, float),
        "peak_memory_bytes": (int, float),
    }
    for key, kind in wanted.items():
        if value.get(key) is not None and not isinstance(value[key], kind):
            faults.append(
                f"{path}: key `{key}` is a {type(value[key]).__name__}, expected"
                f" {kind.__name__ if isinstance(kind, type) else 'a number'}. Run the study again"
                " with --overwrite."
            )
            value = {**value, key: None}
    for i, item in enumerate(value.get("left_out") or []):
        if not isinstance(item, dict) or "what" not in item or "why" not in item:
            faults.append(
                f"{path}: left_out[{i}] needs `what` and `why`. Run the study again with"
                " --overwrite."
            )
            value = {**value, "left_out": None}
            break
    return value


def name_of_cell(run, inner):
    """What a cell is called in its run, whose folder may be that of the cell (inner is empty)."""
    for file, key in (("homogenize.json", "cell"), ("cell.json", "name")):
        path, _ = run.take(file) if not inner else (None, "")
        value = read_json(path, []) if path else None
        if value and isinstance(value.get(key), str) and value[key]:
            return value[key]
    return inner or run.name


def read_folder(run, name, results, faults, is_listed=False):
    """Adds what one run wrote to the results.

    @param name what the page calls it
    @param is_listed whether the run of `verify` around it lists its claims, so that it needs no
        list of its own
    """
    study = Study(run.folder, name, run, place=run.place)

    def path_of(name, consequence):
        path, why = run.take(name)
        if path is None:
            results.missing.append({"what": consequence, "why": why})
        return path

    cells = {
        os.path.dirname(name) for name in run.names("*homogenize.json") + run.names("*cell.h5")
    }
    cell_folders = {
        name_of_cell(run, inner): inner for inner in sorted(cells) if os.sep not in inner
    }
    has_drape, has_stress = run.holds("drape.json", "drape.csv", "motion.csv"), run.holds(
        "limits.csv"
    )
    has_convergence = run.holds("converge.csv")
    has_load = run.holds("load.csv")
    has_stability = run.holds("stability.csv")
    has_bend = run.holds("bend.csv")
    # A draped or stressed cell has a folder of its own too; its page is about motion, not about
    # strain.
    has_strain = run.holds("strain.csv") or (
        bool(cell_folders)
        and not (has_drape or has_stress or has_convergence or has_load or has_stability or has_bend)
    )
    shows = (has_drape, has_stress, has_strain, has_convergence, has_load, has_stability, has_bend)
    if not (study.lists_all or any(shows)):
        faults.append(
            f"{run.folder}: holds no results that a page shows: {LIST} says it is of `homespun"
            f" {run.command}`, and lists neither strain.csv nor homogenize.json nor drape.json nor"
            f" limits.csv nor converge.csv nor load.csv nor stability.csv nor bend.csv. Give"
            f" the --output folder of {COMMANDS}."
        )
        return
    results.studies.append(study)
    if has_drape and (drape := read_drape(run, path_of, faults, results.missing)):
        results.drapes.append(drape)
        study.info = {
            key: drape.info[key]
            for key in ("command", "provenance", "notes")
            if drape.info.get(key)
        }
    if has_stress and (path := path_of("limits.csv", f"stability map of {study.name}")):
        results.stress.append(
            read_stress(run.folder, study.name, path, path_of, faults, results.missing)
        )
    if has_convergence and (path := path_of("converge.csv", f"convergence of {study.name}")):
        results.convergence.append(
            read_convergence(run.folder, study.name, path, faults, results.missing)
        )
    if has_strain or run.holds("study.json"):
        if path := path_of("study.json", "command, sizes and provenance of the study"):
            if value := read_json(path, faults):
                study.info = {**study.info, **check_study(value, path, faults)}
    if run.command == "homogenize" and not run.holds("verdicts.json"):
        study.verdicts = checks_of(run, cell_folders, study.info)
    elif (run.holds("verdicts.json") or not is_listed) and (
        path := path_of("verdicts.json", "verdicts")
    ):
        if value := read_json(path, faults):
            study.verdicts = check_verdicts(value, path, faults)
    if has_load:
        results.loads.append(
            read_load(run, study.name, path_of, study.info, faults, results.missing)
        )
    if has_stability:
        results.stability.append(
            read_stability(run, study.name, path_of, faults, results.missing, cell_folders)
        )
    if has_bend:
        results.bends.append(
            read_bend(run, study.name, path_of, faults, results.missing, cell_folders)
        )
    if has_strain:
        read_strain(run, cell_folders, path_of, results, faults)
    run.look_for_strays()
    known = {item["why"] for item in results.missing}
    results.missing += [item for item in run.left_out() if item["why"] not in known]


def checks_of(run, cell_folders, info):
    """The checks of homogenize.json as claims: `homespun homogenize` has no other list of them."""
    found = []
    for name, inner in cell_folders.items():
        path, _ = run.take(os.path.join(inner, "homogenize.json"))
        value = read_json(path, []) if path else None
        for check in (value or {}).get("checks") or []:
            if isinstance(check, dict) and check.get("verdict") in OUTCOMES:
                found.append(
                    {
                        "id": check.get("id", ""),
                        "claim": f"{name}: {check.get('name', '?')}",
                        "kind": check.get("kind", "program"),
                        "verdict": check["verdict"],
                        "value": check.get("value"),
                        "limit": check.get("limit", ""),
                        "derivation": str(check.get("derivation") or ""),
                        "command": info.get("command") or f"homespun homogenize {name}.prm",
                    }
                )
    return found


def read_strain(run, cell_folders, path_of, results, faults):
    """Adds the tables of `homespun strain` and its cells to the results."""
    if path := path_of("strain.csv", OF_STRAIN[0]):
        results.strain += read_csv(path, faults, results.missing)
        if not results.strain:
            results.missing.append(
                {"what": OF_STRAIN[0], "why": f"{path} has no complete row"}
            )
    if path := path_of("uncertainty.csv", OF_STRAIN[1]):
        results.uncertainty += read_csv(path, faults, results.missing)
    if path := path_of("cross-checks.csv", OF_STRAIN[2]):
        rows = read_csv(path, faults, results.missing)
        results.energies += [row for row in rows if row["what"] == "energies"]
    if path := path_of("levels.csv", OF_STRAIN[3]):
        rows = read_csv(path, faults, results.missing)
        results.steps += [row for row in rows if row["reference_stability"]]
    if path := path_of("forces.csv", OF_STRAIN[7]):
        results.forces += read_csv(path, faults, results.missing)
    read_budget(path_of, results, faults)
    for name, inner in cell_folders.items():
        results.cells[name] = read_cell(name, run, inner, faults, results.missing)


def read_results(folders):
    """Reads result folders.

    @return Results
    @throws BadResults with every fault of every file
    """
    faults, missing, parts = [], [], []
    try:
        runs = with_parts(folders, faults, missing)
        names = tags(list(dict.fromkeys(run.place for run in runs)))
        for run in runs:
            part, name = Results(), run.name
            if len(names) > 1:  # runs of one command have folders of one name
                name = f"{names[run.place]}/{run.name}" if run.whole or run.beside else names[run.place]
            read_folder(run, name, part, faults, run.whole is not None)
            parts.append((run, part))
    except NoSchema as error:
        raise BadResults([str(error)]) from error
    if faults:
        raise BadResults(faults)
    if any(part.strain for _, part in parts):
        for run, part in parts:  # a homogenized cell beside its study lacks nothing
            if run.command == "homogenize":
                part.missing = [m for m in part.missing if m["what"] not in OF_STRAIN]
    results = merged(parts, Results, Cell)
    results.missing += missing
    return results


def cell_side(results, name):
    """Side of a cell [m], sqrt(|Y|); None where nothing tells it."""
    cell = results.cells.get(name)
    if cell is not None and cell.side:
        return cell.side
    sides = [
        row["error_mean_m"] / row["error_mean_per_cell"]
        for row in results.reached(name)
        if row["error_mean_per_cell"] > 0
    ]
    return float(numpy.median(sides)) if sides else None


__all__ = ["BadResults", "Results", "cell_side", "read_fields", "read_results"]
