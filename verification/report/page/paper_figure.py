# SPDX-License-Identifier: MIT
"""One figure for a paper from stored results, without a page: FOLDER/CELL-NAME.pdf and the like."""
import os

import matplotlib
import numpy
from matplotlib import pyplot

from figures import paper, style
from page import tables
from page.answer_pictures import as_homespun
from page.gallery import METADATA, file_name
from read.budget_results import base_rows
from read.results import BadResults, cell_side
from read.schema import main_method
from read.stiffness import best_run, centre_and_bars

FORMATS = ("pdf", "svg", "png")
NAMES = ("strain", "stiffness", "cell")
DOTS = 600  # per inch, of PNG


def write_figures(results, output, name, width, loads, formats):
    """Writes the figure of each cell that has one.

    @param loads names, or empty for all sheets
    @return paths
    @throws BadResults
    """
    if name not in NAMES:
        raise BadResults([f"--figure: found `{name}`, expected {', '.join(NAMES)}"])
    if wrong := [one for one in formats if one not in FORMATS]:
        raise BadResults([f"--format: found `{wrong[0]}`, expected {', '.join(FORMATS)}"])
    try:
        inches = paper.width_of(width)
    except ValueError as error:
        raise BadResults([str(error)]) from error
    figures = [
        (f"{cell}-{name}", figure)
        for cell in results.cells
        if (figure := figure_of(results, cell, name, inches, loads)) is not None
    ]
    if not figures:
        raise BadResults([f"--figure {name}: these results have nothing to draw in it"])
    paths = []
    os.makedirs(output, exist_ok=True)
    with matplotlib.rc_context(paper.RC):
        for title, figure in figures:
            for kind in formats:
                paths.append(os.path.join(output, f"{file_name(title)}.{kind}"))
                figure.savefig(paths[-1], metadata=METADATA.get(kind), dpi=DOTS, bbox_inches=None)
            pyplot.close(figure)
    return paths


def figure_of(results, name, kind, inches, loads):
    """The figure of a cell, or None where its results have nothing for it."""
    cell = results.cells[name]
    if kind == "cell":
        return None if cell.vertices is None else paper.cell_figure(cell, inches)
    if kind == "stiffness":
        value = best_run(cell, "C")
        if value is None:
            return None
        matrices = {"Cᴴ": centre_and_bars(value, "C")[0]}
        for key in ("voigt", "reuss"):
            matrix = cell.stiffness(key)
            if matrix is not None and numpy.linalg.eigvalsh((matrix + matrix.T) / 2.0).min() > 0.0:
                matrices[key.capitalize()] = matrix
        return paper.stiffness_figure(matrices, inches)
    rows = results.reached(name)
    reference = tables.main_reference(rows)
    rows = [row for row in rows if row["reference"] == reference]
    known = style.ordered_loads(row["load"] for row in rows)
    if wrong := [load for load in loads if load not in known]:
        raise BadResults([f"--loads: {name} has no `{wrong[0]}`, expected {', '.join(known)}"])
    gains = [row for row in results.gains if (row["cell"], row["reference"]) == (name, reference)]
    chosen = {
        load: main_method({row["method"] for row in rows if row["load"] == load}) for load in known
    }
    wanted = loads or known
    rows = [row for row in rows if row["load"] in wanted]
    base = [row for row in base_rows(rows, gains) if row["load"] in wanted]
    rows, methods = as_homespun(rows, base, chosen)
    if not rows:
        return None
    return paper.strain_figure(rows, methods, reference, cell_side(results, name), inches)
