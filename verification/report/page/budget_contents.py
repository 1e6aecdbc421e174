# SPDX-License-Identifier: MIT
"""Error budget, run times and range of validity of one cell: figures, tables and sentences."""
import math

from figures import style
from figures.budget import budget_figure, is_method, way_figure
from figures.style import percent, seconds, three
from read.budget_results import (
    BESIDE_THE_SUM,
    PARTS,
    REGIONS,
    levels,
    pareto_front,
    worst_error,
)

# Of a coarse cloth, a step and up-sampling alone.
STEP = ("seconds_step", "seconds_upsample")
# Cell sides, of which those are named that lie among the ways.
LIMITS = (0.05, 0.01, 0.005, 0.002, 0.001, 0.0005)


def budget_contents(results, name, side, strains, gallery):
    """What the page shows of one cell; what has no data is None or empty.

    @param strains of the figure, those of the other tables
    """
    budget = [row for row in results.budget if row["cell"] == name]
    ways = [row for row in results.run_time if row["cell"] == name]
    contents = {
        "budget": None,
        "budget_rows": budget_rows(budget, strains),
        "region_rows": region_rows(budget, strains),
        "ways": None,
        "way_rows": [],
        "way_sentence": None,
        "front_sentence": None,
        "validity": validity_table([row for row in results.validity if row["cell"] == name]),
    }
    if figure := budget_figure(budget, strains, side):
        contents["budget"] = gallery.add(
            figure,
            f"{name}-budget",
            (
                f"{name}: where the error of localized, the paper's method, comes from. Each part"
                " is a difference of two solutions; its share is its projection on the measured"
                " error, vertex by vertex, so that shares add up and a part that compensates others"
                " counts downwards. Diamond: sum of the parts; the number is what they leave"
                " unexplained, mean length of the difference over that of the measured error. Shares"
                " below 0.5 % are not drawn."
            ),
        )
    if ways:
        load, strain = ways[0]["load"], ways[0]["strain"]
        ways = [w for w in ways if (w["load"], w["strain"]) == (load, strain)]
        contents["way_rows"] = way_rows(ways)
        if figure := way_figure(ways, side):
            contents["ways"] = gallery.add(
                figure,
                f"{name}-ways",
                (
                    f"{name}, {load} at {percent(strain)}: mean error against median run time of"
                    " every way to the positions, against P2 on the full sheet, which stands at"
                    " its own error bar. Numbers: coarse quads per side."
                ),
            )
            contents["way_sentence"] = fastest_sentence(ways, side, load, strain)
            contents["front_sentence"] = front_sentence(ways)
    return contents


def budget_rows(rows, strains):
    """Load, strain, total, then in percent of it each part, what they leave, its bar, as text.
    """
    lines = []
    for (load, strain), regions in ordered(levels(rows)):
        if strain not in strains:
            continue
        parts = regions["all"]
        total = parts["total"]["mean_m"]
        if parts["total"]["mean_per_cell"] < style.ROUND_OFF:
            lines.append([load, percent(strain), "0"] + ["–"] * len(PARTS) + ["–", "–"])
            continue
        lines.append(
            [load, percent(strain), three(parts["total"]["mean_per_cell"])]
            + [share_of(parts[part]["mean_m"], total) if part in parts else "–" for part in PARTS]
            + [
                share_of(parts[part]["mean_m"], total) if part in parts else "–"
                for part in ("unexplained", "unexplained-bar")
            ]
        )
    return lines


def share_of(value, total):
    """In percent of the total: two digits, and `<0.1` for what is there but small."""
    percentage = 100.0 * value / total
    if percentage == 0.0:
        return "0"
    return (
        "<0.1"
        if percentage < 0.1
        else f"{percentage:.2g}"
        if percentage < 10
        else f"{percentage:.0f}"
    )


def region_rows(rows, strains):
    """Mean error and largest parts of interior, boundary layer and corners of the sheets."""
    lines = []
    for (load, strain), regions in ordered(levels(rows)):
        if strain not in strains or style.is_infinite(load):
            continue
        for region in REGIONS:
            parts = regions.get(region)
            if not parts:
                continue
            total = parts["total"]["mean_m"]
            largest = sorted(
                (p for p in PARTS if p in parts and p not in BESIDE_THE_SUM),
                key=lambda p: -parts[p]["mean_m"],
            )[:2]
            lines.append(
                [
                    load,
                    percent(strain),
                    region,
                    three(parts["total"]["mean_per_cell"]),
                    (
                        three(parts["total"]["max_m"] / total * parts["total"]["mean_per_cell"])
                        if total > 0
                        else "–"
                    ),
                    (
                        share_of(parts["unexplained"]["mean_m"], total)
                        if total > 0 and "unexplained" in parts
                        else "–"
                    ),
                    (
                        ", ".join(
                            f"{PARTS[p]} ({share_of(parts[p]['mean_m'], total)} %)" for p in largest
                        )
                        if total > 0
                        else "–"
                    ),
                ]
            )
    return lines


def ordered(table):
    """Levels by load in the order of the design, then by strain."""
    loads = style.ordered_loads(load for load, _ in table)
    return sorted(table.items(), key=lambda item: (loads.index(item[0][0]), item[0][1]))


