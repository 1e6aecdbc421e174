# SPDX-License-Identifier: MIT
"""homespun judge: positions of other programs against the references that a study kept."""
import importlib.util
import itertools
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

import broken_cells_test
from cli import CELLS, LAYERED, page_of, rows_of, run
from judge_case import JudgingFrames, JudgingLevels

PEERS = CELLS.parents[1] / "python" / "peers"
NORMS = ("error_mean_m", "error_rms_m", "error_max_m", "error_mean_per_cell",
         "error_mean_per_fluctuation", "error_interior_m", "error_edge_m", "cells",
         "coarse_triangles", "fine_triangles", "reference_uncertainty_m",
         "reference_uncertainty_max_m", "reference_to_refined_m", "seconds_reference")


class OfACellNumberedBackwards(JudgingLevels):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="homespun-")
        cls.addClassCleanup(folder.cleanup)
        cell = broken_cells_test.Cell()
        cell.points.reverse()
        cell.triangles = [[len(cell.points) - 1 - v for v in t] for t in cell.triangles]
        cls.make("strain", cell.write(pathlib.Path(folder.name)), "--cells", "4", "--loads",
                 "periodic-11", "--references", "biot", "--strains", "0.1", "--no-budget",
                 "--no-runtime")
        cls.kept = cls.study / "cell" / "positions"

    def test_infinite_cloth_is_laid_on_its_reference_at_the_anchor(self):
        level = "periodic-11-biot-0.1"
        shifted = self.kept_positions(level) + [1e-6, -2e-6]
        rows, _ = self.judged(self.write(f"{level}.npy", shifted))
        self.assertLess(float(rows[level]["error_mean_m"]), 1e-15)


