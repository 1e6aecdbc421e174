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


# Text, also where all of it is digits or nothing: columns of every table, and of one.
_TEXT = set("""
    base case cell claim cloth converge.limit criterion derivation ended_by fault frame_crc32 h_unit
    homogenized_law id indicator judgement kind kind_of_claim law limits.axis load long_waves measure mesh
    method note of outcome part path place quantity reference reference_stability region relation
    scale scene stress.axis study term theory_is upsample.frame value_is variant wave waves
    way what why""".split())


def _column(table: str, name: str, texts: list[str]) -> NDArray[typing.Any]:
    """Numbers, not a number where nothing stands; text where that is what the column holds."""
    if name in _TEXT or f"{table}.{name}" in _TEXT:
        return numpy.array(texts, dtype=str)
    try:
        return numpy.array([float(text) if text else numpy.nan for text in texts])
    except ValueError:
        return numpy.array(texts, dtype=str)


def _table(path: pathlib.Path) -> NDArray[numpy.void]:
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    columns = {name: _column(path.stem, name, [row[k] for row in rows]) for k, name in enumerate(header)}
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
