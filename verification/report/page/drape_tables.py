# SPDX-License-Identifier: MIT
"""The tables of a draped cloth and its result in words: rows of text out."""
import json
import math

from markupsafe import escape

from figures import style
from figures.drape import (
    light_seconds,
    main_run,
    number,
    ordered_references,
    ordered_variants,
    workers_of,
)
from figures.style import seconds, three
from page import tables
from page.tables import length


def facts(info):
    """Size and time stepping of the scene in one sentence."""
    parts = []
    if info.get("coarse_triangles"):
        parts.append(f"{three(int(info['coarse_triangles']))} coarse triangles")
    if info.get("fine_triangles"):
        vertices = (
            f" with {three(int(info['fine_vertices']))} vertices"
            if info.get("fine_vertices")
            else ""
        )
        parts.append(f"{three(int(info['fine_triangles']))} fine triangles{vertices}")
    if info.get("time_step_s"):
        parts.append(f"steps of {seconds(float(info['time_step_s']))}")
    if info.get("duration_s"):
        parts.append(f"{seconds(float(info['duration_s']))} of motion")
    if info.get("integrator"):
        parts.append(info["integrator"])
    return ", ".join(parts) + "." if parts else ""


def sentences(cell):
    """The result of one cell in words, as HTML: for each reference a sentence of time and one of
    error.
    """
    run = main_run(cell)
    if run is None:
        return []
    light, threads = light_seconds(run), number(run, "threads")
    start = (
        f"One step of the coarse cloth ({escape(run['variant'])}) takes "
        f"{seconds(number(run, 'seconds_per_coarse_step'))} and its up-sampling "
        f"{seconds(number(run, 'seconds_per_upsampling'))}"
    )
    if threads > 0:
        start += f" on {int(threads)} thread{'s' if threads != 1 else ''}"
    if number(run, "cut_steps") > 0:
        of = f" of {three(int(number(run, 'steps')))}" if number(run, "steps") > 0 else ""
        start += f" ({three(int(run['cut_steps']))}{of} steps had to be cut)"
    if not cell.references:
        return [start + ". No reference was computed, so the error is not known (`--references`)."]
    result = []
    order = ordered_references(reference["reference"] for reference in cell.references)
    for reference in sorted(
        cell.references, key=lambda reference: order.index(reference["reference"])
    ):
        slow, name = number(reference, "seconds_per_step"), reference["reference"]
        unknowns = (
            f"{tables.integer(number(reference, 'dofs'))} unknowns"
            if number(reference, "dofs") > 0
            else ""
        )
        who = ", ".join(words for words in (workers_of(reference), unknowns) if words)
        text = f"{start}; a step of the reference <b>{escape(name)}</b> takes {seconds(slow)}"
        text += f" ({who})" if who else ""
        text += (
            f", <b>{three(float(slow / light))} times</b> as long" if slow > 0 and light > 0 else ""
        )
        result.append(f"{text}. {error_sentence(cell, run['variant'], name)}")
        start = "The same coarse step and up-sampling" + (
            f" take {seconds(light)}" if light > 0 else ""
        )
    return result


def rows_of(cell, variant, reference, method):
    """Rows of drape.csv with an error, in the order of time: of that variant of the coarse cloth,
    or of the method's own cloth.
    """
    rows = [
        row
        for row in cell.errors
        if not math.isnan(row["error_mean_m"])
        and row["variant"] in (variant, method)
        and (row["reference"], row["method"]) == (reference, method)
    ]
    return sorted(rows, key=lambda row: row["time_s"])


def error_sentence(cell, variant, reference):
    """Mean error at the end and its maximum over time, with the reference's own error bar."""
    method = cell.info.get("judged_method", "localized")
    rows = rows_of(cell, variant, reference, method)
    if not rows:
        return f"Its error against {escape(reference)} is not known."
    last, worst = rows[-1], max(rows, key=lambda row: row["error_mean_m"])
    bar, sides = last["reference_uncertainty_m"], last["error_mean_per_cell"]
    moved, step = last["displacement_mean_m"], last["time_step_uncertainty_m"]
    by = "" if method == "localized" else f" of {escape(method)}"
    text = f"The mean error{by} per vertex at the end ({three(last['time_s'])} s) is"
    if moved > 0.0:  # what a length is worth, the motion says
        text += f" <b>{three(100.0 * last['error_mean_m'] / moved)} % of the mean displacement</b>,"
    text += f" <b>{length(last['error_mean_m'])}</b>"
    text += "" if math.isnan(sides) else f" ({three(sides)} cell sides)"
    text += f", at most {length(worst['error_mean_m'])} at {three(worst['time_s'])} s"
    text += "; the uncertainty of the reference's mesh is "
    text += "not known" if math.isnan(bar) else length(bar)
    if not math.isnan(step):
        text += f", that of the error from the time step {length(step)}"
        bar += step
    if last["error_mean_m"] <= bar:
        text += ", so that the error at the end is not resolved"
    affine = rows_of(cell, variant, reference, "affine")
    if affine:
        text += (
            f". Without microscopic displacement it is {length(affine[-1]['error_mean_m'])} at"
            " the end"
        )
    return text + "."


