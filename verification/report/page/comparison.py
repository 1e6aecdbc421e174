# SPDX-License-Identifier: MIT
"""Several cells, or several versions of one, side by side: figures of merit in a table, claims
matched word by word.
"""
import math
import re
from statistics import median

import numpy
from figures import style
from figures.comparison import cells_figure, comparison_figure, moduli_figure
from figures.run_time import METHOD
from figures.style import percent, seconds, three
from page import tables
from page.budget_contents import validity_text
from page.claims import advice_of
from page.differences import differences
from page.entries import ENTRIES, MICRO, entry_texts, with_bar
from read.schema import main_method
from read.stiffness import best_run, centre_and_bars
from read.verdicts import MARKS, ORDER, WORDS
from read.versions import tags

VALIDITY_LIMIT = 0.01  # of a cell side
PART = "(?:homogenize cells/|[a-z]+(?: [a-z]+)?: )"  # what a `verify` writes before a claim
STEP_PARTS = (
    ("coarse solve", "seconds_coarse_solve"),
    ("up-sampling", "seconds_upsample"),
    ("full resolution", "seconds_fine_step"),
)


def comparison_contents(results, gallery):
    """What the page shows, or None with fewer than two cells."""
    subjects = [s for s in results.subjects if s.name in results.cells]
    if len(subjects) < 2:
        return None
    cells = {s.name: results.cells[s.name] for s in subjects}
    matrices = {
        key: {
            name: factor * centre_and_bars(value, key)[0]
            for name, cell in cells.items()
            if (value := best_run(cell, key)) and is_definite(value[key])
        }
        for key, factor in (("C", 1.0), ("D", MICRO))
    }
    rows = {s.name: results.reached(s.name) for s in subjects}
    references = {name: tables.main_reference(some) for name, some in rows.items() if some}
    pictures = (
        (
            comparison_figure(rows, references),
            "comparison-error-strain",
            "Mean error per vertex against strain, in sides of each cell, one panel per load: "
            "the method that the page of each cell speaks of (full lines), the paper's where that is"
            " another one (dots) and the coarse mesh alone (dashes), against "
            + ", ".join(sorted(set(references.values())))
            + ".",
        ),
        (
            moduli_figure(matrices["C"], matrices["D"]),
            "comparison-moduli",
            "Moduli along each direction, of Cᴴ in uniaxial tension"
            + (" and of Dᴴ in the bending of narrow strips." if matrices["D"] else "."),
        ),
        (
            cells_figure(list(cells.values())),
            "comparison-cells",
            "The cells, each with its own scale; lines along axis 1 of the materials that have axes.",
        ),
    )
    return {
        "names": [s.name for s in subjects],
        "differences": differences(results, subjects),
        "groups": groups_of(results, subjects),
        "pictures": [gallery.add(*picture) for picture in pictures if picture[0]],
        "claims": claims_side_by_side(results, subjects),
    }


def is_definite(matrix):
    return numpy.linalg.eigvalsh(numpy.array(matrix, dtype=float)).min() > 0.0


def short_table(results, name):
    """The same table of a single cell, without its stiffness: what errors and times come to."""
    subjects = [s for s in results.subjects if s.name == name]
    return kept_of(measure_groups(results, subjects)) if subjects else []


def groups_of(results, subjects):
    """[(heading, [(row name, [text per subject])])], rows in which no subject has a value left out.
    """
    return kept_of(
        [
            ("Effective stiffness [N/m]", stiffness_rows(results, subjects)),
            ("Bending stiffness [10⁻⁶ N m]", bending_rows(results, subjects)),
        ]
        + measure_groups(results, subjects)
    )


def measure_groups(results, subjects):
    """Range of validity, errors at the chosen strains, times."""
    groups = [
        (
            "Largest strain whose mean error stays within 1 % of the cell side, in square brackets"
            " of the paper's method where another one stands here",
            validity_rows(results, subjects),
        ),
    ]
    for strain in tables.CHOSEN_STRAINS:
        groups.append(
            (
                (
                    f"Mean error at {percent(strain)} strain [1/1000 of the cell side], in brackets of"
                    " its coarse cloth, not up-sampled, and of the paper's method where another one"
                    " stands here, and of the coarse mesh alone"
                ),
                error_rows(results, subjects, strain),
            )
        )
    groups.append(("Median time per load step of the sheets", time_rows(results, subjects)))
    return groups


