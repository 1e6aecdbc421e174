# SPDX-License-Identifier: MIT
"""What stands in the report, in its order: draws the figures, fills the tables, words the
sentences.
"""

from dataclasses import dataclass

from figures.animation import MOVING_BYTES
from figures.cloth import workers
from figures.style import seconds, three
from page import tables
from page.answer import answer_of
from page.bend_contents import bend_contents
from page.cell_contents import contents_of_cells
from page.claims import claim_contents, claim_groups, claim_sentence, headings_of_kinds
from page.comparison import comparison_contents, short_table
from page.converge_contents import convergence_contents
from page.drape_contents import drape_contents
from page.entries import bracket_words, stiffness_rows
from page.glossary import GLOSSARY
from page.load_contents import load_contents
from page.plausible import plausible_sentences
from page.run_contents import run_rows, run_sentences, self_tests, whole_sentence
from page.stability_contents import stability_contents
from page.stress_contents import stress_contents
from page.terminal import blocks_of_runs
from read.stiffness import best_run

HEADINGS = {
    "short": "In short",
    "comparison": "What differs",
    "verdicts": "What holds, and what does not",
    "strain": "Error against strain",
    "forces": "Force against strain",
    "stiffness": "Effective stiffness",
    "cells": "The unit cells",
    "sheets": "Reference, up-sampled sheet and error per vertex",
    "budget": "Where the error comes from",
    "validity": "Range of validity",
    "chi": "Characteristic displacements",
    "time": "Error against run time",
    "errors": "Errors at chosen strains",
    "uncertainty": "Error bars of the references",
    "checks": "Checks of the homogenization",
    "notes": "Notes of the run",
    "left-out": "What was left out, and why",
    "glossary": "Glossary",
    "provenance": "Runs, versions, machine",
}
# Sections that a cell without a study has nothing for.
OF_STUDY = ("strain", "forces", "sheets", "budget", "validity", "time", "errors", "uncertainty")
# Headings of every page; the others are those of `homespun strain`.
COMMON = ("verdicts", "notes", "left-out", "glossary", "provenance")
LAST = ("notes", "left-out", "glossary", "provenance")  # behind all scenes and self-tests


