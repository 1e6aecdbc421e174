# SPDX-License-Identifier: MIT
"""Reads load.csv of `homespun periodic load`: paths of an infinite cloth under given stresses and strains,
and curves that somebody measured.
"""
from dataclasses import dataclass, field

from read.stored import read_csv

AGAIN = "Run `homespun periodic load` again."
COMPONENTS = ("11", "22", "12")


@dataclass
class Path:
    """Levels of one cell under one law; rows of load.csv in the order of the steps."""

    cell: str
    law: str
    method: str  # resolved, coarse
    rows: list = field(default_factory=list)

    def column(self, key):
        return [row[key] for row in self.rows]


@dataclass
class LoadRun:
    """What one folder holds."""

    folder: str
    name: str
    control: str  # what is prescribed, in words
    paths: list = field(default_factory=list)
    measured: dict = field(default_factory=dict)  # curve -> rows

    def cells(self):
        return list(dict.fromkeys(path.cell for path in self.paths))

    def of(self, cell):
        return [path for path in self.paths if path.cell == cell]


def read_load(run, name, path_of, info, faults, missing):
    """@param info study.json
    @return LoadRun
    """
    result = LoadRun(run.folder, name, str(info.get("control") or ""))
    found = {}
    if path := path_of("load.csv", f"curves of {name}"):
        for row in read_csv(path, faults, missing, AGAIN):
            if row["method"] == "measured":
                result.measured.setdefault(row["cell"], []).append(row)
                continue
            key = (row["cell"], row["law"], row["method"])
            found.setdefault(key, Path(*key)).rows.append(row)
    for one in found.values():
        one.rows.sort(key=lambda row: row["step"])
    result.paths = list(found.values())
    return result
