# SPDX-License-Identifier: MIT
"""What the report shows of `homespun converge`: per study a figure and the table of its orders."""
import math
from collections import Counter

from markupsafe import Markup

from figures.converge import FIGURES
from figures.style import three
from read.converge_results import STUDIES
from read.verdicts import MARKS, WORDS

TITLES = {
    "mesh": "Mesh of the cell",
    "adaptive": "Adaptive bracket",
    "scale": "Cells per sheet",
    "coarse": "Coarse mesh",
    "edges": "Cells per sheet, with terms of edges",
    "bending": "Cells per sheet, bent",
    "strain": "Strain under periodic loads",
    "time": "Time step",
}
CAPTIONS = {
    "mesh": (
        "Uniform refinement of the cell with P1 and P2: distance of the trace of C<sup>H</sup> from"
        " its Richardson limit. C<sup>H</sup> falls from level to level, because the spaces are"
        " nested. Where phases meet in corners the order is twice their exponents, which are"
        " computed from angles and stiffnesses: orders lie between that of the strongest corner and"
        " that of the smallest exponent above 1, with P1 at most 2. A laminate has its closed form"
        " on every level, and no curve."
    ),
    "adaptive": (
        "Relative width of the bracket on C<sup>H</sup> against DoFs of the displacements: meshes"
        " refined where it is wide (full lines) and everywhere (dashed). Expected of adaptive"
        " meshes is the order of smooth solutions, width ~ DoFs<sup>−1</sup> with P1 and"
        " DoFs<sup>−2</sup> with P2; of uniform ones the exponent of the corners. The bracket of a"
        " laminate closes to round-off on the given mesh, and has no curve."
    ),
    "scale": (
        "Sheets of more and more cells against the linear reference: mean error over all fine"
        " vertices. What the affine motion lacks has the size of a cell: expected order 1 in sheet"
        " sides."
    ),
    "coarse": (
        "Coarse meshes of half a parallelogram per cell side and finer on one sheet. Where a"
        " clamped edge meets a free one the solution is singular with an exponent above ½: orders"
        " between 1 and 2."
    ),
    "edges": (
        "Sheets of more and more cells against the linear reference, with all terms of the method"
        " <i>full</i> and the macro problem resolved: mean error per cell side. On a sheet that"
        " closes along axis 1, clamped below and free above, order 1; corners between clamped and"
        " free edges leave 2λ − 1, with their exponent λ computed from C<sup>H</sup>."
    ),
    "bending": (
        "Sheets of more and more cells that bend, in linear theory, against the resolved plate of"
        " their phases: mean error of the deflection over kL² and of the normal over kL, with the"
        " root mean square k of the macro curvature and the side L of the sheet. <i>affine</i> is"
        " the plate of D<sup>H</sup> alone, expected of order 1; <i>full</i> has the deflection of"
        " the cell, its layers at edges, the rotation slip of clamps and the beams of free edges,"
        " expected of order 2, or of twice the exponent of the corners between clamped and free"
        " edges. The errors with either of the two alone stand in converge.csv as <i>localized</i> and"
        " <i>affine+edges</i>."
    ),
    "strain": (
        "Infinite cloth under periodic loads against the law of the cell, biot or yarn: the"
        " characteristic displacements are linear in strain, so that the error of the localized"
        " positions is expected to fall as strain squared, that of the affine ones as strain."
        " Loads under which it is zero to round-off are not drawn."
    ),
    "time": (
        "Mean error of the positions at the end. Both integrators: the coarse cloth swings down"
        " from one held edge for 40 ms, against the extrapolation of two much finer runs, in sheet"
        " sides. <i>Damped fall</i>: a free cloth falls for half a second and is braked in"
        " proportion to its velocity, against the closed form, in parts of the way that it falls."
    ),
}


def limit_of(series):
    low, high = series.order_lowest, series.order_highest
    if not series.is_band:
        return f"{three((low + high) / 2)} ± {three((high - low) / 2)}"
    return f"{three(low)} to {three(high)}"


def row_of(series):
    """One judged series: where its levels begin and end, what order they show."""
    errors = [e for e in series.column("error") if not math.isnan(e)]
    richardson = "–"
    if not math.isnan(series.richardson_limit) and not math.isnan(series.gci):
        richardson = f"{three(series.richardson_limit)} ± {three(series.gci)}"
    return {
        "cell": series.cell,
        "case": series.case,
        "quantity": series.quantity,
        "p": f"P{series.p}",
        "levels": len(series.rows),
        "dofs": three(int(series.dofs)) if series.dofs > 0 else "–",
        "error": three(errors[-1]) if errors else "–",
        "order": (
            "–" if math.isnan(series.order) else f"{three(series.order)} ± {three(series.spread)}"
        ),
        "limit": limit_of(series),
        "richardson": richardson,
        "verdict": series.judgement,
        "mark": MARKS[series.judgement],
        "word": WORDS[series.judgement],
    }


def convergence_contents(convergence, gallery):
    """Studies in their order, each with a figure (or None) and the rows of its judged series."""
    studies = []
    for study in STUDIES:
        some = convergence.of(study)
        if not some:
            continue
        figure = FIGURES[study](convergence)
        picture = (
            gallery.add(figure, f"converge-{study}", Markup(CAPTIONS[study])) if figure else None
        )
        judged = [s for s in some if s.judgement]
        studies.append(
            {
                "title": TITLES[study],
                "picture": picture,
                "rows": [row_of(s) for s in judged],
                "cells": any(s.cell != "none" for s in judged),
            }
        )
    judged = [s for s in convergence.series if s.judgement]
    count = Counter(s.judgement for s in judged)
    sentence = (
        f"{count['PASS']} of {len(judged)} observed orders lie within their limits,"
        f" {count['FAIL']} outside,"
        f" {count['INCONCLUSIVE']} {'is' if count['INCONCLUSIVE'] == 1 else 'are'} open."
    )
    return {"name": convergence.name, "sentence": sentence, "studies": studies}