def way_rows(ways):
    """runtime.csv as text, fastest first, marked where on the front."""
    front = pareto_front(ways)
    return [
        [
            w["way"],
            "●" if w in front else "",
            three(int(w["triangles"])) if w["triangles"] > 0 else "–",
            three(w["error_mean_per_cell"]),
            seconds(w["seconds"]),
            *("–" if math.isnan(w[key]) else seconds(w[key]) for key in STEP),
            f"{w['runs']:.0f}",
            f"{w['ranks']:.0f}",
            f"{w['threads']:.0f}",
            w["note"],
        ]
        for w in sorted(ways, key=lambda w: (math.isnan(w["seconds"]), w["seconds"]))
    ]


def fastest_sentence(ways, side, load, strain):
    """The fastest way to a given error, for the limits that some way keeps, error bar included, and
    some way does not.
    """
    front = pareto_front(ways)
    known = [w["error_mean_per_cell"] for w in ways if not math.isnan(w["error_mean_per_cell"])]
    named, last = [], None
    for limit in LIMITS:
        good = [w for w in front if worst_error(w, side) <= limit]
        if not good or max(known) <= limit:
            continue
        way = min(good, key=lambda w: w["seconds"])
        if last is not None and way is last:
            named[-1] = (limit, way)  # the tightest limit that one way keeps says most
        else:
            named.append((limit, way))
        last = way
    if not named:
        return None
    return (
        "Fastest way to a given mean error, error bar of the best solution included, under"
        f" {load} at {percent(strain)}: "
        + "; ".join(
            f"within {100 * limit:g} % of the cell side {w['way']} ({seconds(w['seconds'])}, error "
            f"{three(100. * w['error_mean_per_cell'])} %)"
            for limit, w in named
        )
        + "."
    )


def front_sentence(ways):
    """Which methods are on the front, and by which way each other one is beaten; None where no
    method has both time and error.
    """
    known = [w for w in ways if w["seconds"] > 0 and not math.isnan(w["error_mean_per_cell"])]
    ladder = [w for w in known if is_method(w["way"])]
    if not ladder:
        return None
    front = pareto_front(known)
    on = [w["way"] for w in front if w in ladder]
    off = []
    for way in ladder:
        if way not in front:
            better = [w for w in front if w["seconds"] <= way["seconds"]][-1]
            off.append(f"{way['way']} by {better['way']}")
    return (
        f"On the front of error against run time: {', '.join(on) or 'none of the methods'}."
        + (f" Beaten in both: {', '.join(off)}." if off else "")
    )


def validity_table(rows):
    """Columns (measure, limit), and one line of text per load, reference and method; notes apart.
    """
    columns = list(dict.fromkeys((row["measure"], row["limit"]) for row in rows))
    loads = style.ordered_loads(row["load"] for row in rows)
    cases = [
        (load, reference, method)
        for load in loads
        for reference in style.ordered_references(r["reference"] for r in rows if r["load"] == load)
        for method in style.ordered_methods(
            r["method"] for r in rows if (r["load"], r["reference"]) == (load, reference)
        )
    ]
    lines, notes = [], []
    for case in cases:
        some = {
            (row["measure"], row["limit"]): row
            for row in rows
            if (row["load"], row["reference"], row["method"]) == case
        }
        line = list(case)
        for column in columns:
            row = some.get(column)
            line.append(validity_text(row) if row else "–")
            if row and row["note"]:
                notes.append((", ".join(case), row["note"]))
        lines.append(line)
    grouped = {}
    for where, note in notes:
        grouped.setdefault(note, [])
        if where not in grouped[note]:
            grouped[note].append(where)
    return {
        "columns": [f"{percent(float(limit))} of the {measure}" for measure, limit in columns],
        "rows": lines,
        "notes": [f"{'; '.join(where)}: {note}" for note, where in grouped.items()],
        "folds": folds_text(rows),
    }


def folds_text(rows):
    """From which radius on D^H holds, a sentence; empty where no row of the cell knows."""
    known = [row["least_radius_m"] for row in rows if not math.isnan(row["least_radius_m"])]
    if not known:
        return ""
    where = f"on rolls of a radius of at least {three(100.0 * known[0])} cm" if known[0] else "always"
    return f"In bending Dᴴ holds to 2 % {where}, along every direction."


def validity_text(row):
    """`3.2 % (3.1 to 3.4)`, `1.3 % (not resolved; up to 9.9 %)`, `> 20 %`, or a dash; with what the
    error bar leaves open in brackets.
    """
    low, high = row["largest_strain_lower"], row["largest_strain_upper"]
    if row["relation"] == "?":
        return "not known"
    if row["relation"] == "-":
        return "–" if math.isnan(high) else f"– (up to {two(high)} %)"
    if row["relation"] == ">":
        strain = row["largest_strain"]
        certain = "" if low >= strain else f" (from {two(low)} %)" if low > 0 else " (not resolved)"
        return f"> {two(strain)} %{certain}"
    if math.isnan(low):
        is_wider = not math.isnan(high) and two(high) != two(row["largest_strain"])
        up_to = f"; up to {two(high)} %" if is_wider else ""
        return f"{two(row['largest_strain'])} % (not resolved{up_to})"
    bar = ""
    if not (math.isnan(low) or math.isnan(high)) and two(low) != two(high):
        bar = f" ({two(low)} to {two(high)})"
    return f"{two(row['largest_strain'])} %{bar}"


def two(strain):
    """Percent with two digits."""
    return f"{float(f'{100. * strain:.2g}'):g}"
