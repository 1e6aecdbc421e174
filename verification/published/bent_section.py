# SPDX-License-Identifier: MIT
"""The section of docs/results.md on sheets that bend, from bending.csv."""
from statistics import median

from numbers_of_page import table, three, with_bar
from readme_numbers import without_twins

HEADING = "## Sheets that bend\n"
ABOUT = """\
Sheets of 10 x 10 cells in linear theory (`homespun bend`), under five loads. The reference is the
resolved plate. An error is the mean over all fine vertices, **in 1/1000 of curvature x cell side²**
for positions and **in 1/1000 of curvature x cell side** for normals, the curvature that of the
homogenized sheet, root mean square. The methods share one homogenized sheet:

- *flat*: two flat triangles per cell, as a coarse cloth is drawn;
- *D^H alone* (`affine`): the smooth homogenized sheet;
- *cell* (`localized`): the deflection of the cell added to it;
- *edges* (`affine+edges`): instead of it the terms of clamped and free edges;
- `full`: both, and the layers of the cell at edges.

`full` is *nearer* or *farther* than its base, the better of *D^H alone* and *edges*, if the two
errors differ by more than the sum of their bars; else it is *open*.
"""
METHODS = (("flat", "flat"), ("affine", "D^H alone"), ("localized", "cell"),
           ("affine+edges", "edges"), ("full", "`full`"))
OUTCOMES = {"PASS": "nearer", "FAIL": "farther", "INCONCLUSIVE": "open"}


def errors(rows):
    """All errors of one quantity."""
    return table(
        ["cell", "load", *(title for _, title in METHODS), "base over `full`", "decided"],
        [
            [f"`{row['cell']}`", row["load"],
             *(with_bar(row, name) for name, _ in METHODS),
             three(str(float(row["base"]) / float(row["full"]))) if row["full"] else "–",
             OUTCOMES[row["full_against_base"]]]
            for row in rows
        ],
    )


def in_short(rows, what):
    """How many rows are decided, the median gain, and each loss by name."""
    rows = without_twins(rows)
    count = {word: sum(OUTCOMES[row["full_against_base"]] == word for row in rows)
             for word in OUTCOMES.values()}
    gains = [float(row["base"]) / float(row["full"]) for row in rows if row["full"]]
    lost = [f"`{row['cell']}` {row['load']}" for row in rows
            if row["full_against_base"] == "FAIL"]
    alone = [f"`{row['cell']}` {row['load']}" for row in rows
             if row["localized_against_affine"] == "FAIL"]
    return (
        f"{what.capitalize()}s, {len(rows)} cases: `full` is nearer than its base in"
        f" {count['nearer']}, farther in {count['farther']}, open in {count['open']}; base over"
        f" `full` has the median {three(str(median(gains)))}. Farther:"
        f" {', '.join(lost) or 'none'}. The deflection of the cell without terms of edges is"
        f" farther than D^H alone in {len(alone)}: {', '.join(alone) or 'none'}.\n"
    )


def section(rows, names):
    """Heading, sentences and tables.

    @param names of the cells that there are
    """
    there = {row["cell"] for row in rows}
    missing = ", ".join(f"`{name}`" for name in names if name not in there)
    out = [HEADING, ABOUT] + [f"Not run yet: {missing}.\n"] * bool(missing)
    for what in dict.fromkeys(row["what"] for row in rows):
        its = [row for row in rows if row["what"] == what]
        out += [in_short(its, what), errors(its)]
    return out
