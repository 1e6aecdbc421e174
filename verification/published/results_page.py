#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes docs/results.md from the published tables, and the table of gains in README.md:
results_page.py FOLDER PAGE README

Errors, gains, where a method loses, widths of brackets, claims, and the runs behind them. What the
numbers mean is told in guides/findings.md.
"""
import pathlib
import re
import sys
from statistics import median

import bent_section
from make import names_of, variants
from numbers_of_page import LETTERS, UNBROKEN, table, three, with_bar
from peers_section import section
from readme_numbers import is_lost, read_tables, without_twins

SOURCES = pathlib.Path(__file__).resolve().parents[2]
NOTICE = "<!-- Generated: `cmake --build --preset release --target docs` writes this page. -->\n"
ABOUT = """\
Sheets of 20 x 20 cells with the coarse mesh of the paper, two triangles per cell, are pulled
along axis 1 (`strip-1`) and axis 2 (`strip-2`), or sheared in a frame (`shear-frame`). All
methods share one fine mesh with the resolved solution, the reference. Its law is `biot`; for
weaves it is `yarn`. [What was found](../guides/findings.md) discusses these numbers.

An error is the mean distance over all fine vertices, **in 1/1000 of strain x cell side**: an error
of 50 at 1 % strain is 0.05 % of a cell side. ± is its error bar: how much it may change as meshes
get finer. The methods are

- *coarse mesh alone* (`affine`): the motion of linear coarse triangles, interpolated;
- *paper* (`localized`): characteristic displacements added to it as the paper adds them;
- `full`: all terms of homespun, on quadratic coarse triangles with the same vertices;
- *base*: the coarse cloth of `full` without up-sampling. Of two such cloths, the one with the
  smaller error is the base of a row: *a* is `full-micro`, with the terms of edges of the coarse
  cloth, *b* is `affine+p2`, without them.

**Gains.** A gain is an error over an error: 2 is half the error, 1 is no gain.

- *coarse cloth*: coarse mesh alone over base. It needs no up-sampling: a sheet of one material has
  it, too.
- *up-sampling*: base over `full`. It is 1 on a sheet of one material.
- *both*: coarse mesh alone over `full`, the product of the two.
- *over paper*: paper over `full`. The better coarse cloth is a part of it.

**Decided.** `full` is *nearer* than its base or *farther* if the two errors differ by more than the
sum of their bars. Otherwise the row is open: *bars*, they differ by less; *bars x 3*, the errors on
three discretizations do not converge, so that their bars, with a factor of safety of 3 instead of
1.25, decide nothing however far apart the errors are; *law*, the law loses ellipticity at the strain
given, beyond which no minimum need exist.

