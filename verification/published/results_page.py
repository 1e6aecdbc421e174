#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes docs/results.md from the published tables: results_page.py FOLDER PAGE

Errors, gains, where a method loses, widths of brackets, claims, and the runs behind them. What the
numbers mean is told in guides/findings.md.
"""
import pathlib
import sys
from statistics import median

from readme_numbers import read_tables

NOTICE = "<!-- Generated: `cmake --build --preset release --target docs` writes this page. -->\n"
ABOUT = """\
Sheets of 20 x 20 cells with the coarse mesh of the paper, two triangles per cell, are pulled
along axis 1 (`strip-1`) and axis 2 (`strip-2`), or sheared in a frame (`shear-frame`). All
methods share one fine mesh with the resolved solution, the reference. Its law is `biot`; for
weaves it is `yarn`. [What was found](../guides/findings.md) discusses these numbers.

An error is the mean distance over all fine vertices, **in 1/1000 of strain x cell side**: an error
of 50 at 1 % strain is 0.05 % of a cell side. The methods are

- *coarse mesh alone* (`affine`): the coarse motion, interpolated;
- *paper* (`localized`): characteristic displacements added as the paper adds them;
- *quadratic* (`localized+p2`): the same on a coarse cloth of quadratic triangles with the same
  vertices;
- `full`: all terms of homespun, on that quadratic coarse cloth.

Two more columns add one term each to the paper's method; weaves have no `cubic+modes`.

"Reference ±" is how far the mesh of the reference is from the limit of fine meshes. Methods and
reference share that mesh, so it is not an error bar of the gain.

**Gains.** *Total* is paper over `full`. It is the product of *element*, what the quadratic coarse
triangles alone bring (paper over quadratic), and of *terms*, what homespun adds to them
(quadratic over `full`).
"""
ERRORS = (  # column of ladder.csv, its heading
    ("affine", "coarse mesh alone"),
    ("localized", "paper"),
    ("localized+edges", "paper + `edges`"),
    ("localized+cubic+modes", "paper + `cubic+modes`"),
    ("localized+p2", "quadratic"),
    ("main", "`full`"),
    ("reference_bar", "reference ±"),
)
GAINS = (  # heading, error before, error after
    ("total", "localized", "main"),
    ("element", "localized", "localized+p2"),
    ("terms", "localized+p2", "main"),
)
STRAINS = (("", "1 % strain"), ("_10", "10 % strain"))


def three(text):
    """A number with three digits; a dash where there is none."""
    if not text:
        return "–"
    value = float(text)
    digits = f"{value:#.3g}"
    return f"{value:.0f}" if "e+" in digits else digits.rstrip(".")


def table(header, rows):
    """A table in Markdown, its numbers to the right."""
    lines = [header, ["---", "---", *["---:"] * (len(header) - 2)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def gain(row, before, after, ending):
    """How many times smaller the second error is, or None."""
    first, second = row[before + ending], row[after + ending]
    return float(first) / float(second) if first and second else None


def errors(rows, ending):
    """All errors at one strain, with their gains."""
    lines = []
    for row in rows:
        gains = [gain(row, before, after, ending) for _, before, after in GAINS]
        lines.append(
            [f"`{row['cell']}`", row["load"], *(three(row[name + ending]) for name, _ in ERRORS),
             *(three(str(value)) if value else "–" for value in gains)]
        )
    return table(["cell", "load", *(title for _, title in ERRORS), *(name for name, *_ in GAINS)],
                 lines)


def summary(rows):
    """Medians and extremes of the gains."""
    lines = []
    for ending, strain in STRAINS:
        for name, before, after in GAINS:
            values = [value for row in rows if (value := gain(row, before, after, ending))]
            lines.append([strain, name, *(three(str(of(values))) for of in (median, min, max)),
                          str(len(values))])
    return table(["strain", "gain", "median", "smallest", "largest", "cases"], lines)


def lost(rows, worse, better):
    """The cases in which one method has the larger error, strain by strain, as a list."""
    items = []
    for ending, strain in STRAINS:
        cases = [
            f"`{row['cell']}` {row['load']}"
            f" ({three(row[worse + ending])} against {three(row[better + ending])})"
            for row in rows
            if row[worse + ending] and row[better + ending]
            and float(row[worse + ending]) > float(row[better + ending])
        ]
        items.append(f"- {strain}, {len(cases)} of {len(rows)}: {', '.join(cases) or 'none'}.")
    return "\n".join(items) + "\n"


def page(tables):
    """The whole page."""
    ladder, brackets, claims = (tables[f"{name}.csv"] for name in ("ladder", "brackets", "claims"))
    out = [NOTICE, "# Results\n", ABOUT, "## Gains in short\n", summary(ladder)]
    for ending, strain in STRAINS:
        out += [f"## Errors at {strain}\n", errors(ladder, ending)]
    out += [
        "## Where a method loses\n",
        "The paper's method is farther from the reference than the coarse mesh alone:\n",
        lost(ladder, "localized", "affine"),
        "`full` is farther than the coarse mesh alone:\n",
        lost(ladder, "main", "affine"),
        "`full` is farther than the quadratic coarse cloth with the paper's displacements:\n",
        lost(ladder, "main", "localized+p2"),
        "The reference's own ± is larger than the error of `full`:\n",
        lost(ladder, "reference_bar", "main"),
        "## Guaranteed brackets on C^H\n",
        "Relative width, on the mesh of the bracket: the shipped one, or where arcs are drawn the one "
        "that resolves them; nothing is refined for a tolerance.\n",
        table(["cell", "triangles", "width"],
              [[f"`{row['cell']}`", row["triangles"], f"{float(row['width']):.2g}"]
               for row in brackets]),
        "## Claims\n",
        "Of the revisions that are named under Runs. Claims that the paper's method is nearer than the "
        "coarse mesh alone, at 1 % and 10 % strain, are newer than these runs: the rows above where it "
        "is farther would fail them.\n",
        table(["command", "cell", "claims", "hold", "open", "fail", "exit status"],
              [[f"`{row['command']}`", f"`{row['of']}`",
                *(row[name] for name in ("claims", "hold", "open", "fail", "exit_status"))]
               for row in claims]),
        "## Runs\n",
        "The fingerprint of inputs, options and revision of each run, and the revision of the"
        " program.\n",
        table(["cell", "run", "revision"],
              [[f"`{row['cell']}`", row["run"], row["revision"]]
               for row in {row["cell"]: row for row in ladder}.values()]),
    ]
    return "\n".join(out)


def main(folder, path):
    """Writes the page of the tables in a folder."""
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page(read_tables(folder)), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
