#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Whether two builds of the program give the same results, and where they differ by how much: for
changes that move and name code, or sum in another order.

    same_results.py [options] OLD NEW WORK [PART ...]

OLD and NEW are programs. Each part is run by both in WORK/old and WORK/new (a part that is there
already is not run again). Of tables (.csv) rows are matched by the columns that are no measured
numbers, and common columns are compared; rows and columns that only one has are listed. Of
homogenize.json and positions in .h5 all numbers are compared. Seconds, memory, revisions and dates
tell of the run and are left out. Prints a line per difference and ends with 1, or with 0. It is no
test: it takes two programs, and minutes.

    --tolerance T        numbers may differ by T of the largest of their column (default 0)
    --rename MAP.json    {"old": "new"}: columns and keys, files and parts of OLD under NEW's names
    --old-commands JSON  {"PART": ["command", "argument", ...]}: what OLD is given in their place
    --new-commands JSON  the same of NEW
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CELLS = sorted((ROOT / "meshes" / "cells").glob("*.prm"))
OF_THE_RUN = ("second", "memory", "provenance", "revision", "date", "time_ms", "command")
# Numbers by which a row is found; besides these all columns that hold text.
KEYS = {"strain", "cells", "coarse_triangles", "fine_triangles", "level", "order", "refine", "step",
        "frame", "time", "time_s", "ratio", "contrast", "angle", "turn", "kx", "ky"}
TWO = [str(ROOT / "meshes" / "cells" / f"{name}.prm") for name in ("layered", "three-stiffness")]
WOVEN = [str(ROOT / "meshes" / "cells" / f"{name}.prm") for name in ("twill", "chevron")]
SCENES = ROOT / "meshes" / "scenes"

PARTS = {f"homogenize-{cell.stem}": ["homogenize", str(cell)] for cell in CELLS}
PARTS.update({
    "strain": ["strain", "--quick", *TWO],
    "strain-twill": ["strain", "--quick", WOVEN[0]],
    "strain-chevron": ["strain", "--quick", WOVEN[1]],
    "converge": ["converge", "--quick", *TWO],
    "load": ["periodic", "load", WOVEN[1], "--strain", "11=2%"],
    "stability": ["periodic", "stability", WOVEN[1], "--strains=-5%", "--refine", "0"],
    "drape-hang": ["drape", "--quick", str(SCENES / "hang.prm")],
    "drape-pull": ["drape", "--quick", str(SCENES / "pull.prm")],
    "drape-skirt": ["drape", "--quick", str(SCENES / "skirt.prm")],
    "upsample": ["upsample", "WORK/homogenize-layered/cell.h5", "--rest", "WORK/rest.obj",
                 "WORK/rest.obj", "--format", "ply"],
    "stress": ["stress", "--quick"],
})


def write_sheet(cell, path):
    """A sheet of 4 x 4 cells, two triangles each, as a coarse mesh of `upsample`."""
    import h5py  # only this part needs it
    with h5py.File(cell) as file:
        one, other = file["lattice"][:]
    points = [i * one + j * other for j in range(5) for i in range(5)]
    corners = [(5 * j + i, 5 * j + i + 1, 5 * j + i + 6, 5 * j + i + 5)
               for j in range(4) for i in range(4)]
    lines = [f"v {x!r} {y!r} 0" for x, y in ((float(p[0]), float(p[1])) for p in points)]
    for a, b, c, d in corners:
        lines += [f"f {a + 1} {b + 1} {c + 1}", f"f {a + 1} {c + 1} {d + 1}"]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def run(program, part, folder, commands):
    if (folder / "run.json").exists() and json.loads((folder / "run.json").read_text())["finished"]:
        return
    work = folder.parent
    work.mkdir(parents=True, exist_ok=True)
    if part == "upsample":
        run(program, "homogenize-layered", work / "homogenize-layered", commands)
        write_sheet(work / "homogenize-layered" / "cell.h5", work / "rest.obj")
    arguments = [word.replace("WORK", str(work)) for word in commands.get(part, PARTS[part])]
    report = [] if part.startswith("homogenize") or part == "upsample" else ["--no-report"]
    subprocess.run([program, *arguments, *report, "--quiet", "--overwrite", "--output",
                    str(folder)],
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)


def is_of_the_run(name):
    return any(word in name for word in OF_THE_RUN)


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return None


