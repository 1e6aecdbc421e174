#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Time and memory of the cell problems against mesh and number of ranks.

    tests/benchmarks/scaling.py PROGRAM CELL.prm --refine 4,5,6 --ranks 1,2

Each run is a `homespun homogenize --no-bars` in a process of its own; of several the one with the
median time is told. Rows of one mesh are strong scaling; four times the ranks on a mesh refined
once more is weak scaling. More ranks than cores share them, and their times say nothing. SCALING.md
beside this file tells what the figures mean.
"""
import argparse
import csv
import json
import pathlib
import shlex
import subprocess
import sys
import tempfile

STAGES = ("setup", "assembly", "preconditioner", "solve")


def measured(options, refine, ranks, solver):
    """The row of one run."""
    with tempfile.TemporaryDirectory() as folder:
        command = [*shlex.split(options.launcher.format(ranks=ranks)), options.program, "homogenize",
                   options.cell, "--order", str(options.order), "--refine", str(refine), "--no-bars",
                   "--solver", solver, "--quiet", "--output", folder + "/run"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        found = json.loads(pathlib.Path(folder, "run", "homogenize.json").read_text())
    seconds = {f"seconds_{stage}": found["seconds"][stage] for stage in STAGES}
    memory = found["peak_memory_of_rank"]
    return {"order": options.order, "refine": refine, "ranks": ranks, "solver": solver,
            "dofs": found["dofs"], "iterations": max(found["iterations"]),
            "given_up": len(found["abandoned_residuals"]), **seconds,
            "seconds": sum(seconds.values()), "bytes_largest_rank": max(memory),
            "bytes_per_dof": sum(memory) / found["dofs"], "C_11": found["C"][0][0]}


def main():
    numbers = lambda text: [int(word) for word in text.split(",")]
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="homespun")
    parser.add_argument("cell", help="cell file")
    parser.add_argument("--refine", type=numbers, default=[3, 4])
    parser.add_argument("--ranks", type=numbers, default=[1, 2])
    parser.add_argument("--order", type=int, choices=(1, 2), default=1)
    parser.add_argument("--solver", type=lambda text: text.split(","), default=["multigrid"],
                        help="multigrid, direct or both, comma-separated")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--launcher", default="mpirun -n {ranks}")
    options = parser.parse_args()
    table = csv.writer(sys.stdout, lineterminator="\n")
    heads = None
    for refine in options.refine:
        for solver in options.solver:
            for ranks in options.ranks:
                rows = sorted((measured(options, refine, ranks, solver)
                               for _ in range(options.repeats)), key=lambda row: row["seconds"])
                row = rows[len(rows) // 2]
                if heads is None:
                    heads = list(row)
                    table.writerow(heads)
                table.writerow(f"{row[head]:.12g}" if isinstance(row[head], float) else row[head]
                               for head in heads)
                sys.stdout.flush()


if __name__ == "__main__":
    main()
