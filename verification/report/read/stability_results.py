# SPDX-License-Identifier: MIT
"""Reads stability.csv of `homespun periodic stability`: Bloch margins along loads of an infinite
cloth, where they are lost, and by which wave.
"""
from dataclasses import dataclass, field

from read.cell_results import read_cell
from read.stored import read_csv

AGAIN = "Run `homespun periodic stability` again."
ROWS_OF_KIND = {
    "level": "levels",
    "loss": "losses",
    "wave": "waves",
    "pattern": "patterns",
    "mode": "mode",
}


@dataclass
class StabilityPath:
    """One load of one cell under one law; rows of the table, pressed and pulled, by their
    kind.
    """

    cell: str
    law: str
    load: str
    levels: list = field(default_factory=list)  # ascending strains
    losses: list = field(default_factory=list)
    waves: list = field(default_factory=list)
    mode: list = field(default_factory=list)
    patterns: list = field(default_factory=list)

    def of_mesh(self, mesh):
        return [row for row in self.levels if row["mesh"] == mesh and row["outcome"] != "not-reached"]

    def loss(self, way, mesh="given"):
        for row in self.losses:
            if (row["way"], row["mesh"]) == (way, mesh):
                return row
        return None

    def ways(self):
        return list(dict.fromkeys(row["way"] for row in self.losses))


@dataclass
class StabilityRun:
    """What one folder holds."""

    folder: str
    name: str
    paths: list = field(default_factory=list)
    cells: dict = field(default_factory=dict)  # name -> Cell, for pictures of modes

    def names(self):
        return list(dict.fromkeys(path.cell for path in self.paths))

    def of(self, cell):
        return [path for path in self.paths if path.cell == cell]


def read_stability(run, name, path_of, faults, missing, cell_folders):
    """@param cell_folders name -> folder of a cell in that of the run
    @return StabilityRun
    """
    result = StabilityRun(run.folder, name)
    found = {}
    if path := path_of("stability.csv", f"margins of {name}"):
        for row in read_csv(path, faults, missing, AGAIN):
            names = (row["cell"], row["law"], row["load"])
            of_path = found.setdefault(names, StabilityPath(*names))
            if kept := ROWS_OF_KIND.get(row["kind"]):
                getattr(of_path, kept).append(row)
            else:
                faults.append(
                    f"{path}, line {row['line']}: `kind` is `{row['kind']}`, expected"
                    f" {', '.join(ROWS_OF_KIND)}. {AGAIN}"
                )
    for path in found.values():
        path.levels.sort(key=lambda row: row["strain"])
    result.paths = list(found.values())
    for cell, inner in cell_folders.items():
        result.cells[cell] = read_cell(cell, run, inner, faults, missing)
    return result
