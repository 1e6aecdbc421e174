# SPDX-License-Identifier: MIT
"""The pictures of the first screen: rows under names that need no glossary, and the sheet that leaves
most of its error.
"""
from figures import style
from figures.sheet import small_sheet_figure
from figures.style import percent
from page import tables
from page.headline import PAPER
from read.cell_results import read_fields
from read.results import BadResults
from read.schema import is_of_homespun


def as_homespun(rows, of_base, chosen):
    """Rows of the sheets, if there are any, whose methods have the names of the first screen, and
    these names in their order.

    A method of somebody's own keeps its name.

    @param of_base rows of the coarse cloths, as those of the method `base`
    @param chosen load -> the method that the page speaks of
    """
    names = {"affine": style.COARSE, PAPER: style.PAPER, "base": style.CLOTH}
    named, every = [], [*rows, *of_base]
    for row in [row for row in every if not style.is_infinite(row["load"])] or every:
        name = names.get(row["method"])
        if name is None and row["method"] == chosen.get(row["load"]):
            name = style.HOMESPUN
        if row["method"] not in names and not is_of_homespun(row["method"]):
            name = row["method"]
        if name:
            named.append({**row, "method": name})
    return named, style.ordered_methods(row["method"] for row in named)


def sheet_of_answer(cell, lines, gallery):
    """Reference, up-sampled sheet and its error, of the load that leaves most of it; None where no
    sheet is stored.
    """
    left = {line["load"]: line["left_per_cell"] for line in lines}
    found = {}
    for path in cell.field_files if cell else ():
        faults = []
        if sheet := read_fields(path, faults):
            found[sheet["load"]] = sheet
        if faults:
            raise BadResults(faults)
    if not found:
        return None
    load = max(found, key=lambda one: left.get(one, 0.0))
    sheet = found[load]
    figure, mean = small_sheet_figure(sheet)
    return gallery.add(
        figure,
        f"{cell.name}-answer-sheet",
        f"{load} at {percent(sheet['strain'])} strain: where the reference ({sheet['reference_law']})"
        f" and the sheet up-sampled by {by_whom(sheet['method'])} put their vertices, coloured by how far that"
        f" is from the coarse mesh alone, and the distance of the two, {tables.length(mean)} in the"
        " mean. True scale.",
        as_image=True,
        table=((), []),
    )


def by_whom(method):
    return f"the paper's method, {method}," if method == PAPER else f"homespun ({method})"
