# SPDX-License-Identifier: MIT
"""Reads limits.csv and stress.csv of `homespun stress`."""
from dataclasses import dataclass, field

from read.stored import read_csv

AGAIN = "Run `homespun stress` again."


@dataclass
class Stress:
    """The axes of one folder, rows of limits.csv, and their values, rows of stress.csv."""

    folder: str
    name: str
    rows: list = field(default_factory=list)
    values: list = field(default_factory=list)


def read_stress(folder, name, path, path_of, faults, missing):
    """@return Stress, whose rows are in the order of the file"""
    rows = read_csv(path, faults, missing, AGAIN)
    if not rows:
        missing.append({"what": f"stability map of {name}", "why": f"{path} has no complete row"})
    values = path_of("stress.csv", f"values of the stability map of {name}")
    return Stress(folder, name, rows, read_csv(values, faults, missing, AGAIN) if values else [])
