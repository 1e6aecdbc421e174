# SPDX-License-Identifier: MIT
"""What the page says of one scene: sentences first, then pictures, curves and tables."""
import json
import math
import os

from markupsafe import escape

import style
import tables
from drape_results import PRESENT
from figures_cloth import animation, cloth_figure, film_of
from figures_drape import (energy_figure, error_time_curves, height_figure, light_seconds, main_run, number,
                           ordered_references, ordered_variants, step_bars, workers_of)
from stored import BadResults
from style import seconds, three
from vtu import BadFrame

METHOD = "localized"


def drape_contents(drape, gallery, output, limit, pool):
    """One scene as the template shows it.

    @param output folder of the page, for links to the frames
    @param limit bytes of one animation
    @param pool of processes that render
    @throws BadResults where a frame cannot be read
    """
    info = drape.info
    return {"scene": drape.scene, "story": info.get("story") or "", "facts": facts(info),
            "cells": [cell_contents(drape, cell, gallery, output, limit, pool) for cell in drape.cells],
            "terms": [[term["name"], "present" if term["present"] else "left out",
                       str((term.get("parameters") if term["present"] else term.get("why")) or "–")] for term in info.get("terms") or []],
            "costs": [cost_row(cell.name, row) for cell in drape.cells for row in cell.terms],
            "parameters": [(key, exactly(value)) for key, value in drape.parameters()]}


def facts(info):
    """Size and time stepping of the scene in one sentence."""
    parts = []
    if info.get("coarse_triangles"):
        parts.append(f"{three(int(info['coarse_triangles']))} coarse triangles")
    if info.get("fine_triangles"):
        parts.append(f"{three(int(info['fine_triangles']))} fine triangles"
                     + (f" with {three(int(info['fine_vertices']))} vertices" if info.get("fine_vertices") else ""))
    if info.get("time_step_s"):
        parts.append(f"steps of {seconds(float(info['time_step_s']))}")
    if info.get("duration_s"):
        parts.append(f"{seconds(float(info['duration_s']))} of motion")
    if info.get("integrator"):
        parts.append(info["integrator"])
    return ", ".join(parts) + "." if parts else ""


def exactly(value):
    """A parameter with all its digits: whoever repeats the run needs them."""
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def sentences(cell):
    """The result of one cell in words, as HTML: one sentence of time and one of error for each reference."""
    run = main_run(cell)
    if run is None:
        return []
    light, result = light_seconds(run), []
    coarse, upsampling = number(run, "seconds_per_coarse_step"), number(run, "seconds_per_upsampling")
    threads = number(run, "threads")
    start = (f"One step of the coarse cloth ({escape(run['variant'])}) takes {seconds(coarse)} and its up-sampling {seconds(upsampling)}"
             + (f" on {int(threads)} thread{'s' if threads != 1 else ''}" if threads > 0 else ""))
    if number(run, "cut_steps") > 0:
        of = f" of {three(int(number(run, 'steps')))}" if number(run, "steps") > 0 else ""
        start += f" ({three(int(run['cut_steps']))}{of} steps had to be cut)"
    if not cell.references:
        result.append(start + ". No reference was asked for, so that nothing is said of the error.")
    order = ordered_references(reference["reference"] for reference in cell.references)
    for reference in sorted(cell.references, key=lambda reference: order.index(reference["reference"])):
        slow, name = number(reference, "seconds_per_step"), reference["reference"]
        ratio = f", <b>{three(float(slow / light))} times</b> as long" if slow > 0 and light > 0 else ""
        who = ", ".join(w for w in (workers_of(reference), f"{three(int(number(reference, 'dofs')))} unknowns"
                                    if number(reference, "dofs") > 0 else "") if w)
        text = f"{start}; a step of the reference <b>{escape(name)}</b> takes {seconds(slow)}{f' ({who})' if who else ''}{ratio}."
        result.append(text + " " + error_sentence(cell, run["variant"], name))
        start = "The same coarse step and up-sampling"
        if slow > 0:
            start += f" take {seconds(light)}"
    return result


