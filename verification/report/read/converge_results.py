# SPDX-License-Identifier: MIT
"""Reads converge.csv, the series of `homespun converge`: a quantity over levels, with its observed
orders.
"""
import math
from dataclasses import dataclass, field

from read import schema
from read.stored import read_csv

AGAIN = "Run `homespun converge` again."
KEYS = ("cell", "study", "case", "quantity", "order_p", "level")
# Studies whose limits are bands, and the tolerance at both ends.
BAND_TOLERANCES = {"mesh": 0.1, "scale": 0.15, "coarse": 0.1, "edges": 0.1, "bending": 0.1}
STUDIES = ("mesh", "adaptive", "scale", "coarse", "edges", "bending", "strain", "time")


@dataclass
class Series:
    """A quantity over levels, coarse to fine; rows of converge.csv."""

    cell: str
    study: str
    case: str
    quantity: str
    p: int  # order of the elements
    rows: list = field(default_factory=list)

    def column(self, key):
        return [row[key] for row in self.rows]

    @property
    def name(self):
        """The quantity without its unit."""
        return self.quantity.split(" [")[0]

    @property
    def unit(self):
        return self.quantity.split(" [")[1].rstrip("]") if " [" in self.quantity else ""

    def __getattr__(self, key):  # what is the same on every level
        if key in schema.table("converge.csv").names:
            return self.rows[-1][key]
        raise AttributeError(key)

    def errors(self):
        """(h, error) where there is one above zero."""
        pairs = [(row["h"], row["error"]) for row in self.rows if row["error"] > 0]
        return [h for h, _ in pairs], [error for _, error in pairs]

    @property
    def is_band(self):
        """Whether theory allows orders between two, not one."""
        return self.study in BAND_TOLERANCES

    def expected(self):
        """The orders that theory allows: one, or the ends of a band without their tolerance;
        nothing where the series is not judged.
        """
        low, high = self.order_lowest, self.order_highest
        if math.isnan(low):
            return []
        if not self.is_band:
            return [(low + high) / 2]
        tolerance = BAND_TOLERANCES[self.study]
        return sorted({round(low + tolerance, 2), round(high - tolerance, 2)})


@dataclass
class Convergence:
    """The series of one folder."""

    folder: str
    name: str
    series: list = field(default_factory=list)

    def of(self, study, cell=None):
        return [s for s in self.series if s.study == study and cell in (None, s.cell)]

    def cells(self, study):
        return list(dict.fromkeys(s.cell for s in self.of(study)))


def read_convergence(folder, name, path, faults, missing):
    """@return Convergence, whose series are in the order of the file and whose levels run from
    coarse to fine
    """
    rows = [row for row in read_csv(path, faults, missing, AGAIN) if row["kind"] == "level"]
    result = {}
    for row in rows:
        if row["study"] not in STUDIES:
            faults.append(
                f"{path}, line {row['line']}: `study` is `{row['study']}`, expected one of "
                f"{', '.join(STUDIES)}. {AGAIN}"
            )
        least = {"h": 0, "order_p": 0, "level": -1}
        if wrong := [key for key in least if not row[key] > least[key]]:
            faults.append(
                f"{path}, line {row['line']}: `{wrong[0]}` is `{row[wrong[0]]:g}`, expected that of a"
                f" level. {AGAIN}"
            )
            continue
        key = tuple(row[k] for k in KEYS[:-1])
        result.setdefault(key, Series(*key[:4], int(key[4]))).rows.append(row)
    for series in result.values():
        series.rows.sort(key=lambda row: row["level"])
    if not rows:
        missing.append({"what": f"convergence of {name}", "why": f"{path} has no complete row"})
    return Convergence(folder, name, list(result.values()))
