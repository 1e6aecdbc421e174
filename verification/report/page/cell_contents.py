# SPDX-License-Identifier: MIT
"""What the page shows of each cell: figures and tables of its strain study and homogenization."""
import math
import os
from concurrent.futures import ProcessPoolExecutor

from figures import style
from figures.cell import characteristic_figure, phase_figure, phase_legend
from figures.laws import law_figure, law_sentence, marks_of
from figures.run_time import error_time_figure, run_time_figure, step_figure
from figures.sheet import sheet_figure
from figures.stiffness import bracket_figure, polar_figure
from figures.strain import error_figure
from figures.style import percent
from figures.vertex_tables import cell_table, chi_table
from figures.view_data import sheet_table, sheet_view
from page import tables
from page.bending_contents import bending_contents
from page.budget_contents import budget_contents
from page.force_contents import force_contents
from page.gallery import file_name
from page.words import judged_sentence
from read.budget_results import base_rows
from read.cell_results import grouped, read_fields
from read.results import BadResults, cell_side
from read.schema import is_of_homespun, main_method
from read.verdicts import MARKS, WORDS


def contents_of_cells(results, gallery):
    """Cells share nothing, so that each is drawn by a process of its own."""
    names = list(results.cells)
    files = {file_name(name) for name in names}
    # Names that differ in odd characters only: one gallery.
    if len(names) < 2 or len(files) < len(names):
        return [cell_contents(results, name, gallery) for name in names]
    gallery.finish()  # what is still being saved cannot be handed to another process
    workers = min(len(names), os.cpu_count() or 1)
    with ProcessPoolExecutor(max_workers=workers) as pool:
        return list(pool.map(saved_contents, [results] * len(names), names,
                             [gallery] * len(names), [workers] * len(names)))