def page_contents(results, gallery, output):
    """Everything the template shows.

    @param gallery where figures are saved
    @param output folder of the page, for links to frames
    @throws BadResults where a stored sheet or frame cannot be read
    """
    stress = [
        {**stress_contents(s, gallery), "id": f"stress-{i}"}
        for i, s in enumerate(results.stress, 1)
    ]
    convergence = [
        {**convergence_contents(c, gallery), "id": f"converge-{i}"}
        for i, c in enumerate(results.convergence, 1)
    ]
    loads = [{**load_contents(l, gallery), "id": f"load-{i}"} for i, l in enumerate(results.loads, 1)]
    stability = [
        {**stability_contents(s, gallery), "id": f"stability-{i}"}
        for i, s in enumerate(results.stability, 1)
    ]
    bends = [{**bend_contents(b, gallery), "id": f"bend-{i}"} for i, b in enumerate(results.bends, 1)]
    drapes = contents_of_drapes(results, gallery, output)
    scenes = [d["scene"] for d in drapes]
    for d, drape in zip(drapes, results.drapes):  # one scene may have been run into two folders
        d["name"] = (
            d["scene"] if scenes.count(d["scene"]) == 1 else f"{d['scene']} ({drape.folder})"
        )
    lists_all = any(study.lists_all for study in results.studies)
    strain_shown = bool(results.cells) or not (
        drapes or stress or convergence or loads or stability or bends or lists_all
    )
    comparison = comparison_contents(results, gallery)
    several = len(results.studies) > 1
    notes = [
        f"{study.name}: {note}" if several else str(note)
        for study in results.studies
        for note in study.info.get("notes") or []
    ]
    has_study = bool(results.strain) or "strain" in {study.run.command for study in results.studies}
    sections = Sections(drapes, stress, convergence, loads, stability, bends, strain_shown, has_study)
    headings = headings_of(sections, comparison, notes)
    cells = contents_of_cells(results, gallery)
    reasons = {key: [] for key in ("verdicts", "short", "strain", "forces", "uncertainty")}
    words = {
        "verdicts": "verdicts",
        "strain": "error against strain",
        "forces": "forces of the loads",
        "uncertainty": "error bar",
    }
    for key, word in words.items():
        reasons[key] = [item for item in results.missing if item["what"].startswith(word)]
    reasons["uncertainty"] += [
        item for item in results.missing if item["what"].startswith("energy of the reference")
    ]
    reasons["strain"] += [item for item in results.missing if item["what"] == "time per load step"]
    short = [answer for answer in (answer_of(results, name, gallery) for name in results.cells)]
    short = [
        {
            **(answer or {"name": name, "lines": [], "ratio": None, "side": None, "law": ""}),
            "stiffness": stiffness_rows(results.cells[name]) if is_homogenized(results, name) else [],
            "cut": results.cells[name].place_of_cut(),
            "stiffness_of": bracket_words(results.cells[name]),
            "plausible": plausible_sentences(results.cells[name]),
            "has_bending": best_run(results.cells[name], "D") is not None,
            "table": short_table(results, name) if answer and not comparison else [],
        }
        for name, answer in zip(results.cells, short)
    ]
    if not any(answer["lines"] for answer in short):
        reasons["short"] = [
            {
                "what": "what up-sampling does to the error",
                "why": (
                    "no level was reached, so that no error is known: smaller `--strains` may be"
                    if results.unreached()
                    else "it needs rows of `affine` and `localized` in strain.csv: `homespun strain`"
                    " makes them"
                ),
            }
        ]
    commands = list(dict.fromkeys(c for c in map(command_of, results.studies) if c))
    of_one_verify = len({study.place for study in results.studies}) == 1
    claims = [
        claim_contents(
            v,
            commands,
            study.name if several and not (study.lists_all and of_one_verify) else "",
            results.budget,
        )
        for study, v in results.claims()
    ]
    unreached = tables.unreached_notes(results.unreached())
    return {
        "title": "homespun: "
        + ", ".join(
            list(results.cells)
            or [d["scene"] for d in drapes]
            + list(dict.fromkeys(c["name"] for run in bends + loads + stability for c in run["cells"]))
            + ["stress"] * bool(stress)
            + ["convergence"] * bool(convergence)
        ),
        "lead": lead(sections),
        "comparison": comparison,
        "drapes": drapes,
        "stress": stress,
        "convergence": convergence,
        "loads": loads,
        "stability": stability,
        "bends": bends,
        "strain_shown": strain_shown,
        "summary": summary(results, "strain" if strain_shown and of_one_verify else ""),
        "commands": commands,
        "headings": HEADINGS,
        "shown_headings": headings,
        "contents": list(headings.items()),
        "runs": run_sentences(results),
        "run_rows": run_rows(results),
        "whole": whole_sentence(results),
        "self_tests": self_tests(results, output) if strain_shown else None,
        "claim_groups": claim_groups(
            claims, headings_of_kinds(bool(results.strain or drapes or stress or convergence or bends))
        ),
        "claim_sentence": claim_sentence(claims),
        "in_short": short,
        "pictures_first": strain_shown and not has_study and not comparison,
        "answers": (
            []
            if strain_shown or drapes
            else blocks_of_runs(
                {"bends": bends, "loads": loads, "stability": stability,
                 "convergence": convergence, "stress": stress},
                ("bends", "loads", "stability", "convergence", "stress"),
            )
        ),
        "glossary": GLOSSARY,
        "cells": cells,
        "notes": notes,
        "steps": tables.step_rows(results.steps),
        "fluctuation": tables.fluctuation_sentence(results.steps),
        "uncertainty": tables.uncertainty_rows(results.uncertainty),
        "energies": tables.energy_rows(results.energies),
        "all_left_out": (
            [item for s in results.studies for item in s.info.get("left_out") or []]
            + unreached
            + results.missing
        ),
        "reasons": reasons,
        "provenance": provenance(results),
    }


def contents_of_drapes(results, gallery, output):
    """The scenes one after the other; frames are rendered by all cores."""
    if not results.drapes:
        return []
    limit = min(
        MOVING_BYTES, 2 * MOVING_BYTES // max(1, sum(len(drape.cells) for drape in results.drapes))
    )
    with workers() as pool:
        return [
            {
                **drape_contents(drape, gallery, output, limit, pool, len(results.drapes)),
                "id": f"scene-{i}",
            }
            for i, drape in enumerate(results.drapes, 1)
        ]


def is_homogenized(results, name):
    return results.cells[name].stiffness() is not None


@dataclass
class Sections:
    """What the page shows of each kind of run."""

    drapes: list
    stress: list
    convergence: list
    loads: list
    stability: list
    bends: list
    strain_shown: bool
    has_study: bool