def error_rows(cell):
    """For each reference, variant and method: errors at the end and the largest mean error over
    time.
    """
    result = []
    methods = style.ordered_methods(row["method"] for row in cell.errors)
    for reference in ordered_references(row["reference"] for row in cell.errors):
        for variant in ordered_variants(row["variant"] for row in cell.errors):
            for method in methods:
                rows = rows_of(cell, variant, reference, method)
                if not rows:
                    continue
                last, worst = rows[-1], max(rows, key=lambda row: row["error_mean_m"])
                share, bar = last["error_mean_per_fluctuation"], last["reference_uncertainty_m"]
                result.append(
                    [
                        reference,
                        variant,
                        method,
                        length(last["error_mean_m"]),
                        length(last["error_max_m"]),
                        three(last["error_mean_per_cell"]),
                        "–" if math.isnan(share) else f"{three(100. * share)} %",
                        f"{length(worst['error_mean_m'])} at {three(worst['time_s'])} s",
                        "not known" if math.isnan(bar) else length(bar),
                    ]
                )
    return result


def run_rows(cell):
    """One row per variant and reference: what ran, on what, how long a step takes in the middle, in
    the mean and in all but one of twenty cases, and its ratio to the first cloth.
    """
    light = light_seconds(main_run(cell)) if cell.runs else math.nan

    def count(item, key):
        return tables.integer(number(item, key))

    def ratio(value):
        return three(float(value / light)) if light > 0 else "–"

    rows = [
        [
            run["variant"],
            count(run, "steps"),
            count(run, "cut_steps"),
            count(run, "frames"),
            count(run, "ranks"),
            count(run, "threads"),
            count(run, "dofs"),
            seconds(number(run, "seconds_per_coarse_step")),
            seconds(number(run, "seconds_per_coarse_step_mean")),
            seconds(number(run, "seconds_per_coarse_step_95")),
            seconds(number(run, "seconds_per_upsampling")),
            ratio(light_seconds(run)),
        ]
        for run in cell.runs
    ]
    rows += [
        [
            f"reference {item['reference']}",
            count(item, "steps"),
            count(item, "cut_steps"),
            count(item, "frames"),
            count(item, "ranks"),
            count(item, "threads"),
            count(item, "dofs"),
            seconds(number(item, "seconds_per_step")),
            "–",
            "–",
            "–",
            ratio(number(item, "seconds_per_step")),
        ]
        for item in cell.references
    ]
    return rows


def term_rows(info):
    """Each term of the solver: whether it is present, and its parameters or why it is left out."""
    rows = []
    for term in info.get("terms") or []:
        words = term.get("parameters") if term["present"] else term.get("why")
        rows.append([term["name"], "present" if term["present"] else "left out", str(words or "–")])
    return rows


def cost_rows(cell):
    """What a step costs with the terms of the scene, and would cost with one more forced upon it:
    medians with half of the interquartile range.
    """

    def more(value, forced):
        return (
            f"{100. * (forced / value - 1.):+.1f} %".replace("-", "−")
            if value > 0 and forced > 0
            else "–"
        )

    def within(value, spread):
        return seconds(value) if math.isnan(spread) else f"{seconds(value)} ± {seconds(spread)}"

    rows = []
    for row in cell.terms:
        time, forced = row["seconds_per_step"], row["seconds_per_step_forced"]
        memory, forced_memory = row["bytes"], row["bytes_forced"]
        rows.append(
            [
                cell.name,
                row["term"],
                "present" if row["present"] else "left out",
                within(time, row["seconds_spread"]),
                within(forced, row["seconds_spread_forced"]),
                more(time, forced),
                size_of(memory),
                size_of(forced_memory),
                more(memory, forced_memory),
            ]
        )
    return rows


def size_of(value):
    """A memory size in the unit that suits it."""
    if math.isnan(value):
        return "–"
    for limit, factor, unit in ((1e3, 1.0, "B"), (1e6, 1e-3, "kB"), (1e9, 1e-6, "MB")):
        if value < limit:
            return f"{three(float(value * factor))} {unit}"
    return f"{three(float(value * 1e-9))} GB"


def exactly(value):
    """A parameter with all its digits: whoever repeats the run needs them."""
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
