# SPDX-License-Identifier: MIT
"""Made-up results as a run writes them, for the tests of the report: tables of the schema, run.json
with the files as they are.
"""
import csv
import io
import json
import math
import os
import zlib

import report_path  # noqa: F401
from read import schema


def field_of(value):
    """A value as a field; what is not known is empty."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    return (
        str(value).lower()
        if isinstance(value, bool)
        else repr(float(value))
        if isinstance(value, float)
        else str(value)
    )


def table_text(file, rows):
    """A table of the schema; a column that a row does not name is empty.

    @param rows dictionaries
    @throws KeyError where a row names a column that the table does not have
    """
    names = schema.table(file).names
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    for row in rows:
        if unknown := set(row).difference(names):
            raise KeyError(f"{file} has no column {', '.join(sorted(unknown))}")
        writer.writerow([field_of(row.get(name)) for name in names])
    return text.getvalue()


def write_table(folder, file, rows):
    with open(os.path.join(folder, file), "w", encoding="utf-8") as stream:
        stream.write(table_text(file, rows))


def verdict(
    claim,
    outcome,
    value=None,
    limit="",
    kind="program",
    derivation="theory says so",
    command="homespun strain",
):
    """A claim as verdicts.json lists it."""
    return {
        "claim": claim,
        "kind": kind,
        "verdict": outcome,
        "value": value,
        "limit": limit,
        "derivation": derivation,
        "command": command,
    }


def write_verdicts(folder, verdicts):
    with open(os.path.join(folder, "verdicts.json"), "w", encoding="utf-8") as stream:
        json.dump({"verdicts": verdicts}, stream, indent=2)


def files_of(folder):
    """Names of all files below a folder, but for runs that have a folder of their own in it."""
    found = []
    for place, folders, names in os.walk(folder):
        folders[:] = [
            name for name in folders if not os.path.isfile(os.path.join(place, name, "run.json"))
        ]
        found += [
            os.path.relpath(os.path.join(place, name), folder)
            for name in names
            if name != "run.json"
        ]
    return sorted(found)


def checksum(path):
    with open(path, "rb") as file:
        return f"{zlib.crc32(file.read()):08x}"


def write_run(folder, command="strain", revision="abc1234", finished=True, **others):
    """run.json as `homespun` writes it; a run that did not come to its end has no list of files.

    @param others keys that replace those of run.json
    """
    run = {
        "format_version": 1,
        "command": command,
        "revision": revision,
        "inputs": {"strains": [0.01, 0.1]},
        "fingerprint": (
            f"{zlib.crc32(f'{command} {revision} {os.path.basename(folder)}'.encode()):016x}"
        ),
        "seconds": 3.5,
        "began": 1.8e9,
        "finished": finished,
    }
    if finished:
        run["files"] = {
            name: {
                "bytes": os.path.getsize(os.path.join(folder, name)),
                "crc32": checksum(os.path.join(folder, name)),
            }
            for name in files_of(folder)
        }
    with open(os.path.join(folder, "run.json"), "w", encoding="utf-8") as file:
        json.dump({**run, **others}, file, indent=2)


def list_again(folder):
    """Lists the files of a finished run as they are now, as if it had written them."""
    path = os.path.join(folder, "run.json")
    with open(path, encoding="utf-8") as file:
        run = json.load(file)
    if run["finished"]:
        write_run(folder, **{key: value for key, value in run.items() if key != "files"})