def headings_of(sections, comparison, notes):
    """id -> heading of the sections that this page has, in their order: what speaks of the reader's
    cell, then scenes, then self-tests of the program.
    """
    strain_shown, drapes = sections.strain_shown, sections.drapes
    hidden = {key for key, shown in (("comparison", comparison), ("notes", notes)) if not shown}
    if not sections.has_study:
        hidden.update(OF_STUDY)
    shown = {
        key: text
        for key, text in HEADINGS.items()
        if (strain_shown or key in COMMON + ("comparison",)) and key not in hidden
    }
    headings = {key: text for key, text in shown.items() if key not in LAST}
    if drapes:
        words = "In short: cloth in motion" if strain_shown else "In short"
        if strain_shown:
            headings["drape-short"] = words
        else:  # it is the answer of this page
            headings = {"drape-short": words, **headings}
    headings.update(
        (run["id"], words + (f": {run['name']}" if len(runs) > 1 else ""))
        for runs, words in (
            (sections.bends, "Bent sheets"),
            (sections.loads, "Given stresses and strains"),
            (sections.stability, "Where the cells start to buckle in their plane"),
        )
        for run in runs
    )
    headings.update((d["id"], f"Cloth in motion: {d['name']}") for d in drapes)
    headings.update(
        (c["id"], "Observed orders" + (f": {c['name']}" if len(sections.convergence) > 1 else ""))
        for c in sections.convergence
    )
    headings.update(
        (s["id"], "Stability map" + (f": {s['name']}" if len(sections.stress) > 1 else ""))
        for s in sections.stress
    )
    if not strain_shown and not drapes:  # what was found stands before what it rests on
        headings["verdicts"] = headings.pop("verdicts")
    headings.update((key, text) for key, text in shown.items() if key in LAST)
    return headings


def lead(sections):
    """What the page is about."""
    if sections.strain_shown and not sections.has_study:
        return (
            "One period of a cloth, homogenized: its effective stiffness in the plane and in bending,"
            " between guaranteed bounds, and what it rests on."
        )
    if sections.strain_shown:
        return (
            "How far an up-sampled cloth is from the resolved one: a coarse sheet with the effective"
            " stiffness of its cell, its fine mesh restored from it, compared with fine finite"
            " elements vertex by vertex."
        )
    sentences = []
    if sections.drapes:
        sentences.append(
            "Cloth in motion: a coarse cloth is run through time, its fine mesh restored from it,"
            " and compared with a resolved cloth, vertex by vertex."
        )
    if sections.stress:
        sentences.append(
            "Stability map: how stiff, thin, fine or fast a cell and its cloth may be until an"
            " answer is wrong or refused, and why it ends there."
        )
    if sections.convergence:
        sentences.append(
            "Convergence: how fast errors fall as meshes, cells, strains and time steps become"
            " finer, compared with theory."
        )
    if sections.bends:
        sentences.append(
            "Bent cloth: how far an up-sampled sheet that bends is from the resolved one, in position"
            " and normal, and how much of that edges and the deflection of the cell restore."
        )
    if sections.loads:
        sentences.append(
            "An infinite cloth under given stresses and strains: the cell with its phases, and the"
            " coarse cloth that has its effective stiffness."
        )
    if sections.stability:
        sentences.append(
            "Where the cells start to buckle in their plane: the margin of the cloth's stiffness on"
            " waves over any number of cells, against strain."
        )
    return " ".join(sentences)


def summary(results, command=""):
    """Size and cost of the studies, in one sentence each.

    @param command of the only ones that are named, empty: all
    """
    sentences = []
    for study in (s for s in results.studies if not command or s.run.command == command):
        info, parts = study.info, []
        rows = [r for r in results.strain if r["fine_triangles"] > 0]
        if info.get("cells_per_side") is not None:
            parts.append(f"{info['cells_per_side']} × {info['cells_per_side']} cells")
        if rows and len(results.studies) == 1:
            parts.append(
                f"{int(max(r['coarse_triangles'] for r in rows)):,} coarse and "
                f"{int(max(r['fine_triangles'] for r in rows)):,} fine triangles"
            )
        if info.get("ranks") is not None:
            parts.append(f"{info['ranks']} rank{'s' if info['ranks'] != 1 else ''}")
        if info.get("seconds_total") is not None:
            what = "since it was resumed" if info.get("resumed") else "in all"
            parts.append(f"{seconds(float(info['seconds_total']))} {what}")
        if info.get("peak_memory_bytes") is not None:
            parts.append(
                f"{three(info['peak_memory_bytes'] / 2. ** 30)} GiB of memory at most"
                + (" since then" if info.get("resumed") else "")
            )
        if parts:
            name = f"{study.name}: " if len(results.studies) > 1 and not command else ""
            sentences.append(name + ", ".join(parts) + ".")
    return " ".join(sentences)


def command_of(study):
    """The command that made a folder; where none is stored, the one that all its verdicts name."""
    named = {v.get("command") for v in study.verdicts}
    return study.info.get("command") or (named.pop() if len(named) == 1 else None)


def provenance(results):
    """(name, [(key, value)]) of each study, and of cells homogenized on their own."""
    blocks = [
        (study.folder, study.info["provenance"])
        for study in results.studies
        if study.info.get("provenance")
    ]
    if not blocks:
        blocks = [
            (cell.name, cell.homogenize["provenance"])
            for cell in results.cells.values()
            if (cell.homogenize or {}).get("provenance")
        ]
    return [
        (name, list(value.items()) if isinstance(value, dict) else [("provenance", value)])
        for name, value in blocks
    ]