def kept_of(groups):
    """Groups without the rows in which no subject has a value."""
    kept = [
        (heading, [row for row in rows if any(text != "–" for text in row[1])])
        for heading, rows in groups
    ]
    return [(heading, rows) for heading, rows in kept if rows]


def stiffness_rows(results, subjects):
    """All six entries of C^H with their bars, what they rest on, and the areal density."""
    cells = [results.cells[s.name] for s in subjects]
    texts = [entry_texts(cell, "C") for cell in cells]
    rows = [(f"C{name}", [with_bar(text[name]) for text in texts]) for name, _, _ in ENTRIES]
    brackets = [tables.stiffness_table(cell)["bracket"] for cell in cells]
    rows.append(
        (
            "width of the guaranteed bracket of the meshed cell, relative",
            [bracket or "–" for bracket in brackets],
        )
    )
    densities = [(cell.homogenize or {}).get("areal_density") for cell in cells]
    rows.append(
        ("areal density [kg/m²]", [three(float(value)) if value else "–" for value in densities])
    )
    return rows


def bending_rows(results, subjects):
    """All six entries of D^H with their bars."""
    texts = [entry_texts(results.cells[s.name], "D", MICRO) for s in subjects]
    return [(f"D{name}", [with_bar(text[name]) for text in texts]) for name, _, _ in ENTRIES]


def loads_of(results, subjects):
    return style.ordered_loads(row["load"] for s in subjects for row in results.reached(s.name))


def validity_rows(results, subjects):
    rows = []
    for load in loads_of(results, subjects):
        texts = []
        for s in subjects:
            some = [
                row
                for row in results.validity
                if row["cell"] == s.name
                and row["load"] == load
                and float(row["limit"]) == VALIDITY_LIMIT
                and row["measure"].startswith("cell")
            ]
            reference = tables.main_reference(some)
            here = {
                row["method"]: validity_text(row) for row in some if row["reference"] == reference
            }
            best = main_method(here)
            beside = f" [{here[METHOD]}]" if best != METHOD and METHOD in here else ""
            texts.append(here.get(best, "–") + beside)
        rows.append((load, texts))
    return rows


def error_rows(results, subjects, strain):
    rows = []
    for load in loads_of(results, subjects):
        texts = []
        for s in subjects:
            some = results.reached(s.name)
            reference = tables.main_reference(some)
            here = {
                row["method"]: row["error_mean_per_cell"]
                for row in some
                if row["load"] == load
                and row["reference"] == reference
                and math.isclose(row["strain"], strain, rel_tol=1e-6)
            }
            best = main_method(here)
            base = next(
                (
                    gain["base"]
                    for gain in results.gains
                    if (gain["cell"], gain["load"], gain["reference"], gain["method"])
                    == (s.name, load, reference, best)
                    and math.isclose(gain["strain"], strain, rel_tol=1e-6)
                ),
                None,
            )
            beside = (
                ""
                if best == METHOD
                else f"{thousandths(here.get(base))}; {thousandths(here.get(METHOD))}; "
            )
            texts.append(
                f"{thousandths(here[best])} ({beside}{thousandths(here.get('affine'))})"
                if best in here
                else "–"
            )
        rows.append((load, texts))
    return rows


def thousandths(value):
    if value is None or math.isnan(value):
        return "–"
    return "0" if value < style.ROUND_OFF else three(1000.0 * value)


