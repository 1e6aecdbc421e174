#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Whether two builds of the program give the same results, bit for bit: for changes that move and
name code and change no number.

    same_results.py OLD NEW WORK [PART ...]

OLD and NEW are programs. Each part is run by both in WORK/old and WORK/new (a part that is there
already is not run again) and every CSV file and homogenize.json compared, but for what tells of the
run and not of its result: seconds, memory, revisions, dates. Prints a line per file that differs
and ends with 1, or with 0. It is no test: it takes two programs, and minutes.
"""
import csv
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CELLS = sorted((ROOT / "meshes" / "cells").glob("*.prm"))
OF_THE_RUN = ("second", "memory", "provenance", "revision", "date", "time_ms", "command")
TWO = [str(ROOT / "meshes" / "cells" / f"{name}.prm") for name in ("layered", "three-stiffness")]
SCENES = ROOT / "meshes" / "scenes"

PARTS = {f"homogenize-{cell.stem}": ["homogenize", str(cell)] for cell in CELLS}
PARTS.update({
    "strain": ["strain", "--quick", *TWO],
    "converge": ["converge", "--quick", *TWO],
    "drape-hang": ["drape", "--quick", str(SCENES / "hang.prm")],
    "drape-pull": ["drape", "--quick", str(SCENES / "pull.prm")],
    "drape-skirt": ["drape", "--quick", str(SCENES / "skirt.prm")],
    "stress": ["stress", "--quick"],
})


def run(program, part, folder):
    if (folder / "run.json").exists() and json.loads((folder / "run.json").read_text())["finished"]:
        return
    folder.parent.mkdir(parents=True, exist_ok=True)
    report = [] if part.startswith("homogenize") else ["--no-report"]
    subprocess.run([program, *PARTS[part], *report, "--quiet", "--overwrite", "--output",
                    str(folder)],
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)


def is_of_the_run(name):
    return any(word in name for word in OF_THE_RUN)


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    keep = [k for k, name in enumerate(rows[0]) if not is_of_the_run(name)]
    return [[row[k] for k in keep] for row in rows]


def results(value):
    if isinstance(value, dict):
        return {key: results(each) for key, each in value.items() if not is_of_the_run(key)}
    return [results(each) for each in value] if isinstance(value, list) else value


def content(path):
    if path.suffix == ".csv":
        return table(path)
    return results(json.loads(path.read_text(encoding="utf-8")))


def compared(folder):
    return {path.relative_to(folder) for path in folder.rglob("*")
            if path.suffix == ".csv" or path.name == "homogenize.json"}


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    old, new, work = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    n_same, different = 0, []
    for part in sys.argv[4:] or PARTS:
        folders = [work / "old" / part, work / "new" / part]
        for program, folder in zip((old, new), folders):
            run(program, part, folder)
        names = [compared(folder) for folder in folders]
        if names[0] != names[1] or not names[0]:
            different.append(f"{part}: {sorted(map(str, names[0] ^ names[1])) or 'no results'}")
        for name in sorted(names[0] & names[1]):
            if content(folders[0] / name) == content(folders[1] / name):
                n_same += 1
            else:
                different.append(f"{part}: {name}")
    for text in different:
        print("different:", text)
    print(f"{n_same} files are the same, {len(different)} are not")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
