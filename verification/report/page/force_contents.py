# SPDX-License-Identifier: MIT
"""Forces of the loads of one cell: figure, table and sentences."""
import math

from figures import style
from figures.forces import AFFINE, COARSE, RESOLVED, SOLVED, by_strain, differences, force_figure
from figures.style import bar_beside, beside_bar, percent, three


def force_contents(results, name, reference, strains, gallery):
    """What the page shows of one cell; what has no data is None or empty.

    @param reference law beside which the coarse cloth is shown
    @param strains of the table and the sentences
    """
    rows = [row for row in results.forces if row["cell"] == name]
    contents = {
        "force": None,
        "force_rows": force_rows(rows, reference, strains),
        "force_sentences": force_sentences(rows, reference, strains),
    }
    if figure := force_figure(rows, reference):
        contents["force"] = gallery.add(
            figure,
            f"{name}-force-strain",
            f"{name}: force along the motion of the clamp per rest width against strain; under"
            " periodic loads the nominal stress that does the work. Black: the resolved sheet with"
            " its error bar; blue: the coarse cloth, whose force up-sampling does not change;"
            " orange: the force by the energy that the coarse motion, interpolated, has in the"
            " resolved sheet. Below each load how far both are from the resolved sheet"
            f" ({reference}), in percent of its force; a curve at the lower edge is zero to what the"
            " solvers leave; grey: not more than its own error bar, which"
            " says how far the mesh that both sides share is from the limit of fine ones.",
        )
    return contents


def force_rows(rows, reference, strains):
    """Forces at chosen strains, as text."""
    table = []
    for load in style.ordered_loads(row["load"] for row in rows):
        resolved = by_strain(rows, load, reference, RESOLVED)
        others = {
            method: {strain: part for strain, part, _ in differences(rows, load, reference, method)}
            for method in (COARSE, AFFINE)
        }
        coarse = by_strain(rows, load, reference, COARSE)
        for strain in strains:
            if strain not in resolved:
                continue
            row = resolved[strain]
            force, bar = row["force_per_width_N_per_m"], row["reference_uncertainty_N_per_m"]
            text = beside_bar(force, bar)
            table.append(
                [
                    load,
                    percent(strain),
                    text,
                    "–" if math.isnan(bar) else bar_beside(text, force, bar),
                    three(coarse[strain]["force_per_width_N_per_m"]) if strain in coarse else "–",
                    signed(others[COARSE].get(strain, math.nan)),
                    signed(others[AFFINE].get(strain, math.nan)),
                ]
            )
    return table


def signed(part):
    """A part as a percentage with its sign; what the solvers leave is zero."""
    if math.isnan(part):
        return "–"
    if abs(part) < SOLVED:
        return "0"
    return ("+" if part > 0.0 else "") + three(100.0 * part) + " %"


def force_sentences(rows, reference, strains):
    """A sentence per load: by how much the coarse cloth is too stiff or too soft."""
    sentences = []
    for load in style.ordered_loads(row["load"] for row in rows):
        known = {d[0]: d for d in differences(rows, load, reference, COARSE)}
        words = [difference_words(*known[strain]) for strain in strains if strain in known]
        if words:
            sentences.append(
                f"{load}: against the resolved sheet ({reference}) the coarse cloth takes "
                + "; ".join(words)
                + "."
            )
    return sentences


def difference_words(strain, part, bar):
    """1.2 % more force at 1 % strain (bar of the resolved sheet 0.3 %)"""
    if abs(part) < SOLVED:
        return f"the same force at {percent(strain)} strain"
    size = f"{three(100. * abs(part))} % {'more' if part > 0. else 'less'} force"
    words = f"{size} at {percent(strain)} strain"
    if math.isnan(bar):
        return f"{words} (bar of the resolved sheet not known)"
    within = ", not less than the difference" if bar >= abs(part) else ""
    return f"{words} (bar of the resolved sheet {three(100. * bar)} %{within})"
