# SPDX-License-Identifier: MIT
"""What the tests of pages share: making a report of a folder, reading it, breaking results, and
refusals.
"""
import contextlib
import csv
import io
import os
import shutil
import tempfile
import unittest
from unittest import mock

import report_path  # noqa: F401
import report
from figures import animation, cloth, plot_data
from made_up_run import list_again, write_table
from page import gallery


def draw_small_cloth(add_cleanup):
    """Cloth in motion in few pixels until the cleanup: seconds instead of minutes."""
    for module, name in ((cloth, "PIXELS"), (animation, "MOVING_PIXELS")):
        small = mock.patch.object(module, name, 60)
        small.start()
        add_cleanup(small.stop)


def draw_alone(add_cleanup):
    """Figures are drawn and not saved until the cleanup, and are empty pictures on the page: for
    pages whose figures another test saves, made of the same results. Laying a figure out and
    writing it takes nine tenths of the time of a page.
    """

    def save(_, figure, name, as_image, table, plotted):
        panels = None if as_image or not plotted else plot_data.panels_of(figure)
        return f"data:image/svg+xml,{name}", 400, (), gallery.in_page(panels)

    drawn = mock.patch.object(gallery.Gallery, "save", save)
    drawn.start()
    add_cleanup(drawn.stop)


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

    def edit(self, name, change, listed=True):
        """Changes a file of the results.

        @param listed whether as if the run had written it so; else run.json tells that it was
            changed
        """
        path = os.path.join(self.folder, name)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(change(text))
        if listed:
            list_again(self.folder)

    def edit_table(self, name, change):
        """Changes the rows of a table, dictionaries of texts, as if the run had written it so.

        @param change takes the rows; what it returns, or the same rows where it returns nothing, is
            written
        """
        path = os.path.join(self.folder, name)
        with open(path, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        changed = change(rows)
        write_table(self.folder, name, rows if changed is None else changed)
        list_again(self.folder)

    def remove(self, *names):
        """Removes files, as if the run had not written them."""
        for name in names:
            os.remove(os.path.join(self.folder, name))
        list_again(self.folder)

    def assert_refused(self, *words):
        """Exit status 2, every word in the message, and nothing written."""
        status, errors = self.run_report()
        self.assertEqual(status, 2)
        for word in words:
            self.assertIn(word, errors)
        self.assertFalse(os.path.exists(self.output))