class Judge(JudgingLevels):
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
        rows, _ = self.judged(self.folder / "flat", name="flat")
        self.assertEqual(len(rows), 8)
        for row in rows.values():  # what `affine` does, written again in numpy
            affine = self.row("affine", row["load"], row["reference"], row["strain"])
            self.assertAlmostEqual(float(row["error_mean_m"]) / float(affine["error_mean_m"]), 1.,
                                   delta=1e-9)
        text = re.sub("<[^>]*>", " ", page_of(self.folder / "judged-flat"))
        self.assertRegex(text, r"\d of \d \(strip-1\) methods of homespun are closer than flat, "
                               r"whose error is [\d.]+ \(strip-1\) times that of full")

    def test_a_shift_is_seen_in_a_sheet_and_means_nothing_in_infinite_cloth(self):
        shift = [1e-8, 0.]  # a millionth of a cell
        files = [self.write(f"{level}.npy", self.kept_positions(level) + shift)
                 for level in ("strip-1-biot-0.1", "periodic-11-biot-0.1")]
        rows, _ = self.judged(*files)
        self.assertAlmostEqual(float(rows["strip-1-biot-0.1"]["error_mean_m"]), 1e-8, delta=1e-15)
        self.assertLess(float(rows["periodic-11-biot-0.1"]["error_mean_m"]), 1e-15)

    def test_files_with_few_digits_say_so(self):
        wanted = self.kept_positions("strip-1-biot-0.1") + [0., 2e-6]
        path = self.folder / "strip-1-biot-0.1.obj"
        path.write_text("".join(f"v {x:.5f} {y:.5f} 0\n" for x, y in wanted) +
                        "".join(f"f {a} {b} {c}\n" for a, b, c in self.triangles + 1))
        rows, result = self.judged(path)
        self.assertAlmostEqual(float(rows["strip-1-biot-0.1"]["error_mean_m"]), 2e-6, delta=5e-6)
        self.assertIn("its numbers tell 1e-05 m apart", result.stdout)
        # Three significant digits: more decimals near zero, where they are worth nothing.
        wanted[abs(wanted).sum(axis=1).argmin()] += [1.23e-7, 0.]
        faces = "".join(f"3 {a} {b} {c}\n" for a, b, c in self.triangles)
        ply = (f"ply\nformat ascii 1.0\nelement vertex {len(wanted)}\nproperty double x\n"
               f"property double y\nproperty double z\nelement face {len(self.triangles)}\n"
               "property list uchar int vertex_indices\nend_header\n")
        path.unlink()
        path = path.with_suffix(".ply")
        path.write_text(ply + "".join(f"{x:.3g} {y:.3g} 0\n" for x, y in wanted) + faces)
        self.assertRegex(self.judged(path)[1].stdout, r"its numbers tell [5-9][.\d]*e-05 m apart")
        path.write_text(ply + "".join(f"{x!r} {y!r} 0\n" for x, y in wanted.tolist()) + faces)
        self.assertNotIn("its numbers tell", self.judged(path)[1].stdout)
        path.unlink()
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
        no_file = self.folder / "strip-1-linear-0.1.vtu"
        no_file.write_text("<VTKFile", encoding="utf-8")
        said = self.refused((), path, no_file)
        self.assertRegex(said, f"{path}: its faces are not those")
        self.assertRegex(said, f"{no_file}: .*cannot read as .vtu")

    def test_what_cannot_be_judged_is_refused_with_what_to_do(self):
        good = self.kept_positions("strip-1-biot-0.1")
        nan = good.copy()
        nan[3, 1] = numpy.nan
        order = numpy.random.default_rng(1).permutation(len(good))
        out_of_plane = numpy.column_stack([good, numpy.full(len(good), 1e-3)])
        for faults in (
                {"strip-1-biot-0.1": (nan, "holds NaN"),
                 "strip-1-linear-0.1": (good[:-1], f"expected ({len(good)}, 2)"),
                 "strip-1-linear-0.01": (1e3 * good, "expected positions in metres, in the order"),
                 "strip-1-biot-0.01": (self.kept_positions("strip-1-biot-0.01") + [0., 4e-3],
                                       "expected positions in metres, in the order")},
                {"strip-1-biot-0.1": (good[order], "expected positions in metres, in the order"),
                 "strip-1-linear-0.1": (good.astype(int), "astype"),
                 "strip-1-linear-0.01": (out_of_plane, "third column"),
                 "strip-1-biot-0.2": (good, "`strip-1-biot-0.2` is no level or frame of"),
                 "mine": (good, "such as strip-1-linear-0.01")}):
            paths = {name: self.write(f"{name}.npy", some) for name, (some, _) in faults.items()}
            lines = self.refused((), *paths.values()).splitlines()
            self.assertEqual(len(lines), len(faults), lines)
            for name, path in paths.items():
                (line,) = [line for line in lines if str(path) in line]
                self.assertIn(faults[name][1], line)
                path.unlink()
        path = self.write("strip-1-biot-0.1.npy", good)
        for words, *arguments in (
                *((("no method, law or reference", "--seconds: found"), path, "--name", name,
                   "--seconds", seconds) for name, seconds in zip(
                       ("affine", "p2", "quadratic", "base", "biot", "shell", "reference", "woven"),
                       itertools.cycle(("-1", "nan", "inf")))),
                ("--name: found", path, "--name", "my method"),
                ("is not there", self.folder / "nothing.npy")):
            self.refused(words, *arguments)
        self.refused("no run", path, study=self.folder)
        for output in (self.study, self.study.parent):
            result = run("judge", self.study, path, "--output", output, "--overwrite")
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn("holds the run that is judged", result.stderr)
        self.assertTrue((self.study / "run.json").exists())
        # A study without --keep has nothing to judge against, and what was judged is no study.
        without = self.folder / "without"
        shutil.copytree(self.study, without, ignore=shutil.ignore_patterns("positions"))
        self.judged(path)
        self.refused("strain --keep", path, study=without)
        self.refused("judged", path, study=self.folder / "judged-mine")

    def test_of_a_folder_its_files_are_judged_and_nothing_else(self):
        mine = self.folder / "mine"
        mine.mkdir()
        self.refused(f"{mine}: is an empty folder; expected files of positions in it", mine)
        (mine / ".cache").mkdir()
        (mine / ".notes").write_text("hidden")
        self.refused("is an empty folder", mine)
        path = self.write("mine/strip-1-biot-0.1.npy", self.affine())
        self.assertEqual(set(self.judged(mine)[0]), {"strip-1-biot-0.1"})
        (mine / "older").mkdir()
        (mine / "table.csv").write_text("")
        self.refused((f"{mine / 'older'}: is a folder in a folder",
                      f"{mine / 'table.csv'}: is a table in a folder"), mine)
        self.refused("expected one file for each", path,
                     self.write("strip-1-biot-0.1.npy", self.affine()))

    def test_an_error_of_zero_is_a_number(self):
        rows, result = self.judged(
            self.write("strip-1-biot-0.1.npy", self.kept_positions("strip-1-biot-0.1")))
        self.assertEqual(rows["strip-1-biot-0.1"]["error_mean_m"], "0")
        self.assertRegex(result.stdout, r"strip-1, biot, 10 %: 0.* \+- [0-9.e-]+ thousandths")
        self.assertNotIn("nan", result.stdout)

    def test_triangles_of_another_order_are_refused(self):
        good = self.kept_positions("strip-1-biot-0.1")
        order = numpy.random.default_rng(1).permutation(len(good))
        at = numpy.argsort(order)  # of each old vertex its new number
        paths = []
        for strain, positions, triangles in (("0.1", good, self.triangles[:, [1, 0, 2]]),
                                             ("0.01", good[order], at[self.triangles])):
            path = self.folder / f"strip-1-linear-{strain}.obj"
            path.write_text("".join(f"v {x} {y} 0\n" for x, y in positions) +
                            "".join(f"f {a} {b} {c}\n" for a, b, c in triangles + 1))
            paths += [path, self.folder / f"strip-1-biot-{strain}.h5"]
            with h5py.File(paths[-1], "w") as file:
                file["positions"], file["triangles"] = positions, triangles
        self.refused([f"{path.name}: its faces are not those of the kept mesh" for path in paths] +
                     ["write positions at its vertices in their order"], *paths)
        path = self.folder / "strip-1-biot-0.1.h5"
        with h5py.File(path, "w") as file:
            file["positions"], file["triangles"] = good, self.triangles
        self.assertEqual(self.judged(path)[0]["strip-1-biot-0.1"]["error_mean_m"], "0")

    def test_positions_of_another_mesh_than_the_kept_one_are_refused(self):
        other = self.folder / "other"
        path = self.write("strip-1-biot-0.1.npy", self.affine())
        for name, words in (
                ("sheet.h5", "sheet.h5: is not the mesh that this version makes"),
                ("strip-1-biot-0.1.h5", "0.1.h5: is not of the mesh that lies beside it")):
            shutil.copytree(self.study, other)
            with h5py.File(other / "layered" / "positions" / name, "r+") as file:
                if name == "sheet.h5":
                    file["rest"][0] += 1e-6
                else:
                    file.attrs["mesh"] = numpy.bytes_(b"0123456789abcdef")
            self.forget(other, name)
            self.refused(words, path, study=other)
            shutil.rmtree(other)


