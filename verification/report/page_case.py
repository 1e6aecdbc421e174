# SPDX-License-Identifier: MIT
"""What the tests of pages share: making a report of a folder, reading it, breaking results, and refusals."""
import contextlib
import io
import os
import shutil
import tempfile
import unittest

import report


class PageTest(unittest.TestCase):
    """A test with a folder for results and one for the page made of them."""

    def setUp(self):
        self.place = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.place)
        self.folder, self.output = (os.path.join(self.place, name) for name in ("results", "out"))

    def run_report(self, *folders):
        """(exit status, text on stderr)"""
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            status = report.main([*(folders or (self.folder,)), "--output", self.output, "--quiet"])
        return status, errors.getvalue()

    def page(self):
        with open(os.path.join(self.output, "report.html"), encoding="utf-8") as file:
            return file.read()

    def edit(self, name, change):
        path = os.path.join(self.folder, name)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(change(text))

    def assert_refused(self, *words):
        """Exit status 2, every word in the message, and nothing written."""
        status, errors = self.run_report()
        self.assertEqual(status, 2)
        for word in words:
            self.assertIn(word, errors)
        self.assertFalse(os.path.exists(self.output))
