# SPDX-License-Identifier: MIT
"""Strain studies of the program, and methods of one's own held against their references."""
from __future__ import annotations

import csv
import json
import os
import pathlib
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import typing
import warnings

import numpy

from ._light import BadInput, Cell, NotConverged
from .results import results

if typing.TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from numpy.typing import ArrayLike, NDArray

    Key = tuple[str, float, str]
    Method = Callable[[NDArray[numpy.float64]], typing.Any]

T = typing.TypeVar("T")
ENDED = (0, 1, 4)  # a claim that failed or is open is a result
PARTS = ("budget", "runtime")  # of a study, which are made where they are asked for
BESIDE = ("affine", "localized", "full")  # methods whose errors are printed beside one's own
MOST_SECONDS = 10.0  # no further call of a method at a level begins after this long


class Mesh(typing.NamedTuple):
    rest: NDArray[numpy.float64]
    triangles: NDArray[numpy.int32]
    phases: NDArray[numpy.int32]
    coarse_rest: NDArray[numpy.float64]
    coarse_triangles: NDArray[numpy.int32]


class Level(typing.NamedTuple):
    load: str
    strain: float
    law: str


def program() -> str:
    """The program `homespun`: of the same build or installation as this package, else on PATH."""
    here = pathlib.Path(__file__).resolve().parents
    beside = [here[2] / "homespun"] + [folder / "bin" / "homespun" for folder in here[4:5]]
    for path in beside:
        if path.is_file() and os.access(path, os.X_OK):
            return str(path)
    found = shutil.which("homespun")
    if not found:
        raise BadInput("the program homespun is not there; expected it on PATH or as "
                       f"{beside[-1]}: install the package homespun, which studies are made with")
    return os.path.abspath(found)


def _run(words: Sequence[object], shown: typing.TextIO | None,
         folder: str | None = None) -> None:
    """Runs a command of the program; its faults are exceptions.

    shown: where what it says goes while it runs, or None; folder: where it runs, or None
    """
    faults: list[str] = []
    with subprocess.Popen([program(), *map(str, words)], stdout=subprocess.DEVNULL, cwd=folder,
                          stderr=subprocess.PIPE, text=True) as process:
        try:
            for line in process.stderr or ():
                is_progress = re.match(r"\[ *\d+%\]", line)
                if not is_progress:
                    faults.append(line)
                if shown and shown.isatty():
                    line = "\r\033[K" + (line.rstrip("\n") if is_progress else line)
                if shown:
                    print(line, end="", file=shown, flush=True)
        except BaseException:
            process.terminate()
            raise
    if shown and shown.isatty():
        print("\r\033[K", end="", file=shown, flush=True)
    if process.returncode < 0:
        name = signal.strsignal(-process.returncode)
        why = ": is there enough memory?" if process.returncode == -signal.SIGKILL else ""
        raise RuntimeError("\n".join([
            f"homespun {words[0]} was killed by signal {-process.returncode} ({name}){why}",
            *(line.rstrip() for line in faults)]))
    if process.returncode not in ENDED:
        kind = {2: BadInput, 3: NotConverged}.get(process.returncode, RuntimeError)
        said = re.split(r"(?m)^homespun: ", "".join(faults))  # in front of it stand notes
        raise kind(re.sub("(?m)^--(?=name: )", "", "\n".join(said[1:])).strip() or
                   f"homespun {words[0]} ended with status {process.returncode}: {said[0].strip()}")


