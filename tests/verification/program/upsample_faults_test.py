# SPDX-License-Identifier: MIT
"""What homespun upsample cannot use is named, all of it, before anything is written."""
import shutil
import unittest

import h5py
import numpy

from cli import run
from upsample_case import Upsampling


class BadInput(Upsampling):
    def test_frames_that_are_none_are_named_with_what_was_expected(self):
        swapped = [(a, c, b) if k == 5 else (a, b, c)
                   for k, (a, b, c) in enumerate(self.triangles)]
        far = self.vertices.tolist()
        far[7][1] = float("nan")
        cases = {
            "more.obj": (numpy.vstack([self.vertices, [[0, 0, 1]]]), None,
                         "more.obj: has 26 vertices; expected 25, those of"),
            "fewer.obj": (None, self.triangles[:-1], "fewer.obj: has 31 faces; expected 32"),
            "swapped.obj": (None, swapped, "swapped.obj: face 5 has the vertices 2 7 8 (from 0); "
                            "expected 2 8 7"),
            "far.obj": (numpy.array(far), None,
                        "far.obj: line 8: found `nan`; expected a finite number, v 8 of the file"),
        }
        for name, (vertices, triangles, words) in cases.items():
            with self.subTest(name=name):
                self.frame(name, vertices, triangles)
                message = self.upsample(self.frame("good.obj"), self.folder / name, status=2)
                self.assertIn(words, message.replace(str(self.folder) + "/", ""))
                self.assertFalse(self.output.exists())

    def test_all_faults_of_all_frames_are_told_at_once(self):
        bad = [self.frame(f"bad_{k}.obj", triangles=self.triangles[:k + 1]) for k in range(12)]
        message = self.upsample(*bad, status=2)
        self.assertEqual(message.count("faces; expected 32"), 10)
        self.assertIn("and 2 more faults of frames", message)

    def test_what_cannot_be_used_is_named(self):
        good = self.frame("good.obj")
        bent = self.vertices + [[0., 0., 0.001 * k * k] for k in range(len(self.vertices))]
        ply = self.folder / "nan.ply"
        ply.write_bytes(b"ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
                        b"property float x\nproperty float y\nproperty float z\nelement face 1\n"
                        b"property list uchar int vertex_indices\nend_header\n" +
                        numpy.array([0, 0, 0, 1, 0, 0, 0, numpy.nan, 0], "<f4").tobytes() +
                        b"\3" + numpy.array([0, 1, 2], "<i4").tobytes())
        rest, cell = self.rest, self.cell
        for arguments, words in (
                (("--rest", rest, self.folder / "none_*.obj"), "none_*.obj: no file fits"),
                (("--rest", rest, self.folder / "none.obj"), "none.obj: cannot be read"),
                (("--rest", rest, ply), "nan.ply: vertex 2 is at (0.000000, nan, 0.000000)"),
                (("--rest", rest, rest.with_suffix(".stl")), "found the ending `.stl`"),
                (("--rest", self.frame("bent.obj", bent), good), "bent.obj: is not flat: vertex "),
                (("--rest", rest, good, good), "good.obj: has the name of"),
                (("--rest", rest, good, "--format", "stl"),
                 "--format: found `stl`; expected vtu, ply, obj, usda or pc2"),
                (("--rest", rest, good, "--up", "x"), "--up: found `x`; expected y or z"),
                (("--rest", rest, good, "--origin", "1"), "--origin: expected two numbers"),
                (("--rest", rest, good, "--vt-unit", "-1"),
                 "--vt-unit: found -1; expected a positive"),
                (("--rest", rest, good, "--unit", "0"), "--unit: found 0; expected a positive"),
                (("--rest", rest, good, "--validity", self.folder / "v.csv"),
                 "v.csv: no such file"),
                (("--rest", rest), "FRAMES is required"),
                ((good,), "--rest is required")):
            with self.subTest(words=words):
                result = run("upsample", cell, *arguments, "--output", self.output)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn(words, result.stderr)
                self.assertFalse(self.output.exists())

    def test_cells_and_folders_that_cannot_be_used_are_named(self):
        good = self.frame("good.obj")
        newer = self.folder / "newer.h5"
        shutil.copy(self.cell, newer)
        with h5py.File(newer, "a") as file:
            file.attrs["format_version"] = 2
        for cell, words in ((newer, "newer.h5: found format_version 2; expected at most 1"),
                            (self.rest, "rest.obj: is not a readable HDF5 file")):
            result = run("upsample", cell, "--rest", self.rest, good, "--output", self.output)
            self.assertEqual(result.returncode, 2)
            self.assertIn(words, result.stderr)
        self.output.mkdir()
        inside = self.output / "in.obj"
        shutil.copy(good, inside)
        self.assertIn("in.obj: lies in the folder of the results", self.upsample(inside, status=2))
        self.assertTrue(inside.exists())
        cell = self.output / "cell.h5"
        shutil.copy(self.cell, cell)
        result = run("upsample", cell, "--rest", self.rest, good, "--output", self.output)
        self.assertEqual(result.returncode, 2)
        self.assertIn("cell.h5: lies in the folder of the results", result.stderr)
        self.assertTrue(cell.exists())

    def test_an_older_cell_without_a_version_is_read(self):
        older = self.folder / "older.h5"
        shutil.copy(self.cell, older)
        with h5py.File(older, "a") as file:
            del file.attrs["format_version"]
        result = run("upsample", older, "--rest", self.rest, self.frame("a.obj"), "--quiet",
                     "--output", self.output)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))


if __name__ == "__main__":
    unittest.main()
