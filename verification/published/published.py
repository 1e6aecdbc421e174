#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes the small tables behind the published results, out of folders of results.

    published.py OUTPUT DIR [DIR...]

Of runs of `homespun strain` errors.csv, of `bend` bending.csv, of `homogenize` brackets.csv, of
`stress` limits.csv, of all with claims claims.csv. Each row ends with the run and the revision that its figures are of. A run
that did not end, or whose files were changed since, is refused. Exit status: 0, or 2 with one
message per fault.
"""
import csv
import math
import os
import sys

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "report"))

# pylint: disable=wrong-import-position
from read.cell_results import relative_width  # noqa: E402
from read.runs import read_run  # noqa: E402
from read.schema import NoSchema  # noqa: E402
from read.stored import BadResults  # noqa: E402
from of_bend import bending  # noqa: E402
from of_strain import errors  # noqa: E402
from run_files import Results  # noqa: E402

KEYS = {  # columns that name a row of each file
    "errors.csv": ("set", "cell", "load", "strain"),
    "bending.csv": ("cell", "load", "what"),
    "brackets.csv": ("cell",),
    "claims.csv": ("command", "of"),
    "limits.csv": ("axis", "of"),
    "peers.csv": ("cell", "tested", "law", "method", "trained_on"),  # by python/peers/compare.py
}


def brackets(results):
    """Relative width of the bracket on C^H of the meshed cell: on the given mesh, and on the last
    one.
    """
    for name in results.run.names("*homogenize.json"):
        value = results.json(name)
        bracket, history = value.get("bracket") or {}, value.get("history") or []
        if value.get("C_lower") is None:
            continue
        width = relative_width(
            numpy.array(value["C_lower"], dtype=float), numpy.array(value["C_upper"], dtype=float)
        )
        yield {
            "cell": value["cell"],
            "width": width,
            "width_given": history[0]["width"] if history else math.nan,
            "meshes": len(history),
            "triangles": bracket.get("triangles", math.nan),
            "dofs": bracket.get("dofs", math.nan),
            "stress_dofs": bracket.get("stress_dofs", math.nan),
            "seconds": history[-1]["seconds"] if history else math.nan,
        }


def limits(results):
    """How far each axis of the stability map goes, and why it ends there."""
    columns = ("axis", "of", "value_is", "reached", "end", "ended_by", "why", "error", "theory")
    for row in results.table("limits.csv"):
        yield {column: row[column] for column in columns}


def named(run):
    """("strain --quick", "dots") of out/dots/strain-quick; of a folder of another name that name.
    """
    quick = f"{run.command}-quick"
    if run.name not in (run.command, quick):
        return run.command, run.name
    return run.command + " --quick" * (run.name == quick), os.path.basename(
        os.path.dirname(os.path.abspath(run.folder))
    )


def claims(results):
    """How many claims of each kind hold, fail and are open, and the exit status they amount to: 1
    one failed, 4 one is open, 0.
    """
    if not results.run.holds("verdicts.json"):
        return
    verdicts = results.verdicts()
    count = {
        (kind, outcome): sum((v["kind"], v["verdict"]) == (kind, outcome) for v in verdicts)
        for kind in ("program", "input", "method")
        for outcome in ("PASS", "FAIL", "INCONCLUSIVE")
    }

    def of(outcome):
        return sum(number for (_, one), number in count.items() if one == outcome)

    command, of_what = named(results.run)
    row = {
        "command": command,
        "of": of_what,
        "claims": len(verdicts),
        "hold": of("PASS"),
        "fail": of("FAIL"),
        "open": of("INCONCLUSIVE"),
        "exit_status": 1 if of("FAIL") else 4 if of("INCONCLUSIVE") else 0,
    }
    words = {"PASS": "hold", "FAIL": "fail", "INCONCLUSIVE": "open"}
    yield {
        **row,
        **{f"{kind}_{words[outcome]}": number for (kind, outcome), number in count.items()},
    }


TABLES = {
    "strain": {"errors.csv": errors},
    "bend": {"bending.csv": bending},
    "homogenize": {"brackets.csv": brackets},
    "stress": {"limits.csv": limits},
}


def field(value):
    """As CSV has it; what is not known is empty."""
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.8g}"
    return str(value)


def rows_of(folders):
    """{FILE: rows} of result folders.

    @throws BadResults
    """
    tables, faults = {}, []
    for folder in folders:
        run = read_run(folder, faults)
        if run is None:
            continue
        if not run.finished:
            faults.append(f"{folder}: its run did not come to its end. Begin it again: it goes on.")
            continue
        for name, make in {**TABLES.get(run.command, {}), "claims.csv": claims}.items():
            try:
                tables.setdefault(name, []).extend(
                    {**row, "run": run.fingerprint, "revision": run.revision}
                    for row in make(Results(run))
                )
            except BadResults as error:
                faults += error.faults
    for name, rows in tables.items():
        keys = [tuple(field(row[key]) for key in KEYS[name]) for row in rows]
        faults += [
            f"{name}: two runs have a row {'/'.join(key)}; expected one of each. Give the folder of"
            " one of them alone."
            for key in dict.fromkeys(keys)
            if keys.count(key) > 1
        ]
    if faults:
        raise BadResults(faults)
    return {name: rows for name, rows in tables.items() if rows}


def publish(output, folders):
    """Writes the tables, each whole. @return their names @throws BadResults, OSError"""
    tables = rows_of(folders)
    os.makedirs(output, exist_ok=True)
    for name, rows in tables.items():
        path = os.path.join(output, name)
        with open(path + ".tmp", "w", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(rows[0])
            writer.writerows([field(value) for value in row.values()] for row in rows)
        os.replace(path + ".tmp", path)
    return sorted(tables)


def main(arguments):
    if len(arguments) < 2:
        print("usage: published.py OUTPUT DIR [DIR...]", file=sys.stderr)
        return 2
    try:
        print(", ".join(publish(arguments[0], arguments[1:])))
    except (BadResults, NoSchema) as error:
        for fault in getattr(error, "faults", [str(error)]):
            print(f"error: {fault}", file=sys.stderr)
        return 2
    except OSError as error:
        print(
            (
                f"error: {error.filename or arguments[0]}: {error.strerror or error}; expected a"
                " folder that can be written"
            ),
            file=sys.stderr,
        )
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
