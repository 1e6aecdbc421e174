# SPDX-License-Identifier: MIT
"""What tests of the package share: a cell in a folder that goes away, and refusals by their text."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import homespun

SIDE = 0.01  # of the cell [m]


def address(array):
    return array.__array_interface__["data"][0]


class Refusing(unittest.TestCase):
    def refused(self, call, *texts, kind=ValueError):
        with self.assertRaises(kind) as caught:
            call()
        for text in texts:
            self.assertIn(text, str(caught.exception))


class WithCell(Refusing):
    """Two stripes across axis 1, the laminate in closed form."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="homespun-python-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.file = cls.folder / "cell.h5"
        subprocess.run([os.environ["HOMESPUN_MAKE_CELL"], cls.file], check=True)
        cls.cell = homespun.Cell.read(cls.file)