def rows_of(cell, variant, reference, method):
    return sorted((row for row in cell.errors if row["variant"] == variant and row["reference"] == reference
                   and row["method"] == method and not math.isnan(row["error_mean_m"])), key=lambda row: row["time_s"])


def error_sentence(cell, variant, reference):
    """Mean error at the end and its maximum over time, with the reference's own error bar."""
    rows = rows_of(cell, variant, reference, METHOD)
    if not rows:
        return f"Its error against {escape(reference)} is not known."
    last, worst = rows[-1], max(rows, key=lambda row: row["error_mean_m"])
    bar = last["reference_uncertainty_m"]
    text = (f"The mean error per vertex at the end ({three(float(last['time_s']))} s) is <b>{tables.length(last['error_mean_m'])}</b>"
            + (f" ({three(float(last['error_mean_per_cell']))} cell sides)" if not math.isnan(last["error_mean_per_cell"]) else "")
            + f", at most {tables.length(worst['error_mean_m'])} at {three(float(worst['time_s']))} s; the uncertainty of the reference is "
            + ("not known" if math.isnan(bar) else tables.length(bar)))
    if not math.isnan(bar) and last["error_mean_m"] <= bar:
        text += ", so that the error at the end is not resolved"
    affine = rows_of(cell, variant, reference, "affine")
    if affine:
        text += f". Without microscopic displacement it is {tables.length(affine[-1]['error_mean_m'])} at the end"
    return text + "."


def error_table(cell):
    """Mean error at the end, its maximum over time and what it is of the fluctuation, for each variant, reference, method."""
    result = []
    methods = style.ordered_methods(row["method"] for row in cell.errors)
    for reference in ordered_references(row["reference"] for row in cell.errors):
        for variant in ordered_variants(row["variant"] for row in cell.errors):
            for method in methods:
                rows = rows_of(cell, variant, reference, method)
                if not rows:
                    continue
                last, worst = rows[-1], max(rows, key=lambda row: row["error_mean_m"])
                share = last["error_mean_per_fluctuation"]
                result.append([reference, variant, method, tables.length(last["error_mean_m"]), tables.length(last["error_max_m"]),
                               three(float(last["error_mean_per_cell"])), "–" if math.isnan(share) else f"{three(100. * share)} %",
                               f"{tables.length(worst['error_mean_m'])} at {three(float(worst['time_s']))} s",
                               "not known" if math.isnan(last["reference_uncertainty_m"]) else tables.length(last["reference_uncertainty_m"])])
    return result


def run_rows(cell):
    """One row per variant and reference: what ran, on what, how long a step takes."""
    light = light_seconds(main_run(cell)) if cell.runs else math.nan

    def count(item, key):
        return tables.integer(number(item, key))
    rows = [[run["variant"], count(run, "steps"), count(run, "cut_steps"), count(run, "frames"), "1" if math.isnan(number(run, "ranks"))
             else count(run, "ranks"), count(run, "threads"), "–", seconds(number(run, "seconds_per_coarse_step")),
             seconds(number(run, "seconds_per_upsampling")), three(float(light_seconds(run) / light)) if light > 0 else "–"]
            for run in cell.runs]
    rows += [[f"reference {r['reference']}", "–", "–", "–", count(r, "ranks"), count(r, "threads"), count(r, "dofs"),
              seconds(number(r, "seconds_per_step")), "–",
              three(float(number(r, "seconds_per_step") / light)) if light > 0 else "–"] for r in cell.references]
    return rows


def cost_row(cell, row):
    """What a term costs a step, and would cost if it were forced upon the scene."""
    time, forced, memory, forced_memory = (row[key] for key in ("seconds_per_step", "seconds_per_step_forced", "bytes", "bytes_forced"))

    def more(value, other):
        return f"{100. * (other / value - 1.):+.1f} %".replace("-", "−") if value > 0 and not math.isnan(other) else "–"
    present = PRESENT[row["present"].lower()]
    return [cell, row["term"], "present" if present else "left out", seconds(time), seconds(forced), more(time, forced),
            size_of(memory), size_of(forced_memory), more(memory, forced_memory)]