def saved_contents(results, name, gallery, workers):
    """cell_contents() whose pictures are all saved.

    @param workers how many processes do this at once, and share the cores
    """
    gallery.at_once = max(1, gallery.at_once // workers)
    contents = cell_contents(results, name, gallery)
    gallery.finish()
    return contents


def cell_contents(results, name, gallery):
    """Figures and tables of one cell; what has no data is None or empty."""
    cell = results.cells[name]
    rows, side = results.reached(name), cell_side(results, name)
    steps = [row for row in results.steps if row["cell"] == name]
    gains = [row for row in results.gains if row["cell"] == name]
    contents = {
        "name": name,
        "file": cell.file,
        "error": None,
        "error_share": None,
        "variants": None,
        "run_time": None,
        "steps": None,
        "polar": None,
        "law": None,
        "bracket": None,
        "phases_picture": None,
        "chi": None,
        "error_time": None,
        "sheets": [],
    }
    methods = style.ordered_methods(row["method"] for row in rows)
    reference = tables.main_reference(rows)
    if rows:
        draw_strain(contents, (rows, base_rows(rows, gains)), methods, reference, side, gallery)
    if figure := run_time_figure(rows, reference):
        contents["run_time"] = gallery.add(
            figure,
            f"{name}-run-time",
            (
                f"{name}: run time against strain. Solid: full resolution ({reference}); "
                "dashed: coarse solve and up-sampling by the method that the answer speaks of."
            ),
        )
    if figure := step_figure(steps):
        contents["steps"] = gallery.add(
            figure,
            f"{name}-load-step",
            (
                f"{name}: the parts of one load step by localized, the paper's method; the number"
                " is full resolution over coarse solve and up-sampling."
            ),
        )
    if cell.stiffness() is not None:
        contents["polar"] = gallery.add(
            polar_figure(cell),
            f"{name}-directional-modulus",
            (
                f"{name}: modulus of uniaxial tension along "
                "each direction, between the bounds of Voigt and Reuss."
            ),
        )
    if marked := marks_of(cell):
        contents["law"] = gallery.add(
            law_figure(marked),
            f"{name}-which-law",
            (
                f"{name}: up to which strain the laws of a membrane have a minimum, pulled and"
                " pressed along the axis of the larger modulus E, free sides, no lateral contraction;"
                " G is the shear modulus in the same axes. Circles: fabrics of Wang et al. 2011, a"
                f" triangle where `biot` is never lost. {law_sentence(marked)}"
            ),
        )
    if figure := bracket_figure(cell):
        contents["bracket"] = gallery.add(
            figure,
            f"{name}-bracket",
            (
                f"{name}: the guaranteed bracket on the effective stiffness of the meshed cell"
                " against degrees of freedom."
            ),
        )
    if cell.vertices is not None:
        contents["phases_picture"] = gallery.add(
            phase_figure(cell),
            f"{name}-cell",
            (
                f"{name}: the unit cell, {len(cell.triangles):,} triangles,"
                f" {len(cell.vertices):,} vertices, coloured by phase, light is soft; arrows are"
                " lattice vectors."
            ),
            table=cell_table(cell),
        )
        contents["chi"] = gallery.add(
            characteristic_figure(cell),
            f"{name}-characteristic-displacements",
            (
                f"{name}: characteristic displacements, exaggerated so that the largest is a tenth"
                " of the cell side. White lines: edges of the phases; dashed: the cell at rest."
            ),
            as_image=True,
            table=chi_table(cell),
        )
    sheets = sum(len(one.field_files) for one in results.cells.values())
    for path in cell.field_files:
        contents["sheets"].append(sheet_picture(cell, path, side, gallery, sheets))
    strains = tables.nearest_strains([row for row in rows if row["reference"] == reference])
    if figure := error_time_figure(rows, methods, reference, strains, side):
        contents["error_time"] = gallery.add(
            figure,
            f"{name}-error-time",
            (
                f"{name}: mean error against run time; lower left is better. "
                "Full resolution stands at its own uncertainty, where that is known."
            ),
        )
    contents.update(force_contents(results, name, reference, strains, gallery))
    contents.update(bending_contents(cell, gallery))
    contents.update(budget_contents(results, name, side, strains, gallery))
    contents["round_off"] = tables.round_off_sentences(rows)
    contents["error_tables"] = tables.error_tables(rows, methods, gains)
    contents["stiffness"] = tables.stiffness_table(cell)
    contents["phases"] = tables.phase_rows(cell)
    contents["checks"] = [
        check_contents(c)
        for c in (cell.homogenize or {}).get("checks") or []
        if isinstance(c, dict)
    ]
    return contents


def check_contents(check):
    verdict = check.get("verdict") if check.get("verdict") in MARKS else "INCONCLUSIVE"
    return {
        "name": check.get("name", "?"),
        "value": tables.shown(check.get("value")),
        "limit": tables.shown(check.get("limit", "")),
        "derivation": str(check.get("derivation") or ""),
        "verdict": verdict,
        "mark": MARKS[verdict],
        "word": WORDS[verdict],
    }


def draw_strain(contents, rows_and_bases, methods, reference, side, gallery):
    """The three error figures of one cell."""
    rows, of_base = rows_and_bases
    name = contents["name"]
    of_load = {}
    for row in rows:
        if row["reference"] == reference:
            of_load.setdefault(row["load"], set()).add(row["method"])
    spoken_of = {"affine", "localized"} | {
        main_method(some) for some in of_load.values()
    }
    own = [method for method in methods if not is_of_homespun(method)]
    main = [method for method in methods if method in spoken_of] or methods
    main = style.ordered_methods([*main, *own, *{row["method"] for row in of_base}])
    references = style.ordered_references(row["reference"] for row in rows)
    floor = f" Triangles at the lower edge: below {style.ROUND_OFF_TEXT}, zero to round-off."
    figure, at_floor = error_figure(rows + of_base, main, references, side)
    contents["error"] = gallery.add(
        figure,
        f"{name}-error-strain",
        f"{name}: mean error per vertex, in cell sides, against strain. Grey: up to the error bar"
        " of the smallest error (the largest of the laws shown)."
        + judged_sentence(own) + (floor if at_floor else ""),
    )
    figure, at_floor = error_figure(
        rows + of_base, main, references, side, "error_mean_per_fluctuation"
    )
    contents["error_share"] = gallery.add(
        figure,
        f"{name}-error-strain-fluctuation",
        f"{name}: the same in percent of the measured fluctuation, the mean over "
        "the fine vertices of |reference − homogenized sheet resolved on a fine mesh|."
        + (floor if at_floor else ""),
    )
    variants = [method for method in methods if method not in spoken_of.union(own)]
    if variants:
        shown = [method for method in methods if method != "affine"]
        figure, at_floor = error_figure(rows, shown, [reference], side)
        contents["variants"] = gallery.add(
            figure,
            f"{name}-variants",
            f"{name}: all methods, and variants of the paper's (lift, anchor, blending), against"
            f" {reference}."
            + (floor if at_floor else ""),
        )


def sheet_picture(cell, path, side, gallery, sheets):
    """Picture of one stored sheet, with its numbers in the caption, and what the page needs to turn
    it.

    @param sheets how many the page shows
    """
    faults = []
    sheet = read_fields(path, faults)
    if sheet is None:
        raise BadResults(faults)
    sheet["material"] = grouped(cell, sheet["material"])
    size = side or math.sqrt(float(abs(sheet["rest"].ptp(axis=0).prod())))
    figure, numbers = sheet_figure(cell, sheet, size)
    caption = (
        f"{cell.name}, {sheet['load']} at {percent(sheet['strain'])} strain,"
        f" {len(sheet['triangles']):,} triangles: {sheet['method']} against"
        f" {sheet['reference_law']}. Mean error {tables.length(numbers['error_mean'])}, largest"
        f" {tables.length(numbers['error_max'])}; the coarse mesh alone:"
        f" {tables.length(numbers['affine_mean'])}. Colour bars end at the 99.5th percentile. True"
        " scale, not exaggerated. Below: the framed cells. The CSV file holds the vertices of the"
        " view in space."
    )
    colours = {number: colour for number, colour, _ in phase_legend(cell, sheet["material"])}
    view, few = sheet_view(sheet, colours, sheets)
    return gallery.add(
        figure,
        f"{cell.name}-sheet-{sheet['load']}",
        caption,
        as_image=True,
        table=sheet_table(sheet, few),
        view=view,
    )
