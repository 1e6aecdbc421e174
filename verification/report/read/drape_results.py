# SPDX-License-Identifier: MIT
"""Reads what `homespun drape` writes: one scene, its cells, each with its runs of the coarse cloth
and references.
"""
import math
import os
from dataclasses import dataclass, field

import numpy

from read.stored import is_stiffness, lies_within, read_csv, read_json
from read.vtu import BadFrame, read_pvd

AGAIN = "Run `homespun drape` again."
NUMBERS = {
    "frames",
    "steps",
    "cut_steps",
    "seconds_per_coarse_step",
    "seconds_per_coarse_step_mean",
    "seconds_per_coarse_step_95",
    "factorizations_per_step",
    "seconds_per_upsampling",
    "threads",
    "ranks",
    # Of cells, runs and references in drape.json.
    "dofs",
    "seconds_per_step",
    "cell_side_m",
    "areal_density",
}


def reference_member(name):
    """What a reference is called among the cloths of a cell, since a coarse cloth may have its law."""
    return f"reference {name}"


@dataclass
class DrapedCell:
    """One cell in a scene. `runs` and `references` are objects of drape.json; rows are those of
    this cell, those of motion and held with the `member` whose cloth it is: the variant, or
    reference_member().
    """

    name: str
    info: dict = field(default_factory=dict)
    runs: list = field(default_factory=list)
    references: list = field(default_factory=list)
    errors: list = field(default_factory=list)
    motion: list = field(default_factory=list)
    held: list = field(default_factory=list)
    terms: list = field(default_factory=list)
    # (member, "coarse" or "fine") -> [(time, path)].
    frames: dict = field(default_factory=dict)
    lists: list = field(default_factory=list)  # paths of the .pvd files that exist


@dataclass
class Drape:
    """One scene."""

    folder: str
    info: dict
    cells: list = field(default_factory=list)
    obstacles: str = None  # path of the bodies that the cloth meets

    @property
    def scene(self):
        return self.info["scene"]

    def parameters(self):
        """[(key, value)], keys of inner objects joined by a slash."""
        return list(flat(self.info.get("parameters") or {}))

    def gravity(self):
        """Acceleration (3) [m/s^2], or None where no parameter is called gravity."""
        for key, value in self.parameters():
            if "gravity" in key.rsplit("/", 1)[-1].lower():
                if isinstance(value, str):
                    value = value.replace(",", " ").replace(";", " ").split()
                try:
                    array = numpy.array(value, dtype=float).reshape(-1)
                except (TypeError, ValueError):
                    continue
                array = numpy.array([0.0, 0.0, -abs(array[0])]) if array.size == 1 else array
                if array.shape == (3,) and numpy.isfinite(array).all():
                    return array
        return None

    def up(self):
        """Unit vector against gravity; the third axis where there is none."""
        gravity = self.gravity()
        size = 0.0 if gravity is None else float(numpy.linalg.norm(gravity))
        return -gravity / size if size > 0.0 else numpy.array([0.0, 0.0, 1.0])


def flat(parameters, prefix=""):
    for key, value in parameters.items():
        if isinstance(value, dict):
            yield from flat(value, f"{prefix}{key}/")
        else:
            yield f"{prefix}{key}", value


