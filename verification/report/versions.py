# SPDX-License-Identifier: MIT
"""Several result folders as one: parts of one `homespun verify` belong together, a cell studied twice is two versions.

A folder of `verify` stands for its parts. Of a cell that was only homogenized in one folder and strained in another the
two are one, named after the strained one; where both folders hold the same kind of result they are versions, each named
after its folder: the C^H of one study must not stand beside the errors of another.
"""
import dataclasses
import os

RESULTS = ("strain.csv", "homogenize.json", "drape.json", "stress.csv", "converge.csv")
TABLES = ("strain", "uncertainty", "steps", "budget", "run_time", "validity")


@dataclasses.dataclass
class Subject:
    """One column of a comparison: a cell in one version."""
    name: str   # as the page calls it
    cell: str   # as its results call it
    place: str  # folder of the version, after which it is named
    strained: bool = False
    homogenized: bool = False
    places: set = dataclasses.field(default_factory=set)  # of all that joined

    def __post_init__(self):
        self.places.add(self.place)

    def join(self, place, strained, homogenized):
        """Takes in what a folder knows of this cell; errors are what a version is about, so that theirs names it."""
        if strained and not self.strained:
            self.place = place
        self.strained |= strained
        self.homogenized |= homogenized
        self.places.add(place)

    def completes(self, strained, homogenized):
        """Whether one was strained, the other was not, and no more than one of them has a C^H."""
        return self.strained != strained and not (self.homogenized and homogenized)


def holds_results(folder):
    return any(os.path.isfile(os.path.join(folder, name)) for name in RESULTS)


def lists_all(folder):
    """Whether a folder is that of a `verify`: the claims of every part, and no result of its own."""
    return os.path.isfile(os.path.join(folder, "verdicts.json")) and not holds_results(folder)


def is_inside(folder, other):
    return os.path.realpath(folder).startswith(os.path.realpath(other) + os.sep)


def parts_of(folder):
    """Folders with results inside that of a `verify`, two levels deep (cells/NAME lies there), in their order."""
    if not lists_all(folder):
        return []
    found = []
    for name in sorted(os.listdir(folder)):
        inner = os.path.join(folder, name)
        if not os.path.isdir(inner):
            continue
        if holds_results(inner):
            found.append(inner)
        else:
            found += [os.path.join(inner, deep) for deep in sorted(os.listdir(inner)) if holds_results(os.path.join(inner, deep))]
    return found


def with_parts(folders):
    """The folders, each once, that of a `verify` followed by its parts where none of them is given by itself."""
    given = list(dict.fromkeys(os.path.realpath(folder) for folder in folders))
    named = {os.path.realpath(folder): folder for folder in reversed(folders)}
    result = []
    for path in given:
        result.append(named[path])
        inside = [other for other in given if other.startswith(path + os.sep)]
        if not inside and os.path.isdir(path):
            result += parts_of(named[path])
    return list(dict.fromkeys(result))


def place_of(folder, folders):
    """The folder of `verify` that holds a folder, or the folder itself."""
    holding = [other for other in folders if is_inside(folder, other)]
    return os.path.realpath(min(holding, key=len) if holding else folder)


def tags(places):
    """place -> the shortest name that tells it from the others: common ends and beginnings are left out."""
    split = {place: place.strip(os.sep).split(os.sep) for place in places}
    while len(split) > 1 and len({parts[-1] for parts in split.values()}) == 1 and min(map(len, split.values())) > 1:
        split = {place: parts[:-1] for place, parts in split.items()}
    last = [parts[-1] for parts in split.values()]
    if len(set(last)) == len(last):
        return {place: parts[-1] for place, parts in split.items()}
    common = os.path.commonpath([os.sep.join(parts) for parts in split.values()])
    return {place: os.path.relpath(os.sep.join(parts), common or os.curdir) for place, parts in split.items()}


def joined(one, other):
    """A cell with what either of two knows, the first first."""
    values = {f.name: getattr(one, f.name) for f in dataclasses.fields(one)}
    for name, value in values.items():
        if value is None or (isinstance(value, (str, list)) and not value):
            values[name] = getattr(other, name)
    return type(one)(**values)


def merged(parts, folders, make_results, make_cell):
    """The parts, one per folder, as one Results; rows name their cell as the page does.

    @param parts [(folder, Results)]
    @param make_results, make_cell the types, empty or with a name
    """
    whole, subjects, owner = make_results(), [], {}
    roots = {os.path.realpath(folder) for folder in folders if parts_of(folder)}
    for folder, part in parts:
        for attribute in ("studies", "drapes", "stress", "convergence", "missing"):
            getattr(whole, attribute).extend(getattr(part, attribute))
        strained = {row["cell"] for row in part.strain}
        place = place_of(folder, folders)
        for name in dict.fromkeys(list(part.cells) + [row["cell"] for row in part.strain]):
            known = name in strained, name in part.cells and part.cells[name].homogenize is not None
            same = [s for s in subjects if s.cell == name]
            subject = next((s for s in same if place in s.places), None) or next(
                (s for s in same if s.completes(*known) and not within(s.place, place, roots)), None)
            if subject is None:
                subject = Subject(name, name, place)
                subjects.append(subject)
            subject.join(place, *known)
            owner[folder, name] = subject
    for name in {s.cell for s in subjects}:
        same = [s for s in subjects if s.cell == name]
        if len(same) > 1:
            known = tags([s.place for s in same])
            for subject in same:
                subject.name = f"{name} ({known[subject.place]})"
    for folder, part in parts:
        for name, cell in part.cells.items():
            subject = owner[folder, name]
            there = whole.cells.get(subject.name)
            cell.name = subject.name
            whole.cells[subject.name] = joined(there, cell) if there else cell
            if there:  # what one of two folders of a cell lacks is no loss where the other has it
                lost = [f"{os.path.join(one.folder, 'fields-LOAD.h5')} does not exist" for one in (there, cell)]
                if there.field_files or cell.field_files:
                    whole.missing = [m for m in whole.missing if m["why"] not in lost]
        for table in TABLES:
            for row in getattr(part, table):
                subject = owner.get((folder, row["cell"]))
                getattr(whole, table).append({**row, "cell": subject.name if subject else row["cell"]})
    for row in whole.strain:
        whole.cells.setdefault(row["cell"], make_cell(row["cell"]))
    whole.subjects = [s for s in subjects if s.name in whole.cells]
    return whole


def within(one, other, roots):
    """Whether either place is a folder of `verify`, whose parts belong to it alone."""
    return one in roots or other in roots
