# SPDX-License-Identifier: MIT
"""Several runs on one page: parts of one `homespun verify` belong together, a cell in two runs is
two versions.

Versions are named after their folders. The C^H of one run never stands beside the errors of
another, unless both are parts of one verify, or of one cell by one revision (runs.py).
"""
import dataclasses
import os

TABLES = (
    "strain", "forces", "uncertainty", "energies", "steps", "budget", "run_time", "validity", "gains"
)


@dataclasses.dataclass
class Subject:
    """One column of a comparison: a cell in one version."""

    name: str  # as the page calls it
    cell: str  # as its results call it
    place: str  # folder of the version, after which it is named


def tags(places):
    """place -> the shortest name that tells it from the others: common ends and beginnings are left
    out.
    """
    if not places:
        return {}
    split = {place: place.strip(os.sep).split(os.sep) for place in places}
    while (
        len(split) > 1
        and len({parts[-1] for parts in split.values()}) == 1
        and min(map(len, split.values())) > 1
    ):
        split = {place: parts[:-1] for place, parts in split.items()}
    last = [parts[-1] for parts in split.values()]
    if len(set(last)) == len(last):
        return {place: parts[-1] for place, parts in split.items()}
    common = os.path.commonpath([os.sep.join(parts) for parts in split.values()])
    return {
        place: os.path.relpath(os.sep.join(parts), common or os.curdir)
        for place, parts in split.items()
    }


def joined(one, other):
    """A cell with what either of two knows, the first first; where both know a stiffness, that of
    the second stands among the others.
    """
    if one.homogenize and other.homogenize:
        one.others.append((other.command, other.homogenize))
    values = {f.name: getattr(one, f.name) for f in dataclasses.fields(one)}
    for name, value in values.items():
        if value is None or (isinstance(value, (str, list)) and not value):
            values[name] = getattr(other, name)
    return type(one)(**values)


def merged(parts, make_results, make_cell):
    """The parts, one per run, as one Results; rows name their cell as the page does.

    @param parts [(Run, Results)]
    @param make_results, make_cell the types, empty or with a name
    """
    whole, subjects = make_results(), {}
    for run, part in parts:
        for attribute in (
            "studies", "drapes", "stress", "convergence", "loads", "stability", "bends", "missing"
        ):
            getattr(whole, attribute).extend(getattr(part, attribute))
        for name in [*part.cells, *(row["cell"] for row in part.strain)]:
            subjects.setdefault((run.place, name), Subject(name, name, run.place))
    for name in {cell for _, cell in subjects}:
        same = [s for s in subjects.values() if s.cell == name]
        if len(same) > 1:
            known = tags([s.place for s in same])
            for subject in same:
                subject.name = f"{name} ({known[subject.place]})"
    for run, part in parts:
        for name, cell in part.cells.items():
            cell.name = subjects[run.place, name].name
            there = whole.cells.get(cell.name)
            whole.cells[cell.name] = joined(there, cell) if there else cell
        for table in TABLES:
            for row in getattr(part, table):
                subject = subjects.get((run.place, row["cell"]))
                getattr(whole, table).append(
                    {**row, "cell": subject.name if subject else row["cell"]}
                )
    for row in whole.strain:
        whole.cells.setdefault(row["cell"], make_cell(row["cell"]))
    for cell in whole.cells.values():
        if not cell.field_files:
            whole.missing.append(
                {
                    "what": f"{cell.name}: pictures of the sheet",
                    "why": "no run of it stored a fields-LOAD.h5",
                }
            )
    whole.subjects = list(subjects.values())
    return whole
