# SPDX-License-Identifier: MIT
"""Makes the runs behind the published results, and their tables: HOMESPUN SOURCES OUTPUT
[CELL...]

All cells at the paper's size. What is there of the same revision is taken up. Hours on two cores;
CELL... makes those alone.
"""
import pathlib
import subprocess
import sys

CELLS_PER_SIDE = 20
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
METHODS = (
    "affine,affine+p2,localized,localized+edges,localized+p2,full,full-micro,full-cubic-modes"
)
SECOND_ORDER = {"biot": ",localized+cubic+modes", "yarn": ""}  # of which weaves have none
ENDED = (0, 1, 4)  # a claim that failed or is open is a result


def run(*words):
    """Runs a command whose claims may fail."""
    status = subprocess.run([str(word) for word in words], check=False).returncode
    if status not in ENDED:
        sys.exit(status)


def main(homespun, sources, output, *names):
    sources, output = pathlib.Path(sources), pathlib.Path(output)
    folders = []
    for cell in sorted((sources / "meshes" / "cells").glob("*.prm")):
        if names and cell.stem not in names:
            continue
        law = "yarn" if cell.stem in WEAVES else "biot"
        for command, options in (
            ("strain", ["--cells", CELLS_PER_SIDE, "--references", law, "--methods",
                        METHODS + SECOND_ORDER[law], *COMPARED]),
            ("homogenize", ["--quiet"]),
        ):
            folders.append(output / cell.stem / command)
            run(homespun, command, cell, *options, "--output", folders[-1])
    run(
        sys.executable,
        "-B",
        sources / "verification" / "published" / "published.py",
        sources / "verification" / "published",
        *folders
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
