# SPDX-License-Identifier: MIT
"""The tables of the report and its sentences in words: results in, rows of text out."""
import math
from statistics import median

import numpy

from figures import style
from figures.run_time import METHOD
from figures.strain import errors_are_round_off
from figures.style import number_with_bar, percent, seconds, three
from page.bars import bar_of
from page.entries import ENTRIES, bracket_words, entry_texts, used_stiffnesses
from read import schema
from read.cell_results import relative_width
from read.stiffness import best_run, homogenized

CHOSEN_STRAINS = (0.01, 0.1)


def main_reference(rows):
    """The law that the coarse solver's own energy matches, or the first of the file."""
    return schema.main_reference(row["reference"] for row in rows)


def nearest_strains(rows):
    """The strains of the rows that lie nearest to the chosen ones, each once."""
    strains = sorted({row["strain"] for row in rows})
    chosen = []
    for wanted in CHOSEN_STRAINS if strains else ():
        best = min(strains, key=lambda s: abs(math.log(s / wanted)))
        if best not in chosen:
            chosen.append(best)
    return chosen


def length(value):
    """A length in the unit that suits it."""
    if value is None or math.isnan(value):
        return "–"
    for limit, factor, unit in ((1e-6, 1e9, "nm"), (1e-3, 1e6, "µm"), (1.0, 1e3, "mm")):
        if value < limit:
            return f"{three(float(factor * value))} {unit}"
    return f"{three(float(value))} m"


def length_with_bar(value, bar):
    """A length and how far it may be off, in one unit: 3.75 ± 0.50 µm."""
    text = length(value)
    if not bar > 0.0 or math.isnan(value) or text == "–":
        return text
    unit = text.rpartition(" ")[2]
    factor = {"nm": 1e9, "µm": 1e6, "mm": 1e3, "m": 1.0}[unit]
    return f"{number_with_bar(factor * value, factor * bar)} {unit}"


def error_tables(rows, methods, gains):
    """Errors and gains at the chosen strains.

    @return list of {"strain", "methods", "rows": [{"load", "reference", "uncertainty", "errors"}],
            "gains": gain_rows()}; an error is {"text", "share", "resolved"}
    """
    tables = []
    for strain in nearest_strains(rows):
        lines = []
        here = [row for row in rows if row["strain"] == strain]
        for load in style.ordered_loads(row["load"] for row in here):
            for reference in style.ordered_references(
                r["reference"] for r in here if r["load"] == load
            ):
                some = {
                    r["method"]: r
                    for r in here
                    if r["load"] == load and r["reference"] == reference
                }
                bar = next(iter(some.values()))["reference_uncertainty_m"]
                lines.append(
                    {
                        "load": load,
                        "reference": reference,
                        "uncertainty": "not known" if math.isnan(bar) else length(bar),
                        "errors": [error_entry(some.get(method)) for method in methods],
                    }
                )
        tables.append(
            {
                "strain": percent(strain),
                "methods": methods,
                "rows": lines,
                "gains": gain_rows([row for row in gains if row["strain"] == strain]),
            }
        )
    return tables


def gain_rows(gains):
    """gains.csv as text, by load: what a coarse cloth is worth, and what up-sampling is on it."""
    loads = style.ordered_loads(row["load"] for row in gains)
    return [
        [row["load"], row["reference"], row["method"], row["base"]]
        + [three(row[f"gain_{key}"]) for key in ("of_coarse_cloth", "of_upsampling", "total")]
        for load in loads
        for row in gains
        if row["load"] == load
    ]


def error_entry(row):
    if row is None:
        return {"text": "–", "share": "", "resolved": True}
    if row["error_mean_per_cell"] < style.ROUND_OFF:
        return {"text": "0", "share": "to round-off", "resolved": True}
    share = row["error_mean_per_fluctuation"]
    return {
        "text": length(row["error_mean_m"]),
        "share": "" if math.isnan(share) else f"{three(100. * share)} %",
        "resolved": not row["error_mean_m"] <= bar_of(row),
    }


