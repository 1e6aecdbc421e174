# SPDX-License-Identifier: MIT
"""A folder of results is one run, which run.json describes: a page takes what the run wrote, and
nothing else.

run.json of a run that ended lists its files with size and CRC-32. A file that is not listed is of
another run, one whose checksum differs was changed since: both stay out of the page, which says so.
A run that did not end has no list: its tables are taken, because every row of them was whole when
the next one was begun; of other files nobody knows. A folder below with a run.json of its own is
another run. Those below a `verify` are its parts.
"""
import fnmatch
import os
import zlib
from dataclasses import dataclass, field

from read import schema
from read.stored import lies_within, read_json

LIST = "run.json"
KINDS = {"command": str, "revision": str, "fingerprint": str, "finished": bool}
COMMANDS = "`homespun strain`, `homogenize`, `drape`, `stress`, `converge`, `load`, `stability`, `bend` or `verify`"
# What pages read besides tables; the CSV files of figures have other names.
READ = (
    "study.json",
    "verdicts.json",
    "homogenize.json",
    "cell.json",
    "cell.h5",
    "fields-*.h5",
    "drape.json",
    "*.pvd",
    "obstacles.vtu",
)


@dataclass
class Run:
    """One folder of results."""

    folder: str
    command: str  # "strain"
    revision: str
    fingerprint: str
    finished: bool
    seconds: float  # of work, over all times it was taken up [s]
    files: dict  # name -> {"bytes", "crc32"}; of a run that did not end name -> None
    inputs: dict = field(default_factory=dict)  # name -> what the run was made of
    whole: object = None  # the Run of the `verify` that this one is a part of
    beside: object = None  # of `homogenize` the Run of `strain` on the same cell
    refused: dict = field(default_factory=dict)  # name -> why a file that lies there is not taken
    checked: set = field(default_factory=set)

    @property
    def name(self):
        return os.path.basename(os.path.normpath(os.path.abspath(self.folder)))

    @property
    def place(self):
        """Folder of the version that it belongs to: that of `verify`, of the strain study that it
        stands beside, or its own.
        """
        above = self.whole or self.beside
        return above.place if above else os.path.realpath(self.folder)

    @property
    def cells(self):
        """`cell NAME` -> fingerprint of the cell as it was read."""
        return {key: value for key, value in self.inputs.items() if key.startswith("cell ")}

    def path(self, name):
        return os.path.join(self.folder, name)

    def holds(self, *names):
        """Whether any file is of this run, changed since or not."""
        return any(name in self.files for name in names)

    def take(self, name):
        """(path, "") of a file of this run, or (None, why it is left out)."""
        path = self.path(name)
        if why := self.refused.get(name) or self.fault_of(name, path):
            if os.path.exists(path):
                self.refused[name] = why
            return None, why
        self.checked.add(name)
        return path, ""

    def fault_of(self, name, path):
        """Why a file is not one that this run wrote; empty where it is."""
        if name in self.checked:
            return ""
        if not os.path.isfile(path):
            return f"{path} does not exist" + (
                f", though {LIST} lists it" if self.files.get(name) else ""
            )
        if not lies_within(path, self.folder):
            return f"{path} lies outside of its folder"
        if not self.finished:
            return (
                ""
                if is_table(name)
                else (
                    f"the run of {self.folder} did not end, and only its tables are known to be"
                    " whole"
                )
            )
        if name not in self.files:
            return f"{path} is not in {LIST}: it is of another run"
        try:
            is_same = is_listed_as(path, self.files[name])
        except OSError as error:
            return f"{path} cannot be read ({error.strerror})"
        if not is_same:
            return (
                f"{path} was changed after the run ended: its size or checksum is not that of"
                f" {LIST}"
            )
        return ""

    def names(self, pattern):
        """Files of this run in their order."""
        return sorted(fnmatch.filter(self.files, pattern))

    def look_for_strays(self):
        """Finds what lies there, could be shown, and is of no run that is told here."""
        for name in files_below(self.folder):
            if name not in self.files and is_read(name):
                self.take(name)

    def left_out(self):
        """{"what", "why"} of the files that lie there and were not taken."""
        return [{"what": name, "why": why} for name, why in sorted(self.refused.items())]


def is_table(name):
    return name.endswith((".csv", ".json"))


def is_unknown_table(name):
    """Whether a file of a run is a table that this version does not have."""
    return name.endswith(".csv") and not os.path.dirname(name) and name not in schema.tables()


def is_read(name):
    """Whether a file of this name would stand in a page."""
    if os.path.dirname(name) == "figures":
        return False
    last = os.path.basename(name)
    return last in schema.tables() or any(fnmatch.fnmatch(last, pattern) for pattern in READ)


def is_listed_as(path, listed):
    """Whether size and checksum of a file are those of its entry."""
    if not isinstance(listed, dict) or os.path.getsize(path) != listed.get("bytes"):
        return False
    checksum = 0
    with open(path, "rb") as file:
        while block := file.read(1 << 20):
            checksum = zlib.crc32(block, checksum)
    return f"{checksum:08x}" == listed.get("crc32")


