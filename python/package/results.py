# SPDX-License-Identifier: MIT
"""Tables of a run of the program, as NumPy's structured arrays."""
from __future__ import annotations

import csv
import json
import pathlib
import typing

import numpy

from ._light import BadInput, fault_of_format

if typing.TYPE_CHECKING:
    import os

    from numpy.typing import NDArray


_NAMES = {"cell", "load", "reference", "method", "frame", "frame_crc32"}  # text, also of digits


def _column(name: str, texts: list[str]) -> NDArray[typing.Any]:
    """Numbers where all entries are some or empty, which is not a number; else text."""
    if name in _NAMES:
        return numpy.array(texts, dtype=str)
    try:
        return numpy.array([float(text) if text else numpy.nan for text in texts])
    except ValueError:
        return numpy.array(texts, dtype=str)


def _table(path: pathlib.Path) -> NDArray[numpy.void]:
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    columns = {name: _column(name, [row[k] for row in rows]) for k, name in enumerate(header)}
    table = numpy.empty(len(rows), dtype=[(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        table[name] = values
    return table


def _check_format(path: pathlib.Path) -> None:
    """Refuses what a newer homespun wrote: the tables of a folder have the format of its run."""
    try:
        version = json.loads(path.read_text(encoding="utf-8")).get("format_version", 0)
    except FileNotFoundError:
        return  # tables by themselves
    except (ValueError, AttributeError) as error:
        raise BadInput(f"{path}: is damaged; expected what homespun writes there") from error
    fault = fault_of_format(str(path), version if type(version) is int else json.dumps(version))
    if fault:
        raise BadInput(fault)


def results(folder: str | os.PathLike[str]) -> dict[str, NDArray[numpy.void]]:
    """{name: table} of the .csv files of a folder, `results("out/dots/strain")["strain"]`.

    Columns are those of the file; numbers read back as they were written. A run of a newer homespun
    (`format_version` of its run.json) raises BadInput."""
    folder = pathlib.Path(folder)
    paths = sorted(folder.glob("*.csv"))
    if not paths:
        raise BadInput(f"{folder}: holds no .csv; expected a folder that `homespun strain`, "
                       "`converge`, `drape` or `stress` has written")
    _check_format(folder / "run.json")
    return {path.stem: _table(path) for path in paths}