def matrix_rows(matrix):
    """A 3 x 3 matrix as text; what is below 1e-9 of the largest entry is printed as zero."""
    if matrix is None:
        return None
    scale = numpy.abs(matrix).max()
    return [[three(float(v)) if abs(v) > 1e-9 * scale else "0" for v in row] for row in matrix]


def stiffness_table(cell):
    """C^H, its bracket, Voigt, Reuss and the engineering moduli of a cell."""
    value = best_run(cell, "C") or {}
    engineering = value.get("engineering") or {}
    units = {"E1": "N/m", "E2": "N/m", "G12": "N/m"}
    texts = entry_texts(cell, "C")
    lower, upper = (
        None if value.get(key) is None else numpy.array(value[key], dtype=float)
        for key in ("C_lower", "C_upper")
    )
    bracket = None
    if (
        lower is not None
        and upper is not None
        and not math.isnan(width := relative_width(lower, upper))
    ):
        bracket = three(width)
    facts = [(key, f"{shown(v)} {units.get(key, '')}".strip()) for key, v in engineering.items()]
    for key, name, unit in (
        ("areal_density", "areal density", "kg/m²"),
        ("area", "area of the cell", "m²"),
        ("dofs", "degrees of freedom", ""),
        ("iterations", "iterations", ""),
        ("seconds", "seconds", ""),
    ):
        if value.get(key) is not None:
            facts.append((name, f"{shown(value[key])} {unit}".strip()))
    return {
        "matrices": [
            (name, rows)
            for name, rows in (
                ("C^H", matrix_rows(homogenized(cell))),
                ("Voigt", matrix_rows(cell.stiffness("voigt"))),
                ("Reuss", matrix_rows(cell.stiffness("reuss"))),
            )
            if rows
        ],
        "entries": [[f"C{name}", *texts[name]] for name, _, _ in ENTRIES],
        "words": bracket_words(cell),
        "used": used_stiffnesses(cell),
        "bracket": bracket,
        "bracket_of": value.get("bracket_of", "mesh"),
        "bracket_remark": (value.get("bracket") or {}).get("remark"),
        "facts": facts,
    }


def shown(value):
    """Any value of a JSON file, numbers with three digits."""
    if isinstance(value, dict):
        return ", ".join(f"{key} {shown(v)}" for key, v in value.items())
    if isinstance(value, (list, tuple)):
        return ", ".join(shown(v) for v in value)
    return three(value) if isinstance(value, (int, float)) or value is None else str(value)


def directions(angles):
    """The angles of a group that differ from triangle to triangle, as text."""
    known = [angle for angle in angles if isinstance(angle, (int, float))]
    return (
        f"{three(float(min(known)))} to {three(float(max(known)))}, {len(angles)} directions"
        if known
        else "–"
    )


def phase_rows(cell):
    """Material parameters of each phase, as text."""
    rows = []
    for phase in cell.phases or []:

        def number(key, factor=1.0):
            try:
                return three(float(phase[key]) * factor)
            except (KeyError, TypeError, ValueError):
                return "–"

        rows.append(
            [
                str(phase.get("name", "?")),
                number("E1", 1e-6),
                number("E2", 1e-6),
                number("nu12"),
                number("G12", 1e-6),
                directions(phase["angles"]) if "angles" in phase else number("angle"),
                number("thickness", 1e3),
                number("density"),
            ]
        )
    return rows


def in_percent(value):
    return "–" if math.isnan(value) else f"{three(100.0 * value)} %"


def uncertainty_rows(rows):
    """uncertainty.csv as text."""
    return [
        [
            row["cell"],
            row["load"],
            row["reference"],
            percent(row["strain"]),
            integer(row["cells"]),
            length(row["p1_minus_p2_m"]),
            length(row["p1_minus_refined_p2_m"]),
            length(row["p2_minus_refined_p2_m"]),
            three(row["uncertainty_per_strain_and_side"]),
            three(row["uncertainty_max_per_strain_and_side"]),
            in_percent(row["force_uncertainty"]),
        ]
        for row in rows
        if row["method"] == "reference"
    ]


