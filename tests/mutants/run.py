#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Measures which mutants the tests notice, and which the program notices itself.

run.py BUILD WORK [NAME ...]   BUILD: a tree of the unpatched program that was built and tested, for
                               its settings, the seconds of its tests and those that fail already;
                               WORK: a folder for copy, build and table
run.py --ask tests ...         tests only, or with --ask program the program only: what is measured
                               in the other column of a row stays
run.py --dry BUILD WORK ...    puts each fault into the copy and takes it out again, builds nothing
run.py --list                  all mutants
run.py --score                 what measured.csv and executed.csv beside this program amount to

A row of WORK/mutants.csv per mutant (with --dry WORK/dry.csv); rows that are there are not run
again. It takes hours, and may be killed at any time.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import patches
from results import COLUMNS, NOT_YET, Table, executed_in, new_row, score

JOBS = 2
# These read the text of the sources, which every mutant changes.
NOT_ASKED = ("mutants", "walls")
# Upper ends of the seconds of tests that are run together; longer ones go one by one.
BATCHES = (0.1, 1., 10.)
# Without measured seconds: programs in C++ first, then in Python, then those that build.
GUESSED = [(r"^(consumer|verification\.install)$", 600.), (r"^benchmarks\.", 60.),
           (r"^verification\.\w+$", 300.), (r"", 0.5)]
NOT_COPIED = ("build", "out")
MARK = "copy-of-homespun"
CELL = "meshes/cells/chevron.prm"
PARTS = ("homogenize", "drape", "converge", "strain")  # of `verify`, the quickest first
MOST_SECONDS_OF_PROGRAM = 3600
WORST_FIRST = [2, 3, 1, 4, 0]  # exit statuses, as in verification/record/verdict.h


def make_equal(source, copy):
    """Brings a copy of the sources up to date, whatever a run before it left there.

    Only files that differ are written, with the time of now, so that just those are built."""
    def files_of(root):
        for folder, folders, names in os.walk(root):
            top = pathlib.Path(folder) == root
            folders[:] = [name for name in folders if name not in (".git", "__pycache__")
                          and not (top and name in NOT_COPIED)]
            for name in names:
                path = (pathlib.Path(folder) / name).relative_to(root)
                if name != ".git":
                    yield path
    source, copy = pathlib.Path(source), pathlib.Path(copy)
    wanted = set(files_of(source))
    for path in wanted:
        there = copy / path
        there.parent.mkdir(parents=True, exist_ok=True)
        if not there.exists() or there.read_bytes() != (source / path).read_bytes():
            there.write_bytes((source / path).read_bytes())
            shutil.copymode(source / path, there)
    for path in set(files_of(copy)) - wanted:
        (copy / path).unlink()


def refuse_places(work):
    """What is in the copy and not in the sources is deleted: no folder of somebody else's."""
    if (work / "source").exists() and not (work / MARK).exists():
        raise SystemExit(f"{work}/source was not made by this program; take another folder")
    inside = patches.ROOT in work.parents
    if work == patches.ROOT or inside and work.relative_to(patches.ROOT).parts[0] not in NOT_COPIED:
        raise SystemExit(f"{work} would be copied into itself; take a folder outside of the "
                         "sources, or in build/")


class Fault:
    """with Fault(copy, mutant): the fault is in the copy."""

    def __init__(self, copy, mutant):
        self.path = pathlib.Path(copy) / mutant.file
        self.mutant = mutant

    def __enter__(self):
        self.sound = self.path.read_text(encoding="utf-8")
        self.path.write_text(self.mutant.applied(self.sound), encoding="utf-8")

    def __exit__(self, *_):
        self.path.write_text(self.sound, encoding="utf-8")


def settings_of(build):
    """What to configure with, from the cache of a build tree."""
    cache = (pathlib.Path(build) / "CMakeCache.txt").read_text(encoding="utf-8")
    entries = re.findall(r"^([\w.-]+):(\w+)=(.*)$", cache, re.M)
    generator = next(value for name, _, value in entries if name == "CMAKE_GENERATOR")
    wanted = (r"HOMESPUN_(WITH_DEALII|NATIVE|AUDIT|SANITIZE)|CMAKE_BUILD_TYPE|CMAKE_C(XX)?_COMPILER"
              r"|CMAKE_C(XX)?_FLAGS(_\w+)?|CMAKE_PREFIX_PATH|deal\.II_DIR")
    return ["-G", generator] + [f"-D{name}:{kind}={value}" for name, kind, value in entries
                                if re.fullmatch(wanted, name) and value]


def seconds_of_tests(*builds):
    """{test: seconds} as ctest measured them; the first build that has some counts."""
    for build in builds:
        path = pathlib.Path(build) / "Testing/Temporary/CTestCostData.txt"
        if path.exists():
            text = path.read_text(encoding="utf-8").split("---")[0]
            return {name: float(seconds)
                    for name, runs, seconds in re.findall(r"^(\S+) (\d+) (\S+)$", text, re.M)
                    if int(runs) > 0}
    return {}


