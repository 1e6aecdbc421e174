# SPDX-License-Identifier: MIT
"""homespun judge: positions of other programs against the references that a study kept."""
import importlib.util
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest

import h5py
import numpy

from cli import CELLS, InFolder, rows_of, run

PEERS = CELLS.parents[1] / "python" / "peers"
NORMS = ("error_mean_m", "error_rms_m", "error_max_m", "error_mean_per_cell",
         "error_mean_per_fluctuation", "error_interior_m", "error_edge_m", "cells",
         "coarse_triangles", "fine_triangles", "reference_uncertainty_m",
         "reference_uncertainty_max_m", "reference_to_refined_m", "seconds_reference")


class Judge(InFolder):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="homespun-")
        cls.addClassCleanup(folder.cleanup)
        cls.study = pathlib.Path(folder.name) / "study"
        cls.said = run("strain", CELLS / "layered.prm", "--cells", "4", "--loads",
                       "strip-1,periodic-11", "--references", "linear,biot", "--strains",
                       "0.01,0.1", "--no-budget", "--no-runtime", "--no-report", "--keep",
                       "--output", cls.study).stderr
        cls.kept = cls.study / "layered" / "positions"
        cls.rows = rows_of(cls.study / "strain.csv")
        with h5py.File(cls.kept / "sheet.h5") as file:
            cls.triangles = file["triangles"][...]

    def reference(self, level):
        with h5py.File(self.kept / f"{level}.h5") as file:
            return file["reference"][...]

    def affine(self):
        """The rest sheet, pulled evenly."""
        with h5py.File(self.kept / "sheet.h5") as file:
            return file["rest"][...] * [1.1, 0.97]

    def write(self, name, positions):
        path = self.folder / name
        numpy.save(path, positions)
        return path

    def judged(self, *files, name="mine", report=False):
        output = self.folder / f"judged-{name}"
        result = run("judge", self.study, *files, "--name", name, "--output", output, "--overwrite",
                     *([] if report else ["--no-report"]))
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        return {f"{row['load']}-{row['reference']}-{float(row['strain']):g}": row
                for row in rows_of(output / "strain.csv") if row["method"] == name}, result

    def row(self, method, load="strip-1", reference="biot", strain="0.1"):
        wanted = (method, load, reference, strain)
        return next(row for row in self.rows if (row["method"], row["load"], row["reference"],
                                                 row["strain"]) == wanted)

    def test_positions_of_a_method_of_the_study_have_its_numbers_to_the_last_bit(self):
        with h5py.File(self.study / "layered" / "fields-strip-1.h5") as file:
            full = file["upsampled"][...]
        with h5py.File(self.folder / "strip-1-biot-0.1.h5", "w") as file:
            file["positions"] = full
        in_space = numpy.asfortranarray(numpy.column_stack([full, 0.0 * full[:, 0]]))
        for path in (self.write("strip-1-biot-0.1.npy", full),
                     self.folder / "strip-1-biot-0.1.h5",
                     self.write("strip-1-biot-0.1.npy", in_space)):
            rows, result = self.judged(path)
            own = rows["strip-1-biot-0.1"]
            self.assertEqual([own[key] for key in NORMS], [self.row("full")[key] for key in NORMS])
            self.assertEqual(own["error_bar_m"], own["reference_uncertainty_m"])
            self.assertIn("0 of 8 methods of homespun are closer", result.stdout)
        # All that the study said stays, and the method has claims of its own.
        before, after = self.rows, rows_of(self.folder / "judged-mine" / "strain.csv")
        self.assertEqual([row for row in after if row["method"] != "mine"], before)
        self.assertIn("2 of 2 claims hold", result.stdout)
        claims = json.loads((self.folder / "judged-mine" / "verdicts.json").read_text())["verdicts"]
        said = json.loads((self.study / "verdicts.json").read_text())["verdicts"]
        self.assertEqual(claims[:-2], said)
        self.assertEqual({claim["kind"] for claim in claims[-2:]}, {"method"})
        self.assertIn("positions of all levels are kept, at most 1 MB", self.said)

    def test_a_method_from_outside_is_judged_on_every_level(self):
        subprocess.run([sys.executable, "-B", PEERS / "flat.py", self.kept, self.folder / "flat"],
                       check=True)
        rows, _ = self.judged(self.folder / "flat", name="flat", report=True)
        self.assertEqual(len(rows), 8)
        for row in rows.values():  # what `affine` does, written again in numpy
            affine = self.row("affine", row["load"], row["reference"], row["strain"])
            self.assertAlmostEqual(float(row["error_mean_m"]) / float(affine["error_mean_m"]), 1.,
                                   delta=1e-9)
        page = (self.folder / "judged-flat" / "report.html").read_text(encoding="utf-8")
        text = re.sub("<[^>]*>", " ", page)
        self.assertRegex(text, r"\d of \d \(strip-1\) methods of homespun are closer than flat, "
                               r"whose error is [\d.]+ \(strip-1\) times that of full")

    def test_a_table_tells_levels_files_and_seconds(self):
        shifted = self.reference("strip-1-biot-0.1") + [1e-8, 0.]
        (self.folder / "some").mkdir()
        self.write("some/one.npy", shifted)
        self.write("some/two.npy", shifted)
        table = self.folder / "table.csv"
        table.write_text("file, load,law,strain,seconds,remark\r\n"
                         "some/one.npy,strip-1,biot,0.1,2.5,x\r\n\r\n"
                         "some/two.npy,strip-1,linear,0.1,,x")
        rows, _ = self.judged(table)
        self.assertEqual(set(rows), {"strip-1-biot-0.1", "strip-1-linear-0.1"})
        # The coarse cloth's time comes to the method's, as in homespun's own.
        cloth = next(row for row in rows_of(self.study / "levels.csv") if row["part"] == "" and
                     (row["load"], row["reference"], row["strain"]) == ("strip-1", "biot", "0.1"))
        self.assertAlmostEqual(float(rows["strip-1-biot-0.1"]["seconds_method"]),
                               2.5 + float(cloth["seconds_coarse_solve"]), delta=1e-12)
        self.assertEqual(rows["strip-1-linear-0.1"]["seconds_method"], "")
        good = "load,law,strain,file\n"
        for text, *words in (
                (good + "strip-1,biot,0.1,some/none.npy\nstrip-1,elastic,0.1,some/one.npy\n",
                 "table.csv, line 2: ", "none.npy is not there", "line 3: unknown reference"),
                (good + "strip-1,biot,10%,some/one.npy\n", "line 2: expected a load"),
                (good + "strip-1,biot,0.1\n", "line 2: found 3 fields; expected 4"),
                ("load,law,strain\nstrip-1,biot,0.1\n", "line 2: expected a load"),
                (good, "expected a row at least"),
                (good + 2 * "strip-1,biot,0.1,some/one.npy\n", "expected one file for each"),
                (good + "strip-1,biot,0.3,some/one.npy\n", "is of no level")):
            table.write_text(text)
            result = run("judge", self.study, table, "--output", self.folder / "refused")
            self.assertEqual(result.returncode, 2)
            for word in words:
                self.assertIn(word, result.stderr)

    def test_a_shift_is_seen_in_a_sheet_and_means_nothing_in_infinite_cloth(self):
        shift = [1e-8, 0.]  # a millionth of a cell
        files = [self.write(f"{level}.npy", self.reference(level) + shift)
                 for level in ("strip-1-biot-0.1", "periodic-11-biot-0.1")]
        rows, _ = self.judged(*files)
        self.assertAlmostEqual(float(rows["strip-1-biot-0.1"]["error_mean_m"]), 1e-8, delta=1e-15)
        self.assertLess(float(rows["periodic-11-biot-0.1"]["error_mean_m"]), 1e-15)

    def test_files_with_few_digits_say_so(self):
        wanted = self.reference("strip-1-biot-0.1") + [0., 2e-6]
        path = self.folder / "strip-1-biot-0.1.obj"
        path.write_text("".join(f"v {x:.5f} {y:.5f} 0\n" for x, y in wanted) +
                        "".join(f"f {a} {b} {c}\n" for a, b, c in self.triangles + 1))
        rows, result = self.judged(path)
        self.assertAlmostEqual(float(rows["strip-1-biot-0.1"]["error_mean_m"]), 2e-6, delta=5e-6)
        self.assertIn("its numbers tell 1e-05 m apart", result.stdout)
        rows, _ = self.judged(self.write("strip-1-biot-0.1.npy", wanted.astype("f4")))
        self.assertAlmostEqual(float(rows["strip-1-biot-0.1"]["error_mean_m"]), 2e-6, delta=1e-8)

    @unittest.skipUnless(importlib.util.find_spec("meshio"), "meshio is not installed")
    def test_meshio_reads_vtu_to_the_last_bit(self):
        import meshio
        rows, _ = self.judged(self.write("strip-1-biot-0.1.npy", self.affine()))
        wanted = [rows["strip-1-biot-0.1"][key] for key in NORMS]
        path = self.folder / "strip-1-biot-0.1.vtu"
        in_space = numpy.column_stack([self.affine(), 0.0 * self.affine()[:, 0]])
        for compression in ("zlib", None):
            meshio.Mesh(in_space, [("triangle", self.triangles)]).write(path,
                                                                        compression=compression)
            rows, result = self.judged(path)
            self.assertEqual([rows["strip-1-biot-0.1"][key] for key in NORMS], wanted)
            self.assertNotIn("its numbers tell", result.stdout)
        meshio.Mesh(in_space, [("triangle", self.triangles[::-1])]).write(path)
        for words in ("its faces are not those", "cannot read as .vtu"):
            result = run("judge", self.study, path)
            self.assertEqual(result.returncode, 2)
            self.assertIn(words, result.stderr)
            path.write_text("<VTKFile", encoding="utf-8")

    def test_what_cannot_be_judged_is_refused_with_what_to_do(self):
        good = self.reference("strip-1-biot-0.1")
        nan = good.copy()
        nan[3, 1] = numpy.nan
        order = numpy.random.default_rng(1).permutation(len(good))
        out_of_plane = numpy.column_stack([good, numpy.full(len(good), 1e-3)])
        for name, positions, words in (
                ("strip-1-biot-0.1", nan, "holds NaN"),
                ("strip-1-biot-0.1", good[:-1], rf"expected \({len(good)}, 2\)"),
                ("strip-1-biot-0.1", 1e3 * good, "expected positions in metres, in the order"),
                ("strip-1-biot-0.1", good[order], "expected positions in metres, in the order"),
                ("strip-1-biot-0.1", good.astype(int), "astype"),
                ("strip-1-biot-0.1", out_of_plane, "third column"),
                ("strip-1-biot-0.2", good, "is of no level"),
                ("mine", good, "is of no level")):
            path = self.write(f"{name}.npy", positions)
            result = run("judge", self.study, path, "--output", self.folder / "refused")
            self.assertEqual(result.returncode, 2)
            self.assertRegex(result.stderr, words)
            self.assertFalse((self.folder / "refused").exists())
            path.unlink()
        swapped = self.folder / "strip-1-biot-0.1.obj"
        swapped.write_text("".join(f"v {x} {y} 0\n" for x, y in good) +
                           "".join(f"f {b} {a} {c}\n" for a, b, c in self.triangles + 1))
        path = self.write("strip-1-biot-0.1.npy", good)
        for words, *arguments in (
                ("its faces are not those", self.study, swapped),
                ("expected one file for each", self.study, swapped, path),
                ("no method of homespun", self.study, path, "--name", "affine"),
                ("--name: found", self.study, path, "--name", "my method"),
                ("--name: found", self.study, path, "--name", "base"),
                ("is not there", self.study, self.folder / "nothing.npy"),
                ("no run", self.folder, path)):
            result = run("judge", *arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn(words, result.stderr)
        # A study without --keep has nothing to judge against, and what was judged is no study.
        without = self.folder / "without"
        shutil.copytree(self.study, without, ignore=shutil.ignore_patterns("positions"))
        self.judged(path)
        for words, study in (("strain --keep", without), ("judged", self.folder / "judged-mine")):
            result = run("judge", study, path)
            self.assertEqual(result.returncode, 2)
            self.assertIn(words, result.stderr)


class JudgeFrames(InFolder):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="homespun-")
        cls.addClassCleanup(folder.cleanup)
        cls.study = pathlib.Path(folder.name) / "study"
        result = run("drape", CELLS.parent / "scenes" / "pull.prm", "--unit-cells",
                     CELLS / "layered.prm", "--duration", "0.1", "--quick", "--references", "biot",
                     "--keep", "--no-report", "--no-frames", "--output", cls.study)
        assert result.returncode in (0, 1, 4), result.stderr
        cls.kept = cls.study / "layered" / "positions"
        cls.rows = rows_of(cls.study / "drape.csv")

    def judged(self, frames, name, study=None):
        files = self.folder / name
        files.mkdir()
        for frame, positions in frames.items():
            numpy.save(files / f"biot-{frame:04d}.npy", positions)
        return run("judge", study or self.study, files, "--name", name, "--output",
                   self.folder / f"judged-{name}", "--no-report")

    def kept_frame(self, frame, what="reference"):
        with h5py.File(self.kept / f"biot-{frame:04d}.h5") as file:
            return file[what][...]

    def test_frames_of_a_method_from_outside_have_the_errors_of_the_study(self):
        sys.path.insert(0, str(PEERS))
        from flat import flat
        with h5py.File(self.kept / "cloth.h5") as file:
            mesh = types.SimpleNamespace(**{name: file[name][...] for name in file})
        self.assertEqual(mesh.start.shape, (len(mesh.rest), 3))
        frames = {frame: flat(mesh)(self.kept_frame(frame, "coarse")) for frame in (0, 1, 2)}
        result = self.judged(frames, "flat")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, "biot, frame 2: .*; 1 of 2 methods of homespun are closer")
        rows = rows_of(self.folder / "judged-flat" / "drape.csv")
        self.assertEqual(rows[:len(self.rows)], self.rows)
        affine = [row for row in self.rows if row["method"] == "affine"]
        own = rows[len(self.rows):]
        self.assertEqual(len(own), 3)
        for row, like in zip(own[1:], affine[1:]):
            for key in row:
                if key.startswith("error"):
                    self.assertAlmostEqual(float(row[key]) / float(like[key]), 1., delta=1e-9)
                elif key != "method":
                    self.assertEqual(row[key], like[key])

    def test_a_shift_by_a_millionth_of_a_cell_is_seen(self):
        self.judged({2: self.kept_frame(2) + [0., 0., 1e-8]}, "shifted")
        own = rows_of(self.folder / "judged-shifted" / "drape.csv")[-1]
        self.assertAlmostEqual(float(own["error_mean_m"]), 1e-8, delta=1e-15)
        # The fluctuation is what the coarse motion lacks, the side of the cell a centimetre.
        lacks = next(float(row["error_mean_m"]) for row in self.rows
                     if row["method"] == "affine" and row["frame"] == "2")
        self.assertAlmostEqual(float(own["error_mean_per_fluctuation"]) * lacks, 1e-8, delta=1e-15)
        self.assertAlmostEqual(float(own["error_mean_per_cell"]), 1e-6, delta=1e-13)

    def test_what_cannot_be_judged_is_refused_with_what_to_do(self):
        good = self.kept_frame(2)
        for name, frames, words in (
                ("flat", {2: good[:, :2]}, "expected three components"),
                ("short", {2: good[1:]}, f"expected ({len(good)}, 2) or ({len(good)}, 3)"),
                ("metres", {2: 1e3 * good}, "expected positions in metres"),
                ("late", {9: good}, "as in biot-0000.npy"),
                ("affine", {2: good}, "no method of homespun")):
            result = self.judged(frames, name)
            self.assertEqual(result.returncode, 2)
            self.assertIn(words, result.stderr)
            self.assertFalse((self.folder / f"judged-{name}").exists())
        without = self.folder / "without"
        shutil.copytree(self.study, without, ignore=shutil.ignore_patterns("positions"))
        result = self.judged({2: good}, "mine", without)
        self.assertEqual(result.returncode, 2)
        self.assertIn("drape --keep", result.stderr)


if __name__ == "__main__":
    unittest.main()