def time_rows(results, subjects):
    """Of the law that the first screen speaks of."""
    law = {s.name: tables.main_reference(results.reached(s.name)) for s in subjects}
    steps = {
        s.name: [
            row
            for row in results.steps
            if row["cell"] == s.name
            and row["reference"] == law[s.name]
            and not style.is_infinite(row["load"])
        ]
        for s in subjects
    }
    rows = []
    for name, key in STEP_PARTS:
        values = {s: [row[key] for row in some if row[key] > 0] for s, some in steps.items()}
        rows.append(
            (name, [seconds(median(values[s.name])) if values[s.name] else "–" for s in subjects])
        )
    ratios = []
    for s in subjects:
        some = [
            row["seconds_fine_step"] / (row["seconds_coarse_solve"] + row["seconds_upsample"])
            for row in steps[s.name]
            if row["seconds_coarse_solve"] + row["seconds_upsample"] > 0
            and row["seconds_fine_step"] > 0
        ]
        ratios.append(three(float(median(some))) if some else "–")
    rows.append(("full resolution over the other two", ratios))
    return rows


def key_of(claim, cell, part=""):
    """A claim without the name of its cell, by which those of two cells are matched; None where it
    does not begin with it.

    @param part pattern of what stands before the name
    """
    found = re.match(rf"({part}){re.escape(cell)}(?=[:, ])", claim)
    return f"{found[1]}…{claim[found.end():]}" if found else None


def claims_side_by_side(results, subjects):
    """Blocks of claims, each once: {"names", "rows", "held", "differ"}. A row is a claim, a column a
    run: of claims that name a cell each cell, of those of whole studies each version.
    """
    table, general = {}, {}
    names = sorted({s.cell for s in subjects}, key=len, reverse=True)
    for study, verdict in results.claims():
        keys = {name: key_of(verdict["claim"], name, PART if study.lists_all else "")
                for name in names}
        cell = next((name for name in names if keys[name]), None)
        if cell is None:
            general.setdefault(verdict["claim"], {})[study.place] = verdict
            continue
        subject = next((s for s in subjects if s.cell == cell and s.place == study.place), None)
        if subject:
            known = table.setdefault(keys[cell], {})
            # What a study and the homogenization beside it both say is said by the worse of them.
            one = known.get(subject.name)
            if one is None or ORDER[verdict["verdict"]] < ORDER[one["verdict"]]:
                known[subject.name] = verdict
    blocks = [block(table, [s.name for s in subjects], [s.name for s in subjects])]
    places = list(dict.fromkeys(place for some in general.values() for place in some))
    of_place = tags(places)
    blocks.append(block(general, places, [of_place[place] for place in places]))
    return [one for one in blocks if one["rows"] or one["held"]]


def limit_of(verdicts):
    """The limit of a claim, where runs have one each all of them.

    @param verdicts {name of a run: its verdict}
    """
    limits = {name: tables.shown(verdict.get("limit", "")) for name, verdict in verdicts.items()}
    if len(set(limits.values())) == 1:
        return next(iter(limits.values()))
    return "; ".join(f"{name}: {limit}" for name, limit in limits.items())


def block(table, columns, names):
    """Claims that do not hold in each column, those whose verdicts differ first; and those that do.
    """
    rows = []
    for claim, some in table.items():
        verdicts = {verdict["verdict"] for verdict in some.values()}
        worst = min(some.values(), key=lambda verdict: ORDER[verdict["verdict"]])
        rows.append(
            {
                "claim": claim,
                "differs": len(verdicts) > 1,
                "holds": verdicts == {"PASS"},
                "advice": "" if verdicts == {"PASS"} else advice_of(worst),
                "entries": [
                    (
                        {
                            "verdict": some[c]["verdict"],
                            "word": WORDS[some[c]["verdict"]],
                            "mark": MARKS[some[c]["verdict"]],
                            "value": tables.shown(some[c].get("value")),
                        }
                        if c in some
                        else None
                    )
                    for c in columns
                ],
                "limit": limit_of({names[k]: some[c] for k, c in enumerate(columns) if c in some}),
            }
        )
    rows.sort(key=lambda row: not row["differs"])
    return {
        "names": names,
        "rows": [row for row in rows if not row["holds"]],
        "held": [row for row in rows if row["holds"]],
        "differ": sum(row["differs"] for row in rows),
    }
