# SPDX-License-Identifier: MIT
"""What tests of the package share: places, a folder that goes away, a cell in it, the code of
pages, meshes in files, refusals by their text, and whether others run meanwhile."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import homespun

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["HOMESPUN_BUILD"])
CELLS = SOURCE / "meshes" / "cells"
COARSE = SOURCE / "tests" / "cells"  # some of them on coarse meshes
SIDE = 0.01  # of the cell [m]


def address(array):
    return array.__array_interface__["data"][0]


def shown_in(page):
    """The blocks of Python in a page, or in a part of its text."""
    text = page if isinstance(page, str) else page.read_text(encoding="utf-8")
    return re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)


def write_obj(path, positions, triangles, vt=None):
    """One vt for each vertex where there are some."""
    with open(path, "w", encoding="utf-8") as file:
        file.writelines("v {!r} {!r} {!r}\n".format(*map(float, row)) for row in positions)
        file.writelines("vt {!r} {!r}\n".format(*map(float, row)) for row in ([] if vt is None else vt))
        for corners in triangles + 1:
            file.write("f " + " ".join(f"{k}" if vt is None else f"{k}/{k}" for k in corners) + "\n")


class Refusing(unittest.TestCase):
    def refused(self, call, *texts, kind=ValueError):
        with self.assertRaises(kind) as caught:
            call()
        for text in texts:
            self.assertIn(text, str(caught.exception))


class WithFolder(Refusing):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="homespun-python-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)


class WithCell(WithFolder):
    """Two stripes across axis 1, the laminate in closed form."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = cls.folder / "cell.h5"
        subprocess.run([os.environ["HOMESPUN_MAKE_CELL"], cls.file], check=True)
        cls.cell = homespun.Cell.read(cls.file)


def run_in_threads(work, *arguments, n=4):
    """Runs `work()`, defined in lines of code, in threads of a process of its own, which ends well."""
    code = (f"import homespun, sys, threading\n{work}\nfaults = []\n"
            "def tell(fault):\n    faults.append(fault)\n    sys.excepthook(*fault[:3])\n"
            "threading.excepthook = tell\n"
            f"threads = [threading.Thread(target=work) for _ in range({n})]\n"
            "for thread in threads: thread.start()\n"
            "for thread in threads: thread.join()\n"
            "sys.exit(len(faults))\n")
    subprocess.run([sys.executable, "-B", "-W", "error", "-c", code, *map(str, arguments)], check=True)


def turns_of_others(call):
    """How often another thread has its turn during a call: never where the interpreter is held."""
    count, stop = [0], threading.Event()

    def counting():
        while not stop.is_set():
            count[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=counting)
    thread.start()
    try:
        before = count[0]
        call()
        return count[0] - before
    finally:
        stop.set()
        thread.join()