class JudgeFrames(JudgingFrames):
    def write_frames(self, frames):
        return [self.write(f"biot-{frame:04d}.npy", positions)
                for frame, positions in frames.items()]

    def kept_frame(self, frame, what="reference"):
        return self.kept_positions(f"biot-{frame:04d}", what)

    def test_frames_of_a_method_from_outside_have_the_errors_of_the_study(self):
        sys.path.insert(0, str(PEERS))
        from flat import flat
        with h5py.File(self.kept / "cloth.h5") as file:
            mesh = types.SimpleNamespace(**{name: file[name][...] for name in file})
        self.assertEqual(mesh.start.shape, (len(mesh.rest), 3))
        frames = {frame: flat(mesh)(self.kept_frame(frame, "coarse")) for frame in (0, 1, 2)}
        judged, result = self.judged(*self.write_frames(frames), name="flat")
        # Without an error bar its claims are open, and say so.
        self.assertEqual(result.returncode, 4, result.stderr)
        claims = json.loads((self.folder / "judged-flat" / "verdicts.json").read_text())["verdicts"]
        for claim, other in zip(claims[-2:], ("affine", "localized")):
            self.assertIn(f"biot: flat is closer than {other} (ratio", claim["claim"])
            self.assertEqual(claim["verdict"], "INCONCLUSIVE")
            self.assertIn("open: the reference has no error bar", claim["limit"])
        self.assertAlmostEqual(claims[-2]["value"], 1., delta=1e-9)
        self.assertRegex(result.stdout, "frame 0: .* side, error bar not known;")
        self.assertRegex(result.stdout, "biot, frame 2: .*; 1 of 2 methods of homespun are closer")
        rows = rows_of(self.folder / "judged-flat" / "drape.csv")
        self.assertEqual(rows[:len(self.rows)], self.rows)
        affine = [row for row in self.rows if row["method"] == "affine"]
        own = rows[len(self.rows):]
        self.assertEqual(own, list(judged.values()))
        self.assertEqual(len(own), 3)
        for row, like in zip(own[1:], affine[1:]):
            for key in row:
                if key.startswith("error"):
                    self.assertAlmostEqual(float(row[key]) / float(like[key]), 1., delta=1e-9)
                elif key != "method":
                    self.assertEqual(row[key], like[key])

    def test_a_shift_by_a_millionth_of_a_cell_is_seen(self):
        (own,) = self.judged(*self.write_frames({2: self.kept_frame(2) + [0., 0., 1e-8]}),
                             name="shifted")[0].values()
        self.assertAlmostEqual(float(own["error_mean_m"]), 1e-8, delta=1e-15)
        # The fluctuation is what the coarse motion lacks, the side of the cell a centimetre.
        lacks = next(float(row["error_mean_m"]) for row in self.rows
                     if row["method"] == "affine" and row["frame"] == "2")
        self.assertAlmostEqual(float(own["error_mean_per_fluctuation"]) * lacks, 1e-8, delta=1e-15)
        self.assertAlmostEqual(float(own["error_mean_per_cell"]), 1e-6, delta=1e-13)

    def test_what_cannot_be_judged_is_refused_with_what_to_do(self):
        good = self.kept_frame(2)
        frames = {2: good[:, :2], 1: self.kept_frame(1)[1:], 0: 1e3 * self.kept_frame(0), 9: good}
        lines = self.refused((), *self.write_frames(frames)).splitlines()
        for frame, words in ((2, "expected three components"),
                             (1, f"expected ({len(good)}, 3), a row"),
                             (0, "expected positions in metres"),
                             (9, "`biot-0009` is no level or frame of")):
            self.assertTrue(any(f"biot-{frame:04d}.npy: " in line and words in line
                                for line in lines), lines)
        file, = self.write_frames({2: good})
        for words, *options in (
                ("--seconds: is of a level of `homespun strain`", "--seconds", 1),
                ("no method, law or reference", "--name", "affine")):
            self.refused(words, file, *options)
        without = self.folder / "without"
        shutil.copytree(self.study, without, ignore=shutil.ignore_patterns("positions"))
        self.refused("drape --keep", file, study=without)

    def test_the_beginning_alone_is_judged_without_a_claim(self):
        # There the coarse cloth is the resolved one, and the error is zero.
        rows, result = self.judged(*self.write_frames({0: self.kept_frame(0)}))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(rows["biot-0000"]["error_mean_m"], "0")
        self.assertIn("frame 0: 0 thousandths of a cell side, error bar not known; 0 of",
                      result.stdout)
        self.assertNotIn("claims hold", result.stdout)
        self.assertNotIn("nan", result.stdout + result.stderr)