def files_below(folder):
    """Names of the files of a folder and those below, but for what is a run of its own."""
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(
            name for name in folders if not os.path.isfile(os.path.join(place, name, LIST))
        )
        yield from (
            os.path.relpath(os.path.join(place, name), folder)
            for name in sorted(names)
            if name != LIST
        )


def runs_below(folder):
    """Folders with a run of their own, two levels deep (cells/NAME lies there), in their order."""
    found = []
    for place, folders, _ in os.walk(folder):
        here = [name for name in sorted(folders) if os.path.isfile(os.path.join(place, name, LIST))]
        found += [os.path.join(place, name) for name in here]
        deeper = place == folder
        folders[:] = sorted(set(folders).difference(here)) if deeper else []
    return sorted(found)


def read_run(folder, faults):
    """Run of a folder, or None with a fault."""
    if not os.path.isdir(folder):
        faults.append(f"{folder}: no such folder. Give the --output folder of {COMMANDS}.")
        return None
    path = os.path.join(folder, LIST)
    if not os.path.isfile(path):
        inside = [os.path.relpath(one, folder) for one in runs_below(folder)]
        advice = (
            f"It holds the runs {', '.join(inside[:5])}{' and more' if len(inside) > 5 else ''}:"
            " give those."
            if inside
            else (
                f"Give the --output folder of {COMMANDS}, or run the study again: results of other"
                " versions cannot be read."
            )
        )
        faults.append(
            f"{folder}: is not a folder of results of this version: it holds no {LIST}. {advice}"
        )
        return None
    value = read_json(path, faults)
    if value is None:
        return None
    wrong = [key for key, kind in KINDS.items() if not isinstance(value.get(key), kind)]
    if value.get("finished") is True and not isinstance(value.get("files"), dict):
        wrong.append("files")
    if wrong:
        faults.append(
            f"{path}: key `{wrong[0]}` is `{value.get(wrong[0])}`, expected what homespun writes"
            " there. Run the study again with --overwrite."
        )
        return None
    files = value["files"] if value["finished"] else dict.fromkeys(files_below(folder))
    if unknown := [name for name in sorted(files) if is_unknown_table(name)]:
        faults.append(
            f"{folder}: holds {unknown[0]}, which no homespun of this version writes: the one of"
            f" revision {value['revision']} did; read it with that one, or run the study again with"
            " --overwrite."
        )
        return None
    seconds = value.get("seconds")
    return Run(
        folder,
        value["command"],
        value["revision"],
        value["fingerprint"],
        value["finished"],
        float(seconds) if isinstance(seconds, (int, float)) else float("nan"),
        files,
        value["inputs"] if isinstance(value.get("inputs"), dict) else {},
    )


def are_of_one_cell(homogenized, strained):
    """Whether a run of `homogenize` is of a cell of a run of `strain`, as one revision read it."""
    one, other = homogenized.cells, strained.cells
    return (
        (homogenized.command, strained.command) == ("homogenize", "strain")
        and homogenized.finished
        and homogenized.revision == strained.revision
        and bool(one)
        and one.items() <= other.items()
    )


def with_homogenized(runs):
    """The runs, and behind each of `strain` that of `homogenize` in the folder beside it where that
    is of the same cell; one that was given itself stands beside the study, too.
    """
    result = list(runs)
    for run in [run for run in runs if run.command == "strain" and not run.whole]:
        known = [one for one in runs if are_of_one_cell(one, run) and not one.whole]
        for one in known:
            one.beside = one.beside or run
        folder = os.path.join(os.path.dirname(os.path.abspath(run.folder)), "homogenize")
        if not known and os.path.isfile(os.path.join(folder, LIST)):
            found = read_run(folder, [])
            if found and are_of_one_cell(found, run):
                found.beside = run
                result.insert(result.index(run) + 1, found)
    return result


def with_parts(folders, faults, missing):
    """The runs of folders, each once, that of a `verify` followed by its parts where none of them
    is given by itself.
    """
    runs = {}
    for folder in folders:
        path = os.path.realpath(folder)
        if path not in runs and (run := read_run(folder, faults)):
            runs[path] = run
    result = []
    for path, run in runs.items():
        result.append(run)
        if run.command != "verify":
            continue
        inside = [other for place, other in runs.items() if place.startswith(path + os.sep)]
        found = inside or [
            part for part in (read_run(folder, faults) for folder in runs_below(run.folder)) if part
        ]
        for part in found:
            part.whole = run
        result += [part for part in found if part not in inside]
    for part in [run for run in result if run.whole and run.revision != run.whole.revision]:
        missing.append(
            {
                "what": part.folder,
                "why": (
                    f"it is a run of revision {part.revision}, the verify of {part.whole.revision}"
                ),
            }
        )
        result.remove(part)
    return with_homogenized(result)
