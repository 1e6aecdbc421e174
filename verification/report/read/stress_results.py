# SPDX-License-Identifier: MIT
"""Reads stress.csv and solver.csv of `homespun stress`."""
from dataclasses import dataclass, field

from read.stored import read_csv

AGAIN = "Run `homespun stress` again."


@dataclass
class Stress:
    """The cases of one folder, rows of stress.csv, and of solver.csv where it is there."""

    folder: str
    name: str
    rows: list = field(default_factory=list)
    solver: list = field(default_factory=list)


def read_stress(folder, name, path, path_of, faults, missing):
    """@return Stress, whose rows are in the order of the file"""
    rows = read_csv(path, faults, missing, AGAIN)
    faults += [
        f"{path}, line {row['line']}: `verdict` is empty. {AGAIN}"
        for row in rows
        if not row["verdict"]
    ]
    if not rows:
        missing.append({"what": f"stress cases of {name}", "why": f"{path} has no complete row"})
    solver = path_of("solver.csv", f"iterations of the solver of {name}")
    return Stress(folder, name, rows, read_csv(solver, faults, missing, AGAIN) if solver else [])
