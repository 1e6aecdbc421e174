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
from figures import animation, cloth
from made_up_run import list_again, write_table
from page import gallery


def draw_small_cloth(add_cleanup):
    """Cloth in motion in few pixels until the cleanup: seconds instead of minutes."""
    for module, name in ((cloth, "PIXELS"), (animation, "MOVING_PIXELS")):
        small = mock.patch.object(module, name, 60)
        small.start()
        add_cleanup(small.stop)


@contextlib.contextmanager
def drawn_alone(saved):
    """All figures are drawn and their numbers written; pictures of those named alone are laid out
    and saved, which takes nine tenths of the time of a page. All by this process.
    """
    save_picture = gallery.Gallery.save_picture

    def save(its, figure, name, as_image):
        if name in saved:
            return save_picture(its, figure, name, as_image)
        return f"data:image/svg+xml,{name}", 400

    with mock.patch.object(gallery.Gallery, "save_picture", save), mock.patch.object(
        os, "sched_getaffinity", return_value={0}
    ):
        yield


class PageTest(unittest.TestCase):
    """A test with a folder for results and one for the page made of them."""

    def setUp(self):
        self.place = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.place)
        self.folder, self.output = (os.path.join(self.place, name) for name in ("results", "out"))

    def run_report(self, *folders, saved=()):
        """(exit status, text on stderr) of a page for those who read it.

        @param saved names of figures whose pictures are wanted, too; other tests save the others
        """
        with drawn_alone(saved):
            found = self.whole_report(*folders)
        files = [os.path.join(self.output, "figures", f"{name}.svg") for name in saved]
        self.assertEqual([file for file in files if not os.path.isfile(file)], [])
        return found

    def whole_report(self, *folders):
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


class OnePageTest(PageTest):
    """One page for all tests of a class, with all pictures, of the folders that `made` returns."""

    @classmethod
    def setUpClass(cls):
        case = cls("made")
        PageTest.setUp(case)
        cls.addClassCleanup(case.doCleanups)
        case.assertEqual(case.whole_report(*case.made()), (0, ""))
        cls.text, cls.made_in = case.page(), case.output

    def setUp(self):
        """The page is there."""
