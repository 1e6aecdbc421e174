# SPDX-License-Identifier: MIT
"""A disk that is full: one message, exit status 2, and what was written before stays."""
import subprocess
import unittest

from cli import CELLS, InFolder, rows_of, run

SCENES = CELLS.parent / "scenes"
FULL = "cannot be written: is the disk full?"


class FullDisk(InFolder):
    def disk(self, size):
        """A disk of so many kilobytes."""
        place = self.folder / f"disk{size}"
        place.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", place],
                                 capture_output=True, text=True, check=False)
        if mounted.returncode != 0:
            self.skipTest("a small disk can be mounted by root alone: " + mounted.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", place], check=False)
        return place

    def refused(self, result):
        """Ends with its own status and the message, and nothing else goes wrong."""
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertIn(FULL, result.stderr)
        for word in ("Traceback", "terminate called", "Segmentation", "signal", "HDF5-DIAG"):
            self.assertNotIn(word, result.stderr)

    def test_homogenize(self):
        for size in (4, 20, 40):
            place = self.disk(size)
            self.refused(run("homogenize", CELLS / "layered.prm", "--order", 1, "--no-bars",
                             "--quiet", "--output", place / "out"))
            self.assertEqual(list(place.rglob("*.part")), [])

    def test_strain(self):
        for size in (60, 140, 160):  # the cell, the table or the sheet
            self.refused(run("strain", CELLS / "layered.prm", "--cells", 2, "--strains", "0.01",
                             "--loads", "strip-1", "--references", "linear", "--methods",
                             "localized", "--no-budget", "--no-runtime", "--no-report", "--output",
                             self.disk(size) / "out"))

    def test_drape_keeps_the_frames_that_it_wrote(self):
        for options in ([], ["--no-frames", "--references", "shell"]):
            place = self.disk(500 if options == [] else 60)
            result = run("drape", SCENES / "pull.prm", "--quick", "--duration", 0.3, "--unit-cells",
                         CELLS / "layered.prm", "--no-report", *options, "--output", place / "out")
            self.refused(result)
            if not options:
                self.assertGreater(len(rows_of(place / "out" / "motion.csv")), 1)
                self.assertTrue((place / "out" / "layered-biot" / "fine_0000.vtu").exists())

    def test_stress_keeps_its_rows(self):
        place = self.disk(20)
        self.refused(run("stress", "--quick", "--quiet", "--no-report", "--output", place / "out"))
        self.assertGreater(len(rows_of(place / "out" / "stress.csv")), 1)

    def test_report(self):
        output = self.folder / "results"
        self.assertEqual(run("homogenize", CELLS / "layered.prm", "--order", 1, "--no-bars",
                             "--quiet", "--output", output).returncode, 0)
        for size in (8, 200, 400):
            result = run("report", output, "--output", self.disk(size) / "page")
            self.refused(result)
            self.assertFalse((self.folder / f"disk{size}" / "page" / "report.html").exists())


if __name__ == "__main__":
    unittest.main()
