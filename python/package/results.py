# SPDX-License-Identifier: MIT
"""Tables of a run of the program, as NumPy's structured arrays."""
import csv
import pathlib

import numpy

from ._light import BadInput


def _column(texts):
    """Numbers where all entries are some or empty, which is not a number; else text."""
    try:
        return numpy.array([float(text) if text else numpy.nan for text in texts])
    except ValueError:
        return numpy.array(texts, dtype=str)


def _table(path):
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    columns = {name: _column([row[k] for row in rows]) for k, name in enumerate(header)}
    table = numpy.empty(len(rows), dtype=[(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        table[name] = values
    return table


def results(folder):
    """{name: table} of the .csv files of a folder, `results("out/dots/strain")["strain"]`.

    Columns are those of the file; numbers read back as they were written."""
    folder = pathlib.Path(folder)
    paths = sorted(folder.glob("*.csv"))
    if not paths:
        raise BadInput(f"{folder}: holds no .csv; expected a folder that `homespun strain`, "
                       "`converge`, `drape` or `stress` has written")
    return {path.stem: _table(path) for path in paths}