def table(path, rename):
    """{column: [cell, ...]}, under the names of NEW."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [rename.get(name, name) for name in rows[0]]
    return {name: [row[k] for row in rows[1:]] for k, name in enumerate(names)
            if not is_of_the_run(name)}


def keyed(columns, keys):
    """{key of a row: its place}; rows with the same key are told apart by their order."""
    found, seen = {}, {}
    for place in range(len(next(iter(columns.values()), []))):
        key = tuple(columns[name][place] for name in keys)
        seen[key] = seen.get(key, 0) + 1
        found[key + (seen[key],)] = place
    return found


def is_close(a, b, size, tolerance):
    x, y = number(a), number(b)
    if a == b or x is None or y is None:
        return a == b
    return x == y or (math.isnan(x) and math.isnan(y)) or abs(x - y) <= tolerance * size


def largest(values):
    numbers = [abs(x) for x in map(number, values) if x is not None and math.isfinite(x)]
    return max(numbers, default=0.)


def differences_of_tables(old, new, tolerance):
    for name in sorted(set(old) ^ set(new)):
        yield f"column {name} is {'gone' if name in old else 'new'}"
    common = [name for name in new if name in old]
    keys = [name for name in common if name in KEYS or
            any(value and number(value) is None for value in old[name] + new[name])]
    rows = keyed(old, keys), keyed(new, keys)
    for key in sorted(set(rows[0]) ^ set(rows[1])):
        yield f"row {', '.join(map(str, key))} is {'gone' if key in rows[0] else 'new'}"
    for name in (name for name in common if name not in keys):
        size, worst, where = largest(old[name]), -1., None
        for key in sorted(set(rows[0]) & set(rows[1])):
            a, b = old[name][rows[0][key]], new[name][rows[1][key]]
            if is_close(a, b, size, tolerance):
                continue
            x, y = number(a), number(b)
            by = math.inf if x is None or y is None else abs(x - y) / size
            if by > worst or math.isnan(by):
                worst, where = by, (key, a, b)
        if where:
            yield (f"{name} by up to {worst:.1e} of its largest: {where[1]} and {where[2]} in row "
                   f"{', '.join(map(str, where[0]))}")


def leaves(value, rename, path=""):
    """(path, what stands there) of a JSON value, lists of numbers as one."""
    if isinstance(value, dict):
        for key, each in value.items():
            if not is_of_the_run(key):
                yield from leaves(each, rename, f"{path}/{rename.get(key, key)}")
    elif isinstance(value, list) and any(isinstance(each, (dict, list)) for each in value):
        for k, each in enumerate(value):
            yield from leaves(each, rename, f"{path}/{k}")
    else:
        yield path, value if isinstance(value, list) else [value]


def positions(path):
    """(path, numbers) of the data sets of an .h5 file."""
    import h5py
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, each: found.update({f"/{name}": each[()].ravel().tolist()})
                        if isinstance(each, h5py.Dataset) and each.dtype.kind in "if" and each.shape
                        and not is_of_the_run(name) else None)
    return found


def differences_of_leaves(old, new, tolerance):
    for path in sorted(set(old) ^ set(new)):
        yield f"{path} is {'gone' if path in old else 'new'}"
    for path in sorted(set(old) & set(new)):
        if len(old[path]) != len(new[path]):
            yield f"{path}: {len(old[path])} and {len(new[path])} values"
            continue
        size = largest(old[path])
        off = [(a, b) for a, b in zip(old[path], new[path]) if not is_close(a, b, size, tolerance)]
        if off:
            yield (f"{path}: {len(off)} of {len(old[path])} differ, such as {off[0][0]} and "
                   f"{off[0][1]}")


def differences(old, new, tolerance=0., rename=None):
    """Of one file that both have."""
    rename = rename or {}
    if new.suffix == ".csv":
        return list(differences_of_tables(table(old, rename), table(new, {}), tolerance))
    if new.suffix == ".h5":
        return list(differences_of_leaves(positions(old), positions(new), tolerance))
    read = [dict(leaves(json.loads(path.read_text(encoding="utf-8")), names))
            for path, names in ((old, rename), (new, {}))]
    return list(differences_of_leaves(*read, tolerance))


def compared(folder, rename):
    """{name: path} of what is compared, under the names of NEW."""
    return {rename.get(str(path.relative_to(folder)), str(path.relative_to(folder))): path
            for path in folder.rglob("*")
            if path.suffix in (".csv", ".h5") or path.name == "homogenize.json"}


def json_of(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8")) if path else {}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("old", "new", "work"):
        parser.add_argument(name)
    parser.add_argument("part", nargs="*")
    parser.add_argument("--tolerance", type=float, default=0.)
    for name in ("--rename", "--old-commands", "--new-commands"):
        parser.add_argument(name)
    given = parser.parse_args()
    rename = json_of(given.rename)
    commands = [json_of(given.old_commands), json_of(given.new_commands)]
    n_same, different = 0, []
    for part in given.part or PARTS:
        folders = [pathlib.Path(given.work) / which / part for which in ("old", "new")]
        for program, folder, own in zip((given.old, given.new), folders, commands):
            run(program, part, folder, own)
        files = [compared(folders[0], rename), compared(folders[1], {})]
        if not files[0] or not files[1]:
            different.append(f"{part}: no results")
        for name in sorted(set(files[0]) | set(files[1])):
            if name not in files[0] or name not in files[1]:
                different.append(f"{part}: {name} is {'gone' if name in files[0] else 'new'}")
                continue
            found = differences(files[0][name], files[1][name], given.tolerance, rename)
            n_same += not found
            different += [f"{part}: {name}: {text}" for text in found]
    for text in different:
        print("different:", text)
    print(f"{n_same} files are the same, {len(different)} differences")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
