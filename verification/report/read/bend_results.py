# SPDX-License-Identifier: MIT
"""Reads `homespun bend`: errors of an up-sampled sheet that bends, by load, reference, curvature and
method, what terms of edges and the deflection of the cell gain, and where a sheet wrinkles.
"""
import math
from dataclasses import dataclass, field

from read.cell_results import read_cell
from read.schema import main_reference
from read.stored import read_csv

AGAIN = "Run `homespun bend` again."
SHOWN = 0.1  # curvature x cell side that a page speaks of: a roll of ten cell sides
LINEAR = "linear"
# Errors below this, in their size, are what solvers leave: bent_to of verification/bend.
SOLVED = 1e-7


@dataclass(frozen=True)
class Quantity:
    """What errs: the position, or the normal."""

    name: str
    columns: str
    power: int  # of the cell side in the size of its fluctuation, k x side^power

    def of(self, row, what="mean"):
        return row[self.columns.format(what)]

    def size(self, row):
        """Of the fluctuation [m, rad], with k the curvature that the load makes in linear theory."""
        return row["curvature_times_cell"] * row["cell_side_m"] ** (self.power - 1)

    def relative(self, row, what="mean"):
        return self.of(row, what) / self.size(row)


POSITION = Quantity("position", "error_{}_m", 2)
NORMAL = Quantity("normal", "normal_error_{}_rad", 1)


def radius_of(row):
    """That the load bends to in linear theory [m]."""
    return row["cell_side_m"] / row["curvature_times_cell"]


@dataclass
class Bent:
    """A sheet of one cell under one load, reference and curvature."""

    load: str
    rows: dict  # method -> row of bend.csv

    def known(self, method, what):
        row = self.rows.get(method)
        return row is not None and math.isfinite(what.of(row))

    def base(self, what):
        """The better of the methods without the deflection of the cell, None where there is none."""
        some = [name for name in ("affine", "affine+edges") if self.known(name, what)]
        return min(some, key=lambda name: what.of(self.rows[name])) if some else None

    def best(self):
        """The method with all that is known of the cell."""
        return "full" if "full" in self.rows else "localized"

    def gain(self, what, method, other):
        """@return Gain of `method` over `other`, None where one of them is not known"""
        if other is None or not (self.known(method, what) and self.known(other, what)):
            return None
        one, than = self.rows[method], self.rows[other]
        errors = [what.of(row) for row in (than, one)]
        bars = [what.of(row, "bar") for row in (than, one)]
        factor = errors[0] / errors[1] if errors[1] > 0 else math.inf
        return Gain(self.load, factor, state_of(errors, bars, SOLVED * what.size(one)))


@dataclass
class Gain:
    """An error over that of a method with more in it."""

    load: str
    factor: float
    state: str  # smaller or larger: by more than the bars of both; same, unknown, none


def state_of(errors, bars, round_off):
    """Which of two errors, other and one, is smaller, as the claims on bending judge it."""
    if errors[0] <= round_off:
        return "none"
    if not all(map(math.isfinite, bars)):
        return "unknown"
    if abs(errors[0] - errors[1]) <= sum(bars):
        return "same"
    return "smaller" if errors[1] < errors[0] else "larger"


@dataclass
class BendRun:
    """What one folder holds."""

    folder: str
    name: str
    rows: list = field(default_factory=list)
    wrinkles: list = field(default_factory=list)  # rows of wrinkles.csv
    cells: dict = field(default_factory=dict)  # name -> Cell

    def names(self):
        return list(dict.fromkeys(row["cell"] for row in self.rows))

    def of(self, cell, reference=None):
        return [
            row for row in self.rows if row["cell"] == cell and reference in (None, row["reference"])
        ]

    def references(self, cell):
        """The one that the page speaks of first."""
        found = list(dict.fromkeys(row["reference"] for row in self.of(cell)))
        first = main_reference(found)
        return sorted(found, key=lambda reference: reference != first)

    def sheets(self, cell, reference):
        """A Bent per load, of the curvature that most loads reached, of those the one nearest to
        SHOWN.
        """
        rows = [row for row in self.of(cell, reference) if math.isfinite(row["error_mean_m"])]
        of_level = {}
        for row in rows:
            loads = of_level.setdefault(row["curvature_times_cell"], {})
            loads.setdefault(row["load"], {})[row["method"]] = row
        level = max(
            of_level,
            key=lambda bending: (len(of_level[bending]), -abs(math.log(bending / SHOWN))),
            default=None,
        )
        return [Bent(*one) for one in of_level.get(level, {}).items()]

    def least_radius(self, cell):
        """Radius [m] from which on D^H holds along every direction; None where nothing tells it."""
        known = self.cells.get(cell)
        rolled = ((known.homogenize if known else None) or {}).get("rolled") or {}
        return max(rolled.get("least_radius_m") or [0.0]) or None


def read_bend(run, name, path_of, faults, missing, cell_folders):
    """@param cell_folders name -> folder of a cell in that of the run
    @return BendRun
    """
    result = BendRun(run.folder, name)
    if path := path_of("bend.csv", f"errors of the bent sheets of {name}"):
        result.rows = read_csv(path, faults, missing, AGAIN)
    if path := path_of("wrinkles.csv", f"onset of wrinkles of {name}"):
        result.wrinkles = read_csv(path, faults, missing, AGAIN)
    for cell, inner in cell_folders.items():
        result.cells[cell] = read_cell(cell, run, inner, faults, missing)
    return result