def study(cell: str | os.PathLike[str], *, loads: Iterable[str] | None = None,
          strains: Iterable[float] | None = None, laws: Iterable[str] | None = None,
          methods: Iterable[str] | None = None, cells: int = 20,
          output: str | os.PathLike[str] | None = None, also: Iterable[str] = (),
          options: Sequence[str] = ()) -> Study:
    """Runs `homespun strain --keep` and returns it as a Study; what is there is not run again.

    cell: the path of a cell file, .prm
    loads, laws, methods: names, as in ["strip-1", "periodic-11"]; strains: fractions, [0.01, 0.1];
    None: the program's own (`homespun strain --help`)
    cells: per side of the sheet
    output: folder of the results (default out/NAME/strain)
    also: parts that take longest and are left out otherwise, of "budget" and "runtime"
    options: further words of the command line, such as ["--overwrite"]
    """
    also = list(also)
    if unknown := sorted(set(also).difference(PARTS)):
        raise BadInput(f"also: found {', '.join(unknown)}; expected some of {', '.join(PARTS)}")
    folder = pathlib.Path(output or pathlib.Path("out") / pathlib.Path(cell).stem / "strain")
    words = ["--cells", cells, "--keep", "--no-report", "--output", folder,
             *(f"--no-{part}" for part in PARTS if part not in also), *options]
    given: dict[str, Iterable[object] | None] = {
        "--loads": loads, "--strains": strains, "--references": laws, "--methods": methods}
    for name, values in given.items():
        if values is not None:
            words += [name, ",".join(map(str, values))]
    _run(["strain", cell, *words], sys.stderr)
    return Study(folder)


def _notes_of(folder: pathlib.Path) -> list[str]:
    study = json.loads((folder / "study.json").read_text(encoding="utf-8"))
    return list(map(str, study["notes"]))


