#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Measures which mutants lie in lines that the program executes when it is asked for its verdicts.

executed.py BUILD WORK   builds the sound program with gcov's counters in WORK/source/build/coverage
                         and asks it as run.py does; WORK/executed.csv has a row per mutant
"""
import csv
import json
import os
import shutil
import subprocess
import sys

import patches
import run

TREE = "build/coverage"


def changed_lines_of(mutant, text):
    """Numbers, from 1, of the lines of a sound file that a mutant changes."""
    lines, changed = text.split("\n"), []
    for hunk in mutant.hunks:
        n = len(hunk.old)
        place = next(k for k in range(len(lines)) if lines[k:k + n] == hunk.old)
        changed += [place + 1 + k for k in hunk.changed()]
    return changed


def is_executed(changed, counts):
    """Whether one of the lines was executed.

    counts: {line: times} of the lines that gcov lists. A statement of several lines is listed at
    its first one: a line that is not listed counts as the nearest one above."""
    listed = sorted(counts)
    for line in changed:
        above = [number for number in listed if number <= line]
        if above and counts[above[-1]] > 0:
            return True
    return False


def launcher_of(counted):
    """A shell script that compiles as it is told, and these files with gcov's counters. What a
    header holds is counted where one of them includes it."""
    ccache = shutil.which("ccache") or ""
    return ("#!/bin/sh\nfor word; do\n  case $word in\n    " +
            "|".join(f"*/{file}" for file in sorted(counted)) +
            f") exec {ccache} \"$@\" --coverage -O1 ;;\n  esac\ndone\nexec {ccache} \"$@\"\n")


def counts_of(build, copy, wanted):
    """{file: {line: times}} of the wanted files, over all objects that were run."""
    counts = {file: {} for file in wanted}
    for data in sorted(build.rglob("*.gcda")):
        answer = subprocess.run(["gcov", "--json-format", "--stdout", str(data)], cwd=build,
                                check=True, stdout=subprocess.PIPE).stdout
        for line in answer.splitlines():
            for file in json.loads(line)["files"]:
                path = os.path.normpath(os.path.join(build, file["file"]))
                name = os.path.relpath(path, copy)
                for entry in file["lines"] if name in counts else []:
                    number = entry["line_number"]
                    counts[name][number] = counts[name].get(number, 0) + entry["count"]
    return counts


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    workshop = run.Workshop(*sys.argv[1:])
    workshop.build = workshop.copy / TREE
    workshop.build.mkdir(parents=True, exist_ok=True)
    mutants = patches.read()
    launcher = workshop.work / "counting-compiler"
    launcher.write_text(launcher_of({mutant.file for mutant in mutants}), encoding="utf-8")
    launcher.chmod(0o755)
    if workshop.run("cmake", "-S", str(workshop.copy), "-B", ".",
                    *run.settings_of(workshop.given), "-DHOMESPUN_BUILD_TESTS=OFF",
                    "-DCMAKE_EXE_LINKER_FLAGS=--coverage",
                    f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}",
                    log="coverage-configure.log") != 0 or \
       workshop.run("cmake", "--build", ".", "--parallel", str(run.JOBS), "--target", "homespun",
                    log="coverage-build.log") != 0:
        raise SystemExit(f"the counters do not build; see {workshop.work}/coverage-build.log")
    for data in workshop.build.rglob("*.gcda"):
        data.unlink()
    for part in run.PARTS:
        status, _ = workshop.ask_part(part)
        print(f"the part {part} ends with {status}", flush=True)
    counts = counts_of(workshop.build, workshop.copy, {mutant.file for mutant in mutants})
    with open(workshop.work / "executed.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["mutant", "executed"])
        for mutant in mutants:
            text = (workshop.copy / mutant.file).read_text(encoding="utf-8")
            executed = is_executed(changed_lines_of(mutant, text), counts[mutant.file])
            writer.writerow([mutant.name, str(executed).lower()])


if __name__ == "__main__":
    main()