def energy_rows(rows):
    """Energies of cross-checks.csv as text: the lower side and distances in percent of the upper one."""
    return [
        [
            row["cell"],
            row["load"],
            integer(row["cells"]),
            three(row["energy_upper_J"]),
            in_percent(row["energy_p2_J"] / row["energy_upper_J"]),
            in_percent(row["energy_lower_J"] / row["energy_upper_J"]),
            in_percent(row["error_bar_energy_norm"]),
            in_percent(row["p1_minus_p2_energy_norm"]),
        ]
        for row in rows
    ]


def step_rows(rows):
    """Levels of levels.csv as text, medians over strains, with the ratio of fine step to the coarse one.
    """
    groups = {}
    for row in rows:
        groups.setdefault((row["cell"], row["load"], row["reference"]), []).append(row)
    result = []
    for (cell, load, reference), some in groups.items():

        def middle(key, some=some):
            values = [row[key] for row in some if not math.isnan(row[key])]
            return median(values) if values else math.nan

        light = middle("seconds_coarse_solve") + middle("seconds_upsample")
        # An endless cloth has no coarse solve: nothing was computed that could be faster.
        both = middle("seconds_coarse_solve") > 0
        ratio = middle("seconds_fine_step") / light if both else math.nan
        result.append(
            [
                cell,
                load,
                reference,
                three(len(some)),
                seconds(middle("seconds_coarse_solve")),
                seconds(middle("seconds_upsample")),
                seconds(middle("seconds_fine_step")),
                three(ratio),
                integer(middle("coarse_iterations")),
                integer(middle("fine_iterations")),
                integer(middle("fine_dofs")),
                integer(middle("ranks")),
            ]
        )
    return result


def fluctuation_sentence(rows):
    """Which law the homogenized sheets have, what they cost, and how far their own mesh moves the
    fluctuation.
    """
    known = [row for row in rows if row["fluctuation_m"] > 0.0]
    if not known:
        return ""
    beside = {}
    for row in known:
        if row["homogenized_law"]:
            beside.setdefault(row["homogenized_law"], set()).add(row["reference"])
    laws = "; ".join(
        f"{law} beside {' and '.join(style.ordered_references(references))}"
        for law, references in sorted(beside.items())
    )
    times = [
        row["seconds_homogenized_sheet"] for row in known if row["seconds_homogenized_sheet"] > 0.0
    ]
    moved = [
        row["fluctuation_bar_m"] / row["fluctuation_m"]
        for row in known
        if not math.isnan(row["fluctuation_bar_m"])
    ]
    words = [f"law of that sheet: {laws}"] * bool(laws)
    if times:
        words.append(f"it takes {seconds(median(times))} a level (median)")
    if moved:
        words.append(
            "from a sheet half as fine the fluctuation differs by at most"
            f" {three(100. * max(moved))} %"
        )
    text = "; ".join(words)
    return text[:1].upper() + text[1:] + "." if text else ""


def integer(value):
    return "–" if math.isnan(value) else three(int(value))


def unreached_notes(rows):
    """One sentence for each load and reference with strains that its solver could not reach."""
    groups = {}
    for row in rows:
        groups.setdefault((row["cell"], row["load"], row["reference"]), set()).add(row["strain"])
    return [
        {
            "what": f"{cell}, {load}, reference {reference} at "
            + ", ".join(percent(s) for s in sorted(strains)),
            "why": (
                "no equilibrium of the reference or of the coarse cloth was found there, or at a"
                " strain below"
            ),
        }
        for (cell, load, reference), strains in groups.items()
    ]


def round_off_sentences(rows):
    """Where the localized error vanishes, in words: such a curve has no slope to read."""
    sentences = []
    for load in style.ordered_loads(row["load"] for row in rows):
        zero = [
            reference
            for reference in style.ordered_references(row["reference"] for row in rows)
            if errors_are_round_off(
                [
                    r
                    for r in rows
                    if r["load"] == load and r["method"] == METHOD and r["reference"] == reference
                ]
            )
        ]
        if zero:
            sentences.append(
                f"{load}: the error of {METHOD} is zero to round-off (below "
                f"{style.ROUND_OFF_TEXT}) against {', '.join(zero)}."
            )
    return sentences