class Study:
    """A `homespun strain --keep` of one cell: where the coarse cloth and the resolved one are.

    sheet, periodic: the meshes of sheets and of infinite cloth, each (rest, triangles, phases,
    coarse_rest, coarse_triangles); rest, triangles, phases: of the sheet, where there is one.
    levels: each (load, strain, law) that was kept."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = pathlib.Path(folder)
        kept = sorted(self.folder.glob("*/positions"))
        if len(kept) != 1:
            raise BadInput(f"{folder}: found positions of {len(kept)} cells; expected the folder "
                           "of a `homespun strain --keep` of one cell")
        self._kept = kept[0]
        has_sheet = (self._kept / "sheet.h5").exists()
        self.rest, self.triangles, self.phases, *_ = self.sheet if has_sheet else self.periodic
        self._files: dict[Key, pathlib.Path] = {}
        for path in sorted(self._kept.glob("*-*.h5")):
            attributes = self._read(path, lambda file: dict(file.attrs))
            load, law = (attributes[key].astype(str) for key in ("load", "law"))
            level = Level(str(load), attributes["strain"].item(), str(law))
            self._files[level] = path
        self.levels = sorted(map(Level._make, self._files),
                             key=lambda level: (level.load, level.law, level.strain))

    @staticmethod
    def _read(path: pathlib.Path, what: Callable[[typing.Any], T]) -> T:
        import h5py  # for who studies; the rest of the package needs NumPy alone

        with h5py.File(path) as file:
            return what(file)

    @property
    def sheet(self) -> Mesh:
        """The meshes of the sheets."""
        return self._mesh("sheet.h5")

    @property
    def periodic(self) -> Mesh:
        """The meshes of the cells that repeat in infinite cloth."""
        return self._mesh("periodic.h5")

    def _mesh(self, name: str) -> Mesh:
        path = self._kept / name
        if not path.exists():
            raise BadInput(f"{path}: is not there; expected a study with loads of "
                           f"{'sheets' if name == 'sheet.h5' else 'infinite cloth'}")
        return self._read(path, lambda file: Mesh(*(file[key][...] for key in (
            "rest", "triangles", "material", "coarse_rest", "coarse_triangles"))))

    def _positions(self, key: str, level: Level) -> NDArray[numpy.float64]:
        if level not in self._files:
            raise BadInput(f"{self.folder}: has no level {tuple(level)}; expected (load, strain, "
                           f"law) of {', '.join(str(tuple(one)) for one in self.levels)}")
        return self._read(self._files[level], lambda file: numpy.array(file[key]))

    def coarse(self, load: str, strain: float, law: str) -> NDArray[numpy.float64]:
        """Where the coarse cloth is, (k, 2) [m]: what an up-sampler starts from."""
        return self._positions("coarse", Level(load, strain, law))

    def reference(self, load: str, strain: float, law: str) -> NDArray[numpy.float64]:
        """Where the resolved cloth is, (n, 2) [m]: what fine positions are held against."""
        return self._positions("reference", Level(load, strain, law))

    @property
    def cell(self) -> Cell:
        """The homogenized Cell."""
        return Cell.read(str(self._kept.parent / "cell.h5"))

    def judge(self, positions: Mapping[Key, ArrayLike], name: str, *,
              seconds: Mapping[Key, float] | None = None) -> Judged:
        """Holds fine positions against the references, as `homespun judge` does: a Judged.

        positions: {(load, strain, law): (n, 2) or (n, 3) [m]}, of some or all levels
        name: what the method is called, letters, digits and _; an earlier one of this name is
        replaced
        seconds: {level: run time} of the method, where it is known

        What the program notes of the positions, such as too few digits, is a warning.
        """
        self._check(name)
        output = self.folder.parent / f"{self.folder.name}-{name}"
        words = ["--name", name, "--output", output.resolve(), "--quiet", "--no-report"]
        try:  # what was judged is a copy: it may go
            if "judged" in json.loads((output / "run.json").read_text(encoding="utf-8"))["inputs"]:
                words.append("--overwrite")
        except (OSError, ValueError, KeyError):
            pass
        with tempfile.TemporaryDirectory(prefix="homespun-") as folder:
            # The page shows the command: with a name in place of a file that is gone by then.
            with open(f"{folder}/YOURS.csv", "w", newline="", encoding="utf-8") as file:
                rows = csv.writer(file)
                rows.writerow(["load", "strain", "law", "file", "seconds"])
                for (load, strain, law), fine in positions.items():
                    path = f"{load}-{law}-{strain}.npy"
                    numpy.save(f"{folder}/{path}", numpy.asarray(fine))
                    rows.writerow([load, repr(float(strain)), law, path,
                                   (seconds or {}).get((load, strain, law), "")])
            _run(["judge", self.folder.resolve(), "YOURS.csv", *words], None, folder)
        _, *notes = _notes_of(output)[len(_notes_of(self.folder)):]  # the first is on the bar
        for note in notes:
            warnings.warn(note, stacklevel=2)
        return Judged(output, name)

    def _check(self, name: str) -> None:
        """Refuses what cannot be the name of a method, before anything is computed for it."""
        table = results(self.folder)["strain"]
        taken = {*table["method"].tolist(), *table["reference"].tolist()}
        if not re.fullmatch("[A-Za-z0-9_]+", name) or name in taken:
            raise BadInput(f"name: found `{name}`; expected letters, digits and _, and no method, "
                           "law or reference of homespun")

    def judge_method(self, method: Method, name: str, *, periodic: Method | None = None,
                     repeats: int = 5) -> Judged:
        """Calls a method at every level, times it and judges what it gives.

        method: f(coarse positions (k, 2)) -> fine positions (n, 2) or (n, 3), of the mesh `sheet`;
        what it is given is read-only, what it gives is copied
        name: what it is called, letters, digits and _; an earlier one of this name is replaced
        periodic: the same of the mesh `periodic`; None: infinite cloth is left out
        repeats: calls of which a run time is the median; none begins after ten seconds
        """
        self._check(name)
        fine: dict[Key, ArrayLike] = {}
        seconds: dict[Key, float] = {}
        calls = repeats
        levels = [(level, its) for level in self.levels
                  if (its := periodic if self._is_periodic(level) else method) is not None]
        for n_done, (level, its) in enumerate(levels):
            _draw_bar(n_done, len(levels), f"{name}: {level.load}, {level.law}, {level.strain:g}")
            coarse, times = self.coarse(*level), list[float]()
            coarse.flags.writeable = False  # else a call could move what the next one starts from
            while len(times) < repeats and sum(times) < MOST_SECONDS:
                begin = time.perf_counter()
                found = its(coarse)
                times.append(time.perf_counter() - begin)
                self._check_shape(found, level)
            fine[level] = numpy.array(found)  # whose memory the next level may be written into
            seconds[level], calls = statistics.median(times), min(calls, len(times))
        _draw_bar(len(levels), len(levels), "")
        print(f"{name}: {len(levels)} levels, run times are medians of {calls} calls",
              file=sys.stderr)
        return self.judge(fine, name, seconds=seconds)

    def _check_shape(self, found: object, level: Level) -> None:
        """Refuses what a method gave where it is no array of positions."""
        argument, mesh = (("periodic", "periodic") if self._is_periodic(level)
                          else ("method", "sheet"))
        n = len(getattr(self, mesh).rest)
        array = numpy.asarray(found)
        if array.dtype.kind != "f" or array.shape not in ((n, 2), (n, 3)):
            raise BadInput(f"{argument}: returned an array of shape {array.shape} and type "
                           f"{array.dtype} for {tuple(level)}; expected shape ({n}, 2) or ({n}, 3) "
                           f"and type float64: a row for each vertex of `{mesh}.rest`")

    @staticmethod
    def _is_periodic(level: Level) -> bool:
        return level.load.startswith(("periodic", "uniaxial"))

    def __repr__(self) -> str:
        return (f"<homespun.Study {self.folder}: {len(self.levels)} levels, "
                f"{len(self.rest)} vertices>")


def _draw_bar(n_done: int, n: int, what: str) -> None:
    if sys.stderr.isatty():
        bar = ("#" * (24 * n_done // max(n, 1))).ljust(24, ".")
        print(f"\r\033[K[{bar}]  {what}" if n_done < n else "\r\033[K", end="", file=sys.stderr,
              flush=True)


class Judged:
    """How far a method is from the truth: `rows` of strain.csv, and `ranks` among the `n_methods`
    of each level, itself one of them, 1 where it is the closest. Under the law linear there are
    fewer: a method that is there the same as another is left out. folder holds the study, to which
    the method has come."""

    def __init__(self, folder: pathlib.Path, name: str) -> None:
        self.folder, self.name = folder, name
        table = results(folder)["strain"]
        self.rows = table[table["method"] == name]
        known = table[table["error_mean_per_cell"] > 0.0][0]
        self._side = known["error_mean_m"] / known["error_mean_per_cell"]
        same = ["cell", "load", "strain", "reference"]
        levels = [table[table[same] == row[same]] for row in self.rows]
        self._beside = [dict(zip(level["method"], level["error_mean_m"])) for level in levels]
        self.n_methods = numpy.array([numpy.isfinite(level["error_mean_m"]).sum()
                                      for level in levels])
        self.ranks = numpy.array([
            1 + numpy.sum((level["method"] != name) & (level["error_mean_m"] < row["error_mean_m"]))
            for row, level in zip(self.rows, levels)])

    def page(self) -> pathlib.Path:
        """Draws report.html of the folder, with the method in Figure 3, and returns its path; takes
        half a minute."""
        _run(["report", self.folder], sys.stderr)
        return self.folder / "report.html"

    def __repr__(self) -> str:
        others = [name for name in BESIDE if any(name in level for level in self._beside)]
        lines = ["mean errors in 1/1000 of strain x cell side, with the bar of "
                 f"{self.name} and its rank among all methods",
                 f"{'load':<13} {'law':<7} {'strain':>7} {self.name:>20}"
                 + "".join(f"{name:>11}" for name in others)]
        for row, rank, n, beside in zip(self.rows, self.ranks, self.n_methods, self._beside):
            unit = 1e-3 * row["strain"] * self._side
            error, bar = row["error_mean_m"] / unit, row["error_bar_m"] / unit
            lines.append(
                f"{row['load']:<13} {row['reference']:<7} {100 * row['strain']:>5.3g} % "
                f"{error:>11.4g} ± {bar:<6.2g}"
                + "".join(f"{beside.get(name, numpy.nan) / unit:>11.4g}" for name in others)
                + f"   rank {rank} of {n}")
        return "\n".join(lines)