**Bars of weaves in strips are too small here.** What the turning of their yarns adds to a bar was carried
from small sheets to these as if it fell with the size, and where the law is not reached at 5 % strain it
was not measured at all. The program measures and carries it now; these runs were made before.
"""
SETS = {"cells": "patches, stripes, holes", "weaves": "weaves", "drawn weaves": "weaves drawn by chance"}
DRAWN = """\
The method was developed on the cells and weaves above. These {all} it had not seen: count, sett and
cover of their yarns were drawn by chance and stored before any of them was run. Run at this size so
far: {there} of the {all}.
"""
SHORT = """\
Medians, in brackets smallest and largest, of the cases in which the law holds, open ones included;
how many cases are *nearer*, *farther* or *open*; and in how many, decided by the same rules, the
paper's method is farther from the reference than the coarse mesh alone. Where a cell looks the same
along both axes, errors in `strip-1` and `strip-2` differ by less than their bars: they are one case.
"""
ONE_CHANGE = """\
`full` differs from the paper's method in its terms and in its coarse triangles, which are quadratic.
These are the same errors over each other with one thing changed at a time: *terms*, of the paper's
method over those of `full`, once on linear triangles and once on quadratic ones; *quadratic
triangles*, of linear triangles over quadratic ones, once with the paper's terms (`localized` over
`localized+p2`) and once with those of `full` (`full-p2` over `full`); and *up-sampling on linear
triangles*, of the better of `affine` and `full-p2-micro` over `full-p2`. –: not run, or no case in
which the law holds.
"""
HEADING = "gain of"
NOT_RUN = "Not run yet at this size:"
METHODS = (("affine", "coarse mesh alone"), ("base", "base"), ("localized", "paper"),
           ("full", "`full`"))
GAINS = {
    "gain_of_coarse_cloth": "coarse cloth",
    "gain_of_upsampling": "up-sampling",
    "gain_total": "both",
    "gain_over_localized": "over paper",
}
CHANGES = {  # title: errors whose smallest is divided by that of the last
    "terms, on linear triangles": ("localized", "full_linear"),
    "terms, on quadratic ones": ("localized_p2", "full"),
    "quadratic triangles, paper": ("localized", "localized_p2"),
    "quadratic triangles, `full`": ("full_linear", "full"),
    "up-sampling on linear triangles": ("affine", "full_linear_base", "full_linear"),
}
OUTCOMES = {"PASS": "nearer", "FAIL": "farther", "INCONCLUSIVE": "open"}
UNCONFIRMED = 3.0  # factor of safety of a bar that no convergence supports
LOSSES = (  # sentence, method, what it is compared with, the claim on it
    ("The paper's method is farther from the reference than the coarse mesh alone",
     "localized", "affine", "localized_against_affine"),
    ("`full` is farther than its base", "full", "base", "full_against_base"),
    ("`full` is farther than the paper's method", "full", "localized", "full_against_localized"),
    ("`full` is farther than the paper's method on quadratic triangles (`localized+p2`)",
     "full", "localized_p2", None),
    ("`full` on linear triangles (`full-p2`) is farther than the paper's method",
     "full_linear", "localized", None),
    ("`full` is farther than the coarse mesh alone", "full", "affine", None),
)


def percent(text):
    return f"{100.0 * float(text):.3g} %"


def decided(row):
    """Whether `full` is nearer than its base or farther, or why that is open."""
    outcome = OUTCOMES[row["full_against_base"]]
    if outcome != "open":
        return outcome
    if is_lost(row):
        return f"law, {percent(row['law_lost_at'])}"
    if not row["full"]:
        return "not reached"
    return "bars x 3" if float(row["bar_safety"] or 0) >= UNCONFIRMED else "bars"


def sets(rows):
    """{set: rows} of a table."""
    found = {name: [row for row in rows if row["set"] == name] for name in SETS}
    return {name: some for name, some in found.items() if some}


def levels(rows):
    """{strain: rows} of a table."""
    return {
        strain: [row for row in rows if row["strain"] == strain]
        for strain in dict.fromkeys(row["strain"] for row in rows)
    }


def errors(rows):
    """All errors at one strain, with their gains."""
    return table(
        ["cell", "load", *(title for _, title in METHODS), *GAINS.values(), "decided"],
        [
            [f"`{row['cell']}`", row["load"],
             *(with_bar(row, name)
               + (f"{UNBROKEN}*{LETTERS[row['base_method']]}*" if name == "base" and row["base"] else "")
               for name, _ in METHODS),
             *(three(row[name]) for name in GAINS), decided(row)]
            for row in rows
        ],
    )


def in_median(rows, value_of):
    """The median of a number of all cases, and its smallest and largest value in all rows."""
    if not rows:
        return "–"
    middle = median(map(value_of, without_twins(rows)))
    ends = [pick(map(value_of, rows)) for pick in (min, max)]
    return f"**{three(str(middle))}** ({' to '.join(three(str(end)) for end in ends)})"


def one_change(rows):
    """Medians and extremes of errors over each other, with one thing changed, where the law holds."""
    lines = []
    for name, its in sets(rows).items():
        for strain, some in levels(its).items():
            kept = [row for row in some if not is_lost(row)]
            lines.append([SETS[name], percent(strain), *(
                in_median(known(kept, *names),
                          lambda row, names=names: min(float(row[one]) for one in names[:-1])
                          / float(row[names[-1]]))
                for names in CHANGES.values())])
    return table(["one change", "strain", *CHANGES], lines)


def summary(rows):
    """Medians and extremes of the gains, how many rows are decided, and in how many the paper's
    method has the larger error, by more than the bars and at all: set by set and strain by strain.
    """
    lines = []
    for name, its in sets(rows).items():
        for strain, some in levels(its).items():
            cases = without_twins(some)
            count = [
                sum(OUTCOMES[row["full_against_base"]] == word for row in cases)
                for word in OUTCOMES.values()
            ]
            lines.append([
                SETS[name], percent(strain),
                *(in_median([row for row in known(some, gain) if not is_lost(row)],
                            lambda row, gain=gain: float(row[gain])) for gain in GAINS),
                " / ".join(map(str, count)),
                f"{sum(row['localized_against_affine'] == 'FAIL' for row in cases)}/"
                f"{len(losses(cases, 'localized', 'affine'))}"])
    return table([HEADING, "strain", *GAINS.values(), " / ".join(OUTCOMES.values()),
                  "paper loses, decided/all"], lines)


def gains(rows):
    """summary(), and behind it the cells that have no row."""
    there = {row["cell"] for row in rows}
    missing = [f"`{name}`" for name in names_of(SOURCES) if name not in there]
    return summary(rows) + f"\n{NOT_RUN} {', '.join(missing)}.\n" * bool(missing)


def with_gains(text, rows):
    """A text, its table of gains made again."""
    old = rf"(?m)^\| {HEADING} \|(.|\n)*?\n(?=\n)(\n{NOT_RUN} .*\n)?"
    return re.sub(old, lambda _: gains(rows), text)


def known(rows, *methods):
    """Those in which all methods have an error."""
    return [row for row in rows if all(row.get(method) for method in methods)]


def losses(rows, method, other):
    """Those in which a method has the larger error."""
    return [row for row in known(rows, method, other) if float(row[method]) > float(row[other])]


def is_decided(row, method, other, claim):
    """Whether a loss is, by its claim or where there is none by the rules of claims."""
    if claim:
        return row[claim] == "FAIL"
    bars = [float(row[f"{name}_bar"] or "nan") for name in (method, other)]
    return (float(row[method]) - float(row[other]) > sum(bars) and not is_lost(row)
            and float(row["bar_safety"] or UNCONFIRMED) < UNCONFIRMED)


def lost(rows):
    """Each row in which a method has the larger error than another, as lists."""
    out = []
    for sentence, method, other, claim in LOSSES:
        if not known(rows, method, other):
            continue  # nothing was run
        out.append(f"{sentence}:\n")
        items = []
        for strain, some in levels(without_twins(rows)).items():
            cases = [
                f"`{row['cell']}` {row['load']} ({with_bar(row, method)} against"
                f" {with_bar(row, other)}"
                f"{', decided' if is_decided(row, method, other, claim) else ''}"
                f"{', law' if is_lost(row) else ''})"
                for row in losses(some, method, other)
            ]
            items.append(
                f"- {percent(strain)} strain, {len(cases)} of {len(known(some, method, other))}:"
                f" {', '.join(cases) or 'none'}."
            )
        out.append("\n".join(items) + "\n")
    return out


def open_weaves(rows):
    """What is said of the drawn weaves on which up-sampling is not known to be nearer."""
    names = [
        f"`{row['cell']}` {row['load']} at {percent(row['strain'])} ({decided(row)})"
        for row in without_twins(rows)
        if row["full_against_base"] != "PASS"
    ]
    return (
        f"In {len(names)} of {len(without_twins(rows))} cases `full` is not shown to be nearer than its"
        f" base{': ' + ', '.join(names) if names else ''}.\n"
    )


def page(tables):
    """The whole page."""
    rows, brackets, claims = (tables[f"{name}.csv"] for name in ("errors", "brackets", "claims"))
    out = [NOTICE, "# Results\n", ABOUT, "## Gains in short\n", SHORT, gains(rows),
           *["## One change at a time\n", ONE_CHANGE, one_change(rows)]
           * any(row.get("full_linear") for row in rows)]
    for name, its in sets(rows).items():
        out.append(f"## {SETS[name].capitalize()}\n")
        if name == "drawn weaves":
            names = len({row["cell"] for row in its})
            out += [DRAWN.format(all=len(variants(SOURCES)), there=names), open_weaves(its)]
        for strain, some in levels(its).items():
            out += [f"At {percent(strain)} strain:\n", errors(some)]
    out += [
        "## Where a method loses\n",
        "*Decided* are the losses that are larger than the sum of both bars; `strip-1` stands for"
        " `strip-2`, too, where the cell looks the same along both axes; *law* marks rows beyond the"
        " strain at which the law loses ellipticity.\n",
        *lost(rows),
        *section(tables["peers.csv"]),
        *(bent_section.section(tables["bending.csv"], names_of(SOURCES))
          if "bending.csv" in tables else []),
        "## Guaranteed brackets on C^H\n",
        "Width: the largest difference of the two bounds on the energy, over all macro strains, divided by"
        " the upper one. Mesh: the shipped one, or where arcs are drawn the one that resolves them;"
        " nothing is refined for a tolerance.\n",
        table(["cell", "triangles", "width"],
              [[f"`{row['cell']}`", row["triangles"], f"{float(row['width']):.2g}"]
               for row in brackets], 1),
        "## Claims\n",
        "Claims of kind *method* are those that compare methods, as above: where one fails, the first method"
        " is farther from the reference than the other. All others are of the program and of the cell."
        " Exit status 1: a claim fails; 4: none fails and one is open; 0: all hold.\n",
        table(["command", "cell", "claims", "hold", "open", "fail", "open, method", "fail, method",
               "exit status"],
              [[f"`{row['command']}`", f"`{row['of']}`",
                *(row[name] for name in ("claims", "hold", "open", "fail", "method_open",
                                         "method_fail", "exit_status"))]
               for row in claims]),
        "## Runs\n",
        "The fingerprint of inputs, options and revision of each run, and the revision of the"
        " program.\n",
        table(["cell", "run", "revision"],
              [[f"`{row['cell']}`", row["run"], row["revision"]]
               for row in {row["cell"]: row for row in rows}.values()], 3),
    ]
    return "\n".join(out)


def main(folder, path, *others):
    """Writes the page of the tables in a folder, and the table of gains in other texts."""
    path, tables = pathlib.Path(path), read_tables(folder)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page(tables), encoding="utf-8")
    for other in map(pathlib.Path, others):
        text = other.read_text(encoding="utf-8")
        other.write_text(with_gains(text, tables["errors.csv"]), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
