# SPDX-License-Identifier: MIT
"""What the page says of one scene: the result in words, pictures, curves and tables."""
import os

from figures.animation import animation, moving_jobs
from figures.cloth import cloth_figure, film_of
from figures.drape import (
    energy_figure,
    error_time_curves,
    height_figure,
    ordered_references,
    ordered_variants,
    step_bars,
)
from figures.held import held_figure
from figures.style import three
from figures.view_data import film_view
from page import tables
from page.drape_tables import cost_rows, error_rows, exactly, facts, run_rows, sentences, term_rows
from read.stored import BadResults
from read.vtu import BadFrame, read_vtu


def drape_contents(drape, gallery, output, limit, pool, scenes=1):
    """One scene as the template shows it.

    @param output folder of the page, for links to the frames
    @param limit bytes of one animation
    @param pool of processes that render
    @param scenes how many the page shows
    @throws BadResults where a frame cannot be read
    """
    return {
        "scene": drape.scene,
        "story": drape.info.get("story") or "",
        "facts": facts(drape.info),
        "cells": [
            cell_contents(drape, cell, gallery, output, limit, pool, scenes) for cell in drape.cells
        ],
        "terms": term_rows(drape.info),
        "costs": [row for cell in drape.cells for row in cost_rows(cell)],
        "parameters": [(key, exactly(value)) for key, value in drape.parameters()],
    }


def cell_contents(drape, cell, gallery, output, limit, pool, scenes):
    """Pictures, curves and tables of one cell in the scene; what has no data is None or empty."""
    info = cell.info
    side, density = info.get("cell_side_m"), info.get("areal_density")
    contents = {
        "name": cell.name,
        "sentences": sentences(cell),
        "pictures": None,
        "animation": None,
        "error": None,
        "height": None,
        "energies": None,
        "held": None,
        "steps": None,
        "errors": error_rows(cell),
        "runs": run_rows(cell),
        "matrix": tables.matrix_rows(info.get("C")),
        "side": tables.length(float(side)) if side else None,
        "density": f"{three(float(density))} kg/m²" if density else None,
        "links": [
            (os.path.relpath(path, drape.folder), os.path.relpath(path, output))
            for path in cell.lists
        ],
    }
    draw_cloth(contents, drape, cell, gallery, limit, pool, scenes)
    draw_curves(contents, drape, cell, gallery)
    return contents


def draw_cloth(contents, drape, cell, gallery, limit, pool, scenes):
    """The rendered pictures and the animation of a cell."""
    variants = ordered_variants(run["variant"] for run in cell.runs)
    references = ordered_references(reference["reference"] for reference in cell.references)
    film = film_of(cell, variants, references, drape.info.get("duration_s"))
    if film is None:
        return
    file, title = f"{drape.scene}-{cell.name}", f"{drape.scene}, {cell.name}"
    try:
        bodies = read_vtu(drape.obstacles) if drape.obstacles else None
        figure, camera, phases, numbers = cloth_figure(
            film, drape.up(), cell.info.get("cell_side_m"), pool, cell.info, bodies
        )
        # Rendered while this process saves the figure.
        jobs = moving_jobs(film, camera, phases, pool, bodies)
        words = ""
        if numbers["largest"] > 0.0:
            words = " Error: distance of each up-sampled vertex from its place in the reference"
            words += (
                "; the colour bar, common to all times, ends at the 99.5th percentile"
                if numbers["capped"]
                else ""
            )
            words += "."
        if numbers["close"]:
            words += " Below: the framed part of the last time."
        contents["pictures"] = gallery.add(
            figure,
            f"{file}-cloth",
            (
                f"{title}, {film.variant} cloth. One camera for all; parallel projection, "
                f"true scale, not exaggerated.{words}"
            ),
            as_image="shaded",
            view=film_view(film, camera, phases, drape.up(), len(drape.cells) * scenes),
        )
        if moving := animation(film, camera, jobs, limit):
            data, width, loop, (first, last) = moving
            at_speed = abs(loop - (last - first)) <= 0.05 * loop
            words = "at true speed" if at_speed else f"shown in {three(float(loop))} s"
            contents["animation"] = gallery.add_animation(
                data,
                f"{file}-motion",
                width,
                f"{title}: from {three(float(first))} s to {three(float(last))} s, {words}.",
            )
    except BadFrame as error:
        raise BadResults([str(error)]) from error


def draw_curves(contents, drape, cell, gallery):
    """Error, height, energies and time per step."""
    file, title = f"{drape.scene}-{cell.name}", f"{drape.scene}, {cell.name}"
    if figure := error_time_curves(cell.errors):
        contents["error"] = gallery.add(
            figure,
            f"{file}-error-time",
            (
                f"{title}: mean error over all fine vertices against time, for each membrane model"
                " of the coarse cloth (panels) and each way of up-sampling (colours). Grey: not"
                " larger than the reference's own uncertainty."
            ),
        )
    if drawn := height_figure(cell.motion, drape.up(), drape.gravity()):
        figure, falling = drawn
        words = ""
        if falling:
            words = (
                f" {' and '.join(falling)} move{'s' if len(falling) == 1 else ''} more than three"
                " times as far as the first cloth and the references; the right panel leaves that"
                " out."
            )
        if "nodal-warping" in falling:
            words += (
                " The forces of the paper's Eq. 8 (nodal warping) have no part along the normal, so"
                " that nothing holds the cloth up."
            )
        contents["height"] = gallery.add(
            figure, f"{file}-height", f"{title}: height of the middle vertex.{words}"
        )
    if drawn := energy_figure(cell.motion):
        figure, zero = drawn
        words = f" Zero to round-off, not drawn: {', '.join(zero)}." if zero else ""
        contents["energies"] = gallery.add(
            figure,
            f"{file}-energies",
            (
                f"{title}: energies of the cloth and its largest stretch (deformed over rest"
                " length). The weight's energy is zero at the origin; forces that have no energy"
                " (nodal warping) have no elastic one. A curve that leaves its panel grows beyond"
                f" a thousand times the first cloth's largest value.{words}"
            ),
        )
    if drawn := held_figure(cell.held):
        figure, others = drawn
        words = f" Not drawn: {', '.join(others)}." if others else ""
        contents["held"] = gallery.add(
            figure,
            f"{file}-held-forces",
            (
                f"{title}: size of the force that each held place exerts on the cloth; components"
                f" are in motion.csv.{words}"
            ),
        )
    if figure := step_bars(cell):
        words = ""
        if cell.references:
            words = (
                " The factor at a reference: its step over coarse step and up-sampling of the first"
                " cloth."
            )
        contents["steps"] = gallery.add(figure, f"{file}-step", f"{title}: time per step.{words}")
