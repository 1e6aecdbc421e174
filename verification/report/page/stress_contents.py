# SPDX-License-Identifier: MIT
"""What the page shows of `homespun stress`: how far each axis goes, and why it ends there."""
from figures.stress import limits_figure
from figures.style import seconds, three

COLUMNS = ("axis", "of", "value_is", "reached", "end", "error", "limit", "theory")
ENDED = {
    "error": "the answer is wrong",
    "solver": "refused",
    "repetition": "other numbers when repeated",
    "cap": "not tried further",
    "ladder": "did not end",
}


def number(value):
    return three(value) if value == value else "–"


def axis_of(row):
    """One axis as the template shows it."""
    return {
        **{key: row[key] for key in ("axis", "of", "value_is", "criterion", "theory_is")},
        **{key: number(row[key]) for key in ("reached", "end", "error", "limit", "theory")},
        "ended": ENDED[row["ended_by"]],
        "why": row["why"] if row["end"] == row["end"] or row["ended_by"] == "cap" else "",
        "seconds": seconds(row["seconds"]),
    }


def rung_of(row):
    """One value as the template shows it."""
    return [
        row["axis"],
        row["of"],
        three(row["value"]),
        number(row["error"]),
        *(number(row[key]) for key in ("iterations", "dofs")),
        seconds(row["seconds"]),
        row["outcome"],
    ]


def stress_contents(stress, gallery):
    """A sentence, the picture of the map, its axes and their values."""
    rows = stress.rows
    count = {name: sum(row["ended_by"] == name for row in rows) for name in ENDED}
    figure = limits_figure(rows)
    return {
        "name": stress.name,
        "sentence": (
            f"{len(rows)} axes: {count['ladder'] + count['cap']} did not end,"
            f" {count['error'] + count['repetition']} end where the answer is wrong,"
            f" {count['solver']} where it is refused."
        ),
        "pictures": [] if figure is None else [gallery.add(
            figure,
            "stress-limits",
            (
                f"{'H' if stress.name == 'stress' else stress.name + ': h'}ow far each axis goes:"
                " the bar ends at the largest value that is right, the cross is the first that is"
                " wrong or refused. Black: where theory estimates the end, or promises that there"
                " is none before."
            ),
            table=(list(COLUMNS), [["" if row[key] != row[key] else row[key] for key in COLUMNS]
                                   for row in rows]),
        )],
        "axes": [axis_of(row) for row in rows],
        "values": [rung_of(row) for row in stress.values],
    }
