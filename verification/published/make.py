# SPDX-License-Identifier: MIT
"""Makes the runs behind the published results, and their tables: HOMESPUN SOURCES OUTPUT
[CELL...]

All cells that have a drawing of their own, and two variants of each weave whose yarns are drawn by
chance (meshes/cells/drawn_weaves.csv), at the paper's size. What is there of the same revision is taken up. Hours on two
cores; CELL... makes those alone.
"""
import csv
import pathlib
import subprocess
import sys

CELLS_PER_SIDE = 20
CELLS_PER_SIDE_BENT = 10
MAPPED = ("layered", "twill")  # whose stability map is shipped
WEAVES = ("plain-weave", "satin", "twill")  # whose default law is yarn
COMPARED = [
    "--strains",
    "0.01,0.1",
    "--loads",
    "strip-1,strip-2,shear-frame",
    "--no-budget",
    "--no-runtime",
    "--no-report",
]
METHODS = "affine,affine+p2,localized,localized+p2,full-p2-micro,full-p2,full-micro,full"
ENDED = (0, 1, 4)  # a claim that failed or is open is a result


def run(*words):
    """Runs a command whose claims may fail."""
    status = subprocess.run([str(word) for word in words], check=False).returncode
    if status not in ENDED:
        sys.exit(status)


def make_weave(homespun, sources, folder, variant):
    """The cell file of a variant: the drawing with its cover, the materials of meshes/cells/weave.py.

    @param variant row of drawn_weaves.csv
    """
    name = drawn_name(variant)
    run(homespun, "cells", "make", variant["cell"], "--set", f"yarn_width={variant['cover']}",
        "--name", name, "--output", folder)
    materials = subprocess.run(
        [sys.executable, "-B", sources / "meshes" / "cells" / "weave.py", variant["cell"], "--seed",
         variant["seed"]], check=True, capture_output=True, text=True).stdout
    kept = [line for line in (folder / f"{name}.prm").read_text(encoding="utf-8").splitlines()
            if line.startswith(("set Mesh", "set Lattice"))]
    (folder / f"{name}.prm").write_text(
        f"# {name}: yarns drawn by chance.\n{materials}" + "\n".join(kept) + "\n", encoding="utf-8")
    return folder / f"{name}.prm"


def variants(sources):
    """Rows of drawn_weaves.csv."""
    with open(sources / "meshes" / "cells" / "drawn_weaves.csv", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def drawn_name(variant):
    return f"{variant['cell']}-drawn-{variant['seed']}"


def drawings(sources):
    """Shipped cells that have a drawing of their own."""
    return sorted(path.with_suffix(".prm") for path in (sources / "meshes" / "cells").glob("*.geo"))


def names_of(sources):
    """Of all cells."""
    return [path.stem for path in drawings(sources)] + [*map(drawn_name, variants(sources))]


def cells_of(homespun, sources, output, names):
    """Cell files and their laws."""
    for cell in drawings(sources):
        if not names or cell.stem in names:
            yield cell, "yarn" if cell.stem in WEAVES else "biot"
    for variant in variants(sources):
        if not names or drawn_name(variant) in names:
            yield make_weave(homespun, sources, output / "weaves", variant), "yarn"


def main(homespun, sources, output, *names):
    sources, output = pathlib.Path(sources), pathlib.Path(output)
    folders = []
    for cell, law in cells_of(homespun, sources, output, names):
        for command, options in (
            ("strain", ["--cells", CELLS_PER_SIDE, "--references", law, "--methods", METHODS,
                        *COMPARED]),
            ("bend", ["--cells", CELLS_PER_SIDE_BENT, "--no-report"]),
            ("homogenize", ["--quiet"]),
        ):
            folders.append(output / cell.stem / command)
            run(homespun, command, cell, *options, "--output", folders[-1])
    for name in ("", *MAPPED):  # the first of made cells
        if not names or name in names:
            cell = [sources / "meshes" / "cells" / f"{name}.prm"] * bool(name)
            folders.append(output / (name or "made") / "stress")
            run(homespun, "stress", *cell, "--no-report", "--quiet", "--output", folders[-1])
    run(
        sys.executable,
        "-B",
        sources / "verification" / "published" / "published.py",
        sources / "verification" / "published",
        *folders
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