class JudgeFramesWithBars(JudgingFrames):
    @classmethod
    def setUpClass(cls):
        cls.make("drape", CELLS.parent / "scenes" / "pull.prm", "--unit-cells", LAYERED, "--cells",
                 "2", "--duration", "0.05", "--references", "biot", "--no-frames")

    def test_the_bar_has_what_the_step_changes_in_both_cloths_and_without_it_claims_are_open(self):
        name = "biot-0001"
        file = self.write(f"{name}.npy", self.kept_positions(name, "reference"))
        with h5py.File(self.kept / f"{name}.h5") as kept:
            shared = float(kept.attrs["coarse_time_step_uncertainty_m"][0])
        self.assertGreater(shared, 0.)
        known = self.rows[-1]
        self.assertEqual((known["method"], known["frame"]), ("localized", "1"))
        rows, result = self.judged(file)
        self.assertEqual(rows[name]["reference_uncertainty_m"], known["reference_uncertainty_m"])
        own = float(rows[name]["time_step_uncertainty_m"])
        self.assertAlmostEqual(own / (float(known["time_step_uncertainty_m"]) + shared), 1.,
                               delta=1e-12)
        self.assertIn("2 of 2 claims hold", result.stdout)

        without = self.folder / "without"
        shutil.copytree(self.study, without)
        with h5py.File(without / "layered" / "positions" / f"{name}.h5", "r+") as kept:
            del kept.attrs["coarse_time_step_uncertainty_m"]
        self.forget(without, f"{name}.h5")
        result = self.judge(file, study=without)
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertIn("open: of some frame an error bar is not known", result.stdout)


if __name__ == "__main__":
    unittest.main()