def size_of(value):
    """A memory size in the unit that suits it."""
    if math.isnan(value):
        return "–"
    for limit, factor, unit in ((1e3, 1., "B"), (1e6, 1e-3, "kB"), (1e9, 1e-6, "MB")):
        if value < limit:
            return f"{three(float(value * factor))} {unit}"
    return f"{three(float(value * 1e-9))} GB"


def cell_contents(drape, cell, gallery, output, limit, pool):
    """Pictures, curves and tables of one cell in the scene; what has no data is None or empty."""
    name, info = f"{drape.scene}-{cell.name}", cell.info
    contents = {"name": cell.name, "sentences": sentences(cell), "pictures": None, "animation": None, "error": None, "height": None,
                "energies": None, "steps": None, "errors": error_table(cell), "runs": run_rows(cell),
                "matrix": tables.matrix_rows(info.get("C")),
                "side": tables.length(info["cell_side_m"]) if info.get("cell_side_m") else None,
                "density": f"{three(float(info['areal_density']))} kg/m²" if info.get("areal_density") else None,
                "links": [(os.path.relpath(path, drape.folder), os.path.relpath(path, output)) for path in cell.lists]}
    draw_cloth(contents, drape, cell, name, gallery, limit, pool)
    if figure := error_time_curves(cell.errors):
        contents["error"] = gallery.add(
            figure, f"{name}-error-time", f"{drape.scene}, {cell.name}: mean error over all fine vertices against time, for each "
            "membrane model of the coarse cloth (panels) and each way of up-sampling (colours). Grey: not larger than the reference's own "
            "uncertainty.")
    if drawn := height_figure(cell.motion, drape.up(), drape.gravity()):
        figure, falling = drawn
        words = (f" {' and '.join(falling)} move{'s' if len(falling) == 1 else ''} more than three times as far as the first cloth "
                 "and the references; the right panel leaves that out." if falling else "")
        if any(variant.startswith("printed") for variant in falling):
            words += " The force of the printed Eq. 8 has no part along the normal, so that nothing holds the cloth up."
        contents["height"] = gallery.add(figure, f"{name}-height", f"{drape.scene}, {cell.name}: height of the centre of mass.{words}")
    if figure := energy_figure(cell.motion):
        contents["energies"] = gallery.add(figure, f"{name}-energies", f"{drape.scene}, {cell.name}: energies of the cloth and its "
                                           "largest stretch (deformed over rest length).")
    if figure := step_bars(cell):
        words = " The factor at a reference: its step over coarse step and up-sampling of the first cloth." if cell.references else ""
        contents["steps"] = gallery.add(figure, f"{name}-step", f"{drape.scene}, {cell.name}: time per step.{words}")
    return contents


def draw_cloth(contents, drape, cell, name, gallery, limit, pool):
    """The rendered pictures and the animation of a cell."""
    variants = ordered_variants(run["variant"] for run in cell.runs)
    film = film_of(cell, variants, ordered_references(r["reference"] for r in cell.references), drape.info.get("duration_s"))
    if film is None:
        return
    try:
        figure, camera, phases, numbers = cloth_figure(film, drape.up(), cell.info.get("cell_side_m"), pool)
        words = ""
        if numbers["largest"] > 0.:
            words = (" Error: distance of each up-sampled vertex from its place in the reference"
                     + ("; the colour bar, common to all times, ends at the 99.5th percentile." if numbers["capped"] else "."))
        if numbers["close"]:
            words += " Below: the framed part of the last time."
        contents["pictures"] = gallery.add(
            figure, f"{name}-cloth", f"{drape.scene}, {cell.name}, {film.variant} cloth. One camera for all; parallel projection, true scale, "
            f"not exaggerated.{words}", as_image="webp")
        if moving := animation(film, camera, phases, limit, pool):
            data, width, loop, (first, last) = moving
            contents["animation"] = gallery.add_animation(
                data, f"{name}-motion", width, f"{drape.scene}, {cell.name}: from {three(float(first))} s to {three(float(last))} s"
                + (f", shown in {three(float(loop))} s" if abs(loop - (last - first)) > 0.05 * loop else ", at true speed") + ".")
    except BadFrame as error:
        raise BadResults([str(error)]) from error