def batches_of(names, seconds, not_asked=NOT_ASKED):
    """Numbers of tests, from 1, in the order in which they are asked: the quickest first."""
    def cost(name):
        if name in seconds:
            return seconds[name]
        return next(guess for pattern, guess in GUESSED if re.search(pattern, name))
    asked = sorted((cost(name), number) for number, name in enumerate(names, 1)
                   if name not in not_asked)
    batches, low = [], 0.
    for high in BATCHES:
        batches.append([number for of_it, number in asked if low <= of_it < high])
        low = high
    return [batch for batch in batches if batch] + [[number] for of_it, number in asked
                                                    if of_it >= low]


def tests_beside(names, file):
    """Numbers of the tests, from 1, of the folder of a source file: FOLDER.WING.LABEL."""
    beside = ".".join(pathlib.Path(file).parts[:-1]) + "."
    return {number for number, name in enumerate(names, 1) if name.startswith(beside)}


def programs_of(tests, build):
    """Of each test, the program of the build tree that it runs; None where it runs another one, or
    one that is not built."""
    paths = [os.path.relpath(test.get("command", [".."])[0], build) for test in tests]
    return [None if path.startswith("..") else path for path in paths]


def revision_of(sources):
    """The commit, with a mark where files were changed since."""
    return subprocess.run(["git", "describe", "--always", "--abbrev=8", "--dirty"], cwd=sources,
                          check=True, stdout=subprocess.PIPE, text=True).stdout.strip()


def place_of(status):
    """Of an exit status among the others, the worst first; no status, or a signal, is worse."""
    return WORST_FIRST.index(status) if status in WORST_FIRST else -1


def what_the_program_says(status, claims, usual):
    """A claim that fails and usually does not, else a worse exit status, else nothing."""
    for claim in claims:
        if claim not in usual["claims"]:
            return claim
    if status == usual["status"]:
        return ""
    if place_of(status) < place_of(usual["status"]):
        return f"exit status {status}, usually {usual['status']}"
    return ""


def failed_log(build):
    return pathlib.Path(build) / "Testing/Temporary/LastTestsFailed.log"


def failed_tests(build):
    log = failed_log(build)
    return re.findall(r"^\d+:(.+)$", log.read_text(), re.M) if log.exists() else []


