# SPDX-License-Identifier: MIT
"""What the report shows of `homespun periodic stability`: the margin of each load, the strain of first loss,
the zone of its waves and the wave that is lost.
"""
import math

from markupsafe import Markup, escape

from figures.stability import shown_way, stability_figure
from figures.style import number_with_bar, three

CAPTION = Markup(
    "<code>{cell}</code>, {law}, {load}. Left: the margin β of the periodic state against strain, 1"
    " at rest and below 0 where a wave takes it away; vertical lines: first loss, shaded: what the"
    " mesh leaves open.{rest}"
)
ZONE = (
    " Middle: β of the waves k at {strain} %, {what}; the disc in the middle: the limit of long"
    " waves, by their direction; {mark}: the lowest wave."
)
FLAT = " (kept flat: a free sheet that is pressed in its plane wrinkles at once)"
MODE = " Right: that wave on {cells}, its size chosen to be seen."


def first_loss(path, way):
    """One sentence: where it is lost, by what, and how sure that is."""
    given, refined = path.loss(way), path.loss(way, "refined")
    subject = f"{path.law}, {path.load}, {way}"
    flat = FLAT if way == "pressed" else ""
    if given["outcome"] != "lost":
        held = given["held_to"]
        end = "the last strain" if given["outcome"] == "held" else "where the path ended"
        if math.isnan(held):
            return f"{subject}: no strain was reached."
        text = f"{subject}: stable up to {three(100.0 * held)} %, {end}{flat}; that holds up to the mesh"
        if refined and refined["outcome"] == "lost":
            text += (
                f", and the refined one loses it at {three(100.0 * refined['strain'])} %, proved for"
                " the discrete cloth"
            )
        return text + "."
    where = number_with_bar(100.0 * (refined or given)["strain"], 100.0 * given["strain_bar"])
    if refined is None or refined["outcome"] != "lost":
        where = three(100.0 * given["strain"])
    if given["scale"] == "micro":
        what = f"a pattern over {int(given['cells_1'])} × {int(given['cells_2'])} cells"
    else:
        what = "localization of the macroscopic law"
    return (
        f"{subject}: the periodic state is first lost at {where} %, to {what} ({given['wave']}){flat}; proved for the"
        " discrete cloth."
    )


def level_rows(path):
    """A row per strain: β on both meshes, its wave, and what that says."""
    finer = {row["strain"]: row for row in path.of_mesh("refined")}
    rows = []
    for row in path.levels:
        if row["mesh"] != "given":
            continue
        if row["outcome"] == "not-reached":
            rows.append([path.law, path.load, f"{three(100.0 * row['strain'])} %", "–", "–", "–",
                         "not reached"])
            continue
        other = finer.get(row["strain"])
        wave = (
            f"long, {three(row['angle_deg'])}°"
            if row["waves"] == "long"
            else f"({three(row['k1'])}, {three(row['k2'])})"
        )
        states = {one["outcome"] for one in (row, other) if one}
        if states == {"unstable-proved"}:
            words = "lost, proved"
        elif states == {"stable-up-to-mesh"}:
            words = "stable, up to the mesh"
        else:
            words = "open: the meshes disagree"
        if "left" in {one["path"] for one in (row, other) if one}:
            words += "; not the state of this load any more: the path jumped to another equilibrium"
        rows.append(
            [path.law, path.load, f"{three(100.0 * row['strain'])} %", three(row["beta"]),
             three(other["beta"]) if other else "–", wave, words]
        )
    return rows


def pattern_sentences(path):
    """What was followed beyond the first loss."""
    sentences = []
    for row in path.patterns:
        subject = (
            f"{path.law}, {path.load}, at {three(100.0 * row['strain'])} %,"
            f" {int(row['cells_1'])} × {int(row['cells_2'])} cells solved as one"
        )
        if row["outcome"] == "found":
            sentences.append(
                f"{subject}: the pattern of the lowest wave was followed to an equilibrium with"
                f" {three(100.0 * row['less_energy'])} % less energy than the periodic state;"
                f" {three(row['largest_per_cell'])} cell sides away from it at most."
            )
        elif row["outcome"] == "no-wave":
            sentences.append(f"{subject}: every wave of these cells is stable; nothing to follow.")
        else:
            sentences.append(
                f"{subject}: the lowest wave was followed, and Newton's method found no equilibrium."
            )
    return sentences


def caption_of(path):
    way = shown_way(path)
    loss = path.loss(way) if way else None
    zone = [row for row in path.waves if row["way"] == way]
    rest = ""
    if loss and zone:
        rest = ZONE.format(
            strain=three(100.0 * zone[0]["strain"]),
            what="just beyond first loss" if loss["outcome"] == "lost" else "the last strain reached",
            mark="star" if loss["waves"] == "finite" else "arrows",
        )
        if any(row["way"] == way for row in path.mode):
            cells = (
                f"the {int(loss['cells_1'])} × {int(loss['cells_2'])} cells over which it repeats"
                if loss["waves"] == "finite"
                else "3 × 3 cells of its endless period"
            )
            rest += MODE.format(cells=cells)
    return CAPTION.format(cell=path.cell, law=path.law, load=path.load, rest=escape(rest))


def stability_contents(stability, gallery):
    """Per cell sentences, a figure per load, and the levels."""
    cells = []
    for name in stability.names():
        paths = stability.of(name)
        cells.append(
            {
                "name": name,
                "sentences": [
                    sentence
                    for path in paths
                    for sentence in [first_loss(path, way) for way in path.ways()]
                    + pattern_sentences(path)
                ],
                "pictures": [
                    gallery.add(
                        stability_figure(path, stability.cells.get(name)),
                        f"stability-{name}-{path.law}-{path.load}",
                        caption_of(path),
                    )
                    for path in paths
                    if path.levels
                ],
                "rows": [row for path in paths for row in level_rows(path)],
            }
        )
    return {"name": stability.name, "cells": cells}