def is_number(value):
    """Finite and not true or false, which Python takes for numbers."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def check_list(value, key, needed, where, faults):
    """The list of objects under a key, each with its needed texts; [] where it is absent or
    damaged.
    """
    items = value.get(key)
    if items is None:
        return []
    if not isinstance(items, list) or not all(isinstance(item, dict) for item in items):
        faults.append(f"{where}: key `{key}` is not a list of objects. {AGAIN}")
        return []
    for i, item in enumerate(items):
        for name in needed:
            if not isinstance(item.get(name), str) or not item[name]:
                faults.append(
                    f"{where}: {key}[{i}] has `{name}` = `{item.get(name)}`, expected a text."
                    f" {AGAIN}"
                )
                return []
        for name, number in item.items():
            if name in NUMBERS and number is not None and not is_number(number):
                faults.append(
                    f"{where}: {key}[{i}] has `{name}` = `{number}`, expected a number. {AGAIN}"
                )
                return []
    return items


def check_scene(value, path, faults):
    """drape.json with the types the report relies on, or None."""
    before = len(faults)
    if not isinstance(value.get("scene"), str) or not value["scene"]:
        faults.append(
            f"{path}: key `scene` is `{value.get('scene')}`, expected the name of the scene."
            f" {AGAIN}"
        )
    kinds = {
        "story": str,
        "command": str,
        "integrator": str,
        "provenance": dict,
        "parameters": dict,
    }
    for key, kind in kinds.items():
        if value.get(key) is not None and not isinstance(value[key], kind):
            faults.append(
                f"{path}: key `{key}` is a {type(value[key]).__name__}, expected "
                f"{'a text' if kind is str else 'an object'}. {AGAIN}"
            )
    for key in ("time_step_s", "duration_s", "coarse_triangles", "fine_triangles", "fine_vertices"):
        number = value.get(key)
        if number is not None and not (is_number(number) and number > 0):
            faults.append(
                f"{path}: key `{key}` is `{number}`, expected a number above zero. {AGAIN}"
            )
    for term in check_list(value, "terms", ("name",), path, faults):
        if not isinstance(term.get("present"), bool):
            faults.append(
                f"{path}: term `{term['name']}` has `present` = `{term.get('present')}`, expected"
                f" true or false. {AGAIN}"
            )
    for cell in check_list(value, "cells", ("cell",), path, faults):
        where = f"{path}: cell `{cell['cell']}`"
        phases = cell.get("phases")
        if phases is not None and not (
            isinstance(phases, list) and all(isinstance(name, str) for name in phases)
        ):
            faults.append(f"{where}: key `phases` is not a list of names. {AGAIN}")
        check_list(cell, "runs", ("variant", "folder"), where, faults)
        check_list(cell, "references", ("reference", "folder"), where, faults)
        if cell.get("C") is not None and not is_stiffness(cell["C"]):
            faults.append(f"{where}: key `C` is not a 3 x 3 matrix of finite numbers. {AGAIN}")
    return value if len(faults) == before else None


def read_drape(run, path_of, faults, missing):
    """Reads what a run of `homespun drape` wrote.

    @param path_of function (name, consequence) -> path, which notes what is absent
    @return Drape, or None where its description is left out or wrong
    """
    if not (path := path_of("drape.json", f"the scene of {run.name}")):
        return None
    value = read_json(path, faults)
    info = check_scene(value, path, faults) if value else None
    if info is None:
        return None
    drape = Drape(run.folder, info)
    if run.holds("obstacles.vtu"):
        drape.obstacles = path_of("obstacles.vtu", f"{drape.scene}: bodies")
    cells = {}
    for item in info.get("cells") or []:
        cells[item["cell"]] = DrapedCell(
            item["cell"], item, item.get("runs") or [], item.get("references") or []
        )
    for name, target, consequence in (
        ("drape.csv", "errors", "error against time"),
        ("motion.csv", "motion", "height, energies and forces of what is held"),
        ("terms.csv", "terms", "what absent terms would have cost"),
    ):
        if file := path_of(name, f"{drape.scene}: {consequence}"):
            for row in read_csv(file, faults, missing, AGAIN):
                if "cloth" in row:
                    is_coarse = row["cloth"] == "coarse"
                    row["member"] = row["variant"] if is_coarse else reference_member(row["variant"])
                of = "held" if row.get("place") else target
                getattr(cells.setdefault(row["cell"], DrapedCell(row["cell"])), of).append(row)
    drape.cells = list(cells.values())
    for cell in drape.cells:
        read_frame_lists(run, drape, cell, path_of, faults)
    return drape


def read_frame_lists(run, drape, cell, path_of, faults):
    """Finds the frames of all runs and references of a cell, those that were not changed since."""
    wanted = [
        (one["variant"], one["folder"], kind) for one in cell.runs for kind in ("coarse", "fine")
    ]
    wanted += [
        (reference_member(one["reference"]), one["folder"], "fine") for one in cell.references
    ]
    for name, folder, kind in wanted:
        what = f"{drape.scene}, {cell.name}: {kind} frames of {name}"
        path = os.path.join(drape.folder, folder, kind + ".pvd")
        if not lies_within(path, drape.folder):
            faults.append(
                f"{drape.scene}, {cell.name}: folder `{folder}` of {name} lies outside of"
                f" {drape.folder}; expected one in it. {AGAIN}"
            )
            continue
        if not (path := path_of(os.path.join(folder, kind + ".pvd"), what)):
            continue
        try:
            frames = [
                (time, path_of(os.path.relpath(frame, run.folder), what))
                for time, frame in read_pvd(path)
            ]
            if frames := [(time, frame) for time, frame in frames if frame]:
                cell.frames[name, kind] = frames
                cell.lists.append(path)
        except BadFrame as error:
            faults.append(str(error))
