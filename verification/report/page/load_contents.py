# SPDX-License-Identifier: MIT
"""What the report shows of `homespun periodic load`: curves, where they end, and what the coarse cloth, which
has C^H in place of the cell, makes of the same stresses and strains.
"""
import math

from markupsafe import Markup

from figures.forces import SOLVED
from figures.load import bar_key, known, load_figure
from figures.style import number_with_bar, three
from read.load_results import COMPONENTS

CAPTION = Markup(
    "An infinite cloth of <code>{cell}</code>. Prescribed: {control}. Full lines: the cell with its"
    " phases (shaded: how far its mesh may be from the limit of fine ones); dashed: C<sup>H</sup>"
    " in place of the cell, as a coarse cloth has it; dotted: linear theory, where both are the"
    " same.{measured}"
)


def end_row(path):
    """The last level of a path, component by component."""
    row = path.rows[-1]
    cells = [path.law, path.method, f"{three(100.0 * row['factor'])} %"]
    for c in COMPONENTS:
        cells.append(number_with_bar(100.0 * row[f"strain_{c}"], 100.0 * row[f"strain_{c}_bar"]))
    for c in COMPONENTS:
        key = f"stress_{c}_N_per_m"
        cells.append(number_with_bar(row[key], row[bar_key(key)]))
    return cells + ["yes" if row["stable"] else "no"]


def found(paths):
    """Components that are strained or stressed by more than their bars."""
    some = known(paths, "strain_{}").keys() | known(paths, "stress_{}_N_per_m").keys()
    return [c for c in COMPONENTS if c in some]


def end_sentences(paths):
    """What the cell does at the last level, law by law: its strains and stresses that are not zero."""
    sentences = []
    for path in paths:
        if path.method != "resolved" or (path.law == "linear" and len(paths) > 1):
            continue
        row, words = path.rows[-1], []
        for c in known([path], "strain_{}"):
            words.append(f"strain {c} = {three(100.0 * row[f'strain_{c}'])} %")
        for c in known([path], "stress_{}_N_per_m"):
            words.append(f"stress {c} = {three(row[f'stress_{c}_N_per_m'])} N/m")
        sentences.append(
            f"At {three(100.0 * row['factor'])} % of the load ({path.law}): {', '.join(words)}."
        )
    return sentences


def coarse_sentence(paths):
    """How far the coarse cloth is from the cell at the last level that both reach, per law."""
    sentences = []
    keys = {(path.law, path.method): path for path in paths}
    for law in dict.fromkeys(path.law for path in paths):
        resolved, coarse = keys.get((law, "resolved")), keys.get((law, "coarse"))
        if not resolved or not coarse:
            continue
        a, b = resolved.rows[-1], {row["step"]: row for row in coarse.rows}.get(
            resolved.rows[-1]["step"]
        )
        if b is None:
            continue
        for c in found(paths):
            # What was prescribed is equal; the other one of the pair is what the cloths differ in.
            what, y, factor, unit = f"stress {c}", f"stress_{c}_N_per_m", 1.0, "N/m"
            if a[bar_key(y)] == 0:
                what, y, factor, unit = f"strain {c}", f"strain_{c}", 100.0, "%"
            size, bar = abs(a[y]), a[bar_key(y)]
            if size == 0 or not bar > 0:
                continue
            difference, mesh = abs(b[y] - a[y]) / size, bar / size
            if max(difference, mesh) <= SOLVED:
                sentences.append(f"{law}: {what} of the coarse cloth is that of the cell.")
            elif difference <= mesh:
                sentences.append(
                    f"{law}: {what} of the coarse cloth differs from that of the cell by less than"
                    f" the mesh may ({three(100.0 * difference)} %, the mesh {three(100.0 * mesh)} %)."
                )
            elif a[y] * b[y] < 0.0:
                cell = number_with_bar(factor * a[y], factor * bar)
                sentences.append(
                    f"{law}: {what} of the coarse cloth is {three(factor * b[y])} {unit}, of"
                    f" another sign than that of the cell, {cell} {unit}."
                )
            else:
                sentences.append(
                    f"{law}: {what} of the coarse cloth is {three(100.0 * difference)} %"
                    f" {'larger' if abs(b[y]) > size else 'smaller'} than that of the cell, on the"
                    f" mesh that both share, which leaves {three(100.0 * mesh)} % itself."
                )
    return sentences


def pressed_sentence(paths):
    """What a free cloth does where one of the curves presses it in its plane; empty where none does
    by more than its bar.
    """
    most, where = 0.0, None
    for path in paths:
        for row in path.rows:
            a, b, c = (row[f"stress_{k}_N_per_m"] for k in COMPONENTS)
            bar = max(row[bar_key(f"stress_{k}_N_per_m")] for k in COMPONENTS)
            least = (a + b) / 2.0 - math.hypot((a - b) / 2.0, c)
            if least < most and -least > max(bar, SOLVED * max(abs(a), abs(b), abs(c))):
                most, where = least, path
    if where is None:
        return ""
    return (
        f"Pressed in its plane, to a smallest principal stress of {three(most)} N/m ({where.law},"
        f" {where.method}): a free sheet wrinkles at once, so that the curves are of one that is kept"
        " flat."
    )


def load_contents(load, gallery):
    """Per cell a figure, sentences, and the ends of its paths."""
    cells = []
    for cell in load.cells():
        paths = [path for path in load.of(cell) if path.rows]
        if not paths:
            continue
        measured = f" Signs: measured ({', '.join(load.measured)})." if load.measured else ""
        caption = CAPTION.format(cell=cell, control=load.control, measured=measured)
        cells.append(
            {
                "name": cell,
                "picture": gallery.add(load_figure(load, cell), f"load-{cell}", caption),
                "sentences": end_sentences(paths)
                + [one for one in [pressed_sentence(paths)] if one]
                + coarse_sentence(paths),
                "rows": [end_row(path) for path in paths],
            }
        )
    return {"name": load.name, "control": load.control, "cells": cells}
