# SPDX-License-Identifier: MIT
"""What the tests of the program share: running it, and folders that go away."""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.util

unittest.util._MAX_LENGTH = 4000  # of what an assertion shows: Status is longer than 80 letters
PROGRAM = os.environ["HOMESPUN"]
PATIENCE = int(os.environ.get("PATIENCE", "1"))  # more where all assertions are on
LONG = "LONG" in os.environ  # the configuration of that name
MPIEXEC = os.environ.get("MPIEXEC", "mpiexec")
CELLS = pathlib.Path(__file__).resolve().parents[3] / "meshes" / "cells"
# Shipped cells on coarse meshes, where the statement does not depend on the mesh.
COARSE = CELLS.parents[1] / "tests" / "cells"
LAYERED, THREE = COARSE / "layered.prm", COARSE / "three-stiffness.prm"
WEAVE = COARSE / "plain-weave-straight.prm"  # a thousand times as stiff along a yarn as in shear


class Status(int):
    """An exit status that shows, where an assertion on it fails, what the program said."""

    def __new__(cls, status, command, stderr):
        made = super().__new__(cls, status)
        made.shown = f"{status} of {' '.join(map(str, command))}, which said: {stderr[-2000:]}"
        return made

    def __repr__(self):
        return self.shown


def run(*arguments, ranks=1, **options):
    """Runs homespun and returns the finished process, with its output as text."""
    command = [PROGRAM, *map(str, arguments)]
    if ranks > 1:
        command = [MPIEXEC, "--oversubscribe", "-n", str(ranks), *command]
    result = subprocess.run(command, capture_output=True, text=True, timeout=600 * PATIENCE,
                            check=False, **options)
    result.returncode = Status(result.returncode, command, result.stderr)
    return result


def rows_of(path):
    """The rows of a table."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def page_of(folder):
    """The page of a run, made by this process without the pictures, which take most of the time."""
    sys.path.append(str(CELLS.parents[1] / "tests" / "verification" / "report"))
    import page_case  # pylint: disable=import-outside-toplevel,import-error
    with page_case.drawn_alone(()):
        status = page_case.report.main([str(folder), "--output", str(folder), "--quiet"])
    assert status in (None, 0), status
    return (folder / "report.html").read_text(encoding="utf-8")


def cut(folder):
    """Makes of a run that ended one that was killed, as far as its run.json tells."""
    path = folder / "run.json"
    description = json.loads(path.read_text(encoding="utf-8"))
    description["finished"] = False
    del description["files"]
    path.write_text(json.dumps(description), encoding="utf-8")


def status_of(verdicts):
    """The exit status that claims amount to."""
    outcomes = {verdict["verdict"] for verdict in verdicts}
    return 1 if "FAIL" in outcomes else 4 if "INCONCLUSIVE" in outcomes else 0


class InFolder(unittest.TestCase):
    """A test with an empty folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="homespun-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def cell_with(self, before, after):
        """A copy of a coarse cell, with one piece of its .prm replaced."""
        shutil.copy(COARSE / "layered.msh", self.folder)
        text = LAYERED.read_text(encoding="utf-8")
        self.assertIn(before, text)
        path = self.folder / "layered.prm"
        path.write_text(text.replace(before, after), encoding="utf-8")
        return path

    def assert_same_rows(self, found, expected):
        """Texts are equal, and numbers but times to what a solver leaves open."""
        self.assertEqual(len(found), len(expected))
        for one, two in zip(found, expected):
            for key, value in two.items():
                if key.startswith("seconds"):
                    continue
                try:
                    number = float(value)
                except ValueError:
                    self.assertEqual(one[key], value, two)
                else:
                    self.assertAlmostEqual(float(one[key]), number,
                                           delta=2e-5 * abs(number) + 1e-13, msg=f"{key} of {two}")