class Workshop:
    """Copy and build tree in WORK."""

    def __init__(self, build, work):
        self.given, self.work = pathlib.Path(build).resolve(), pathlib.Path(work).resolve()
        self.copy, self.build = self.work / "source", self.work / "source/build/mutants"
        self.environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1",
                            "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        refuse_places(self.work)
        self.revision = revision_of(patches.ROOT)
        self.work.mkdir(parents=True, exist_ok=True)
        (self.work / MARK).touch()
        make_equal(patches.ROOT, self.copy)

    def run(self, *command, log, seconds=None, cwd=None):
        """The exit status; what is printed goes to a file. None where it takes too long."""
        with open(self.work / log, "w", encoding="utf-8") as file:
            try:
                return subprocess.run(command, cwd=cwd or self.build, env=self.environment,
                                      stdout=file, stderr=subprocess.STDOUT, check=False,
                                      timeout=seconds).returncode
            except subprocess.TimeoutExpired:
                return None

    def builds(self, *targets):
        """Whether these build, or all where none is named."""
        named = ["--target", *targets] if targets else []
        return self.run("cmake", "--build", ".", "--parallel", str(JOBS), *named,
                        log="build.log") == 0

    def prepare(self, who):
        """Configures once, builds what is sound, and asks it what it says when nothing is wrong."""
        self.build.mkdir(parents=True, exist_ok=True)
        if not (self.build / "build.ninja").exists() and not (self.build / "Makefile").exists():
            command = ["cmake", "-S", str(self.copy), "-B", ".", *settings_of(self.given)]
            if self.run(*command, log="configure.log") != 0:
                raise SystemExit(f"cmake fails; see {self.work}/configure.log")
        if not self.builds(*([] if "tests" in who else ["homespun"])):
            raise SystemExit(f"the sources do not build; see {self.work}/build.log")
        listing = subprocess.run(["ctest", "--show-only=json-v1"], cwd=self.build, check=True,
                                 env=self.environment, stdout=subprocess.PIPE).stdout
        tests = json.loads(listing)["tests"]
        self.names = [test["name"] for test in tests]
        self.programs = programs_of(tests, self.build)
        failing = failed_tests(self.given)
        for test in failing:
            print(f"{test} fails without any mutant and is not asked", flush=True)
        self.batches = batches_of(self.names, seconds_of_tests(self.build, self.given),
                                  [*NOT_ASKED, *failing])
        usual = self.work / "usual.json"
        if "program" in who and not usual.exists():
            print("the sound program", flush=True)
            found = {part: dict(zip(("status", "claims"), self.ask_part(part))) for part in PARTS}
            unfinished = usual.with_suffix(".unfinished")
            unfinished.write_text(json.dumps(found, indent=2))
            os.replace(unfinished, usual)
        self.usual = json.loads(usual.read_text()) if usual.exists() else {}

    def ask_tests(self, mutant):
        """The first test that fails, or nothing, and the seconds of testing until then; None where
        it does not build. Tests of its folder are built and asked before all the others."""
        near, seconds = tests_beside(self.names, mutant.file), 0.
        theirs = {self.programs[number - 1] for number in near} - {None}
        for beside in (True, False):
            if not self.builds(*(sorted(theirs) if beside else [])):
                return None
            start = time.monotonic()
            for batch in self.batches:
                numbers = [str(number) for number in batch if (number in near) == beside]
                failed_log(self.build).unlink(missing_ok=True)
                if numbers and self.run("ctest", "--stop-on-failure", "-I",
                                        "0,0,0," + ",".join(numbers), log="tests.log") != 0:
                    return ((failed_tests(self.build) or ["ctest"])[0],
                            seconds + time.monotonic() - start)
            seconds += time.monotonic() - start
        return "", seconds

    def ask_program(self):
        """What is unusual of the first part of a quick verification of a cell of which anything is;
        parts know nothing of each other, so that the others need not be asked."""
        for part in PARTS:
            said = what_the_program_says(*self.ask_part(part), self.usual[part])
            if said:
                return said
        return ""

    def ask_part(self, part):
        """The exit status, and the claims on the program that failed."""
        output = self.work / "verify"
        shutil.rmtree(output, ignore_errors=True)
        status = self.run(str(self.build / "homespun"), "verify", "--quick", "--no-report",
                          "--output", str(output), "--parts", part, CELL, log="verify.log",
                          cwd=self.copy, seconds=MOST_SECONDS_OF_PROGRAM)
        try:
            verdicts = json.loads((output / "verdicts.json").read_text())["verdicts"]
        except (OSError, ValueError, KeyError):
            verdicts = []
        claims = [one["claim"] for one in verdicts
                  if one["kind"] == "program" and one["verdict"] == "FAIL"]
        return status, claims

    def measured(self, mutant, row, asked):
        """Asks those who are in `asked`. Where no line is executed the program is not asked."""
        executed = executed_in(self.work)
        if executed is not None and mutant.name not in executed:
            row["noticed_by_program"] = ""
            asked = [one for one in asked if one != "program"]
        with Fault(self.copy, mutant):
            found = self.ask_tests(mutant) if "tests" in asked else ("", 0.)
            if found is None or "program" in asked and not self.builds("homespun"):
                return {**row, "noticed_by_test": "", "noticed_by_program": "", "builds": "false"}
            if "tests" in asked:
                row.update(noticed_by_test=found[0], tests_at=self.revision,
                           seconds_to_notice=f"{found[1]:.1f}" if found[0] else "")
            if "program" in asked:
                row.update(noticed_by_program=self.ask_program(), program_at=self.revision)
        return row

    def tried(self, mutant):
        """The row of a mutant that was put in and taken out."""
        path = self.copy / mutant.file
        before = path.read_bytes()
        with Fault(self.copy, mutant):
            if path.read_bytes() == before:
                raise SystemExit(f"{mutant.name} changes nothing")
        if path.read_bytes() != before:
            raise SystemExit(f"{mutant.name} is left in {path}")
        return new_row(mutant)


WHO = {"tests": "noticed_by_test", "program": "noticed_by_program"}


def measure(mutants, table, row_of, who=tuple(WHO)):
    """Adds what is missing. row_of(mutant, row, asked) fills in the columns of those asked."""
    for mutant in mutants:
        row = dict(table.rows.get(mutant.name, new_row(mutant)))
        asked = [one for one in who if row[WHO[one]] == NOT_YET]
        if asked and row["builds"] == "true":
            row = row_of(mutant, row, asked)
            table.add(row)
            print(", ".join(f"{name} {row[name]}" for name in COLUMNS if row[name]), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--score", action="store_true")
    parser.add_argument("--dry", action="store_true")
    parser.add_argument("--ask", choices=list(WHO))
    parser.add_argument("build", nargs="?")
    parser.add_argument("work", nargs="?")
    parser.add_argument("names", nargs="*")
    given = parser.parse_args()
    mutants = patches.read()
    if given.list:
        for mutant in mutants:
            print(f"{mutant.kind:7} {mutant.name:36} {mutant.file}: {mutant.sentence}")
        return
    if given.score:
        print(score(list(Table(patches.HERE / "measured.csv").rows.values()),
                    executed_in(patches.HERE)))
        return
    if given.work is None:
        parser.error("BUILD and WORK are needed")
    unknown = set(given.names) - {mutant.name for mutant in mutants}
    if unknown:
        parser.error(f"no mutant is called {', '.join(sorted(unknown))}; see --list")
    if given.names:
        mutants = [mutant for mutant in mutants if mutant.name in given.names]
    workshop = Workshop(given.build, given.work)
    if given.dry:
        measure(mutants, Table(workshop.work / "dry.csv"),
                lambda mutant, row, asked: workshop.tried(mutant))
        return
    table = Table(workshop.work / "mutants.csv")
    who = [given.ask] if given.ask else list(WHO)
    workshop.prepare(who)
    measure(mutants, table, workshop.measured, who)
    print(score(list(table.rows.values()), executed_in(workshop.work)))


if __name__ == "__main__":
    sys.exit(main())
