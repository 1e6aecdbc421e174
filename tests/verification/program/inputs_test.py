# SPDX-License-Identifier: MIT
"""What people type and save: files of another kind, other ways to write numbers and lists, each
understood or refused in words that say what to do.
"""
import json
import pathlib
import re
import shutil
import sys
import unittest

import h5py
import numpy

from broken_cells_test import Cell, N, vertex
from cli import CELLS, LAYERED, WEAVE, InFolder, run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "verification" / "report"))
from read.vtu import read_vtu  # noqa: E402

SCENES = CELLS.parent / "scenes"
QUICK = ["--cells", "1", "--references", "linear", "--no-budget", "--no-runtime", "--no-report",
         "--quiet"]


def words_of(path, name):
    """The words of a string array of field data, which VTK stores as codes with a zero behind each.
    """
    text = path.read_bytes().split(f'Name="{name}"'.encode(), 1)[1]
    codes = bytes(int(code) for code in text.split(b">", 1)[1].split(b"<", 1)[0].split())
    return codes.decode().split("\0")[:-1]


class OtherFiles(InFolder):
    def refused_in_one_line(self, command, path, *words):
        result = run(command, path)
        self.assertEqual(result.returncode, 2)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr[:2000])
        self.assertTrue(lines[0].isprintable(), lines[0])
        for word in words:
            self.assertIn(word, lines[0])

    def test_a_mesh_in_the_place_of_a_cell_is_one_line(self):
        self.refused_in_one_line("check", CELLS / "layered.msh", "is a Gmsh mesh",
                                 "expected a file of lines `set KEY = VALUE`")

    def test_an_hdf5_file_in_the_place_of_a_cell_is_one_line(self):
        path = self.folder / "cell.h5"
        path.write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(range(256)) * 20)
        self.refused_in_one_line("homogenize", path, "is an HDF5 file")

    def test_what_is_no_text_is_one_line(self):
        path = self.folder / "cell.prm"
        path.write_bytes(bytes(range(256)) * 20)
        self.refused_in_one_line("check", path, "is no text")
        path.write_text("set Mesh = a.msh\n", encoding="utf-16")
        self.refused_in_one_line("check", path, "UTF-16")

    def test_a_mesh_of_gmsh_1_and_a_drawing_are_one_line(self):
        path = self.folder / "old.msh"
        path.write_text("$NOD\n60\n" + "1 0 0 0\n" * 60 + "$ENDNOD\n")
        self.refused_in_one_line("check", path, "is a Gmsh mesh")
        self.refused_in_one_line("check", CELLS / "layered.geo", "is a drawing of Gmsh (.geo)",
                                 "expected a file of lines `set KEY = VALUE`")

    def test_a_scene_given_to_homogenize_and_a_cell_given_to_drape_are_called_so(self):
        self.refused_in_one_line("homogenize", SCENES / "hang.prm", "is a scene",
                                 "homespun drape")
        self.refused_in_one_line("drape", LAYERED, "is a cell", "--unit-cells")


class WaysToWrite(InFolder):
    def setUp(self):
        super().setUp()
        self.cell = Cell()

    def check(self, change=lambda text: text):
        path = self.cell.write(self.folder)
        path.write_bytes(change(path.read_bytes()))
        return run("check", path)

    def refused(self, *words, **keys):
        self.cell.keys.update(keys)
        result = self.check()
        self.assertEqual(result.returncode, 2, result.stdout)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_a_byte_order_mark_is_understood(self):
        result = self.check(lambda text: b"\xef\xbb\xbf" + text)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_decimal_comma_is_refused_in_these_words(self):
        self.refused("numbers have a decimal point: `0.01`", **{"Length unit": "0,01"})
        self.cell = Cell()
        self.refused("found `soft: 0,3`; expected a decimal point, not a comma",
                     **{"Poisson's ratio": "soft: 0,3, hard: 0.3"})

    def test_a_percentage_is_refused_in_these_words(self):
        self.refused("a percentage is written as a fraction: `0.3`",
                     **{"Poisson's ratio": "soft: 30%, hard: 0.3"})

    def test_a_length_unit_that_is_left_out_is_refused(self):
        del self.cell.keys["Length unit"]
        self.refused("key `Length unit` is missing; expected metres per mesh unit")

    def test_an_unknown_group_or_key_asks_whether_another_was_meant(self):
        self.refused("names the group `hrad`", "did you mean `hard`?",
                     Thickness="soft: 5e-4, hrad: 5e-4")
        self.cell = Cell()
        del self.cell.keys["Thickness"]
        self.refused("unknown key `Thicknes`", "did you mean `Thickness`?",
                     Thicknes="soft: 5e-4, hard: 5e-4")

    def test_a_group_like_no_other_is_not_guessed(self):
        self.cell.keys["Thickness"] = "soft: 5e-4, hard: 5e-4, embroidery: 1"
        result = self.check()
        self.assertIn("names the group `embroidery`", result.stderr)
        self.assertNotIn("did you mean", result.stderr)

    def test_a_value_without_a_name_is_that_of_all_other_groups(self):
        self.cell.keys.update({"Poisson's ratio": "0.3", "Thickness": "5e-4, hard: 4e-4",
                               "Density": "400"})
        result = self.check()
        self.assertEqual(result.returncode, 0, result.stderr)
        path = self.cell.write(self.folder)
        run("homogenize", path, "--no-bars", "--quiet", "--output", self.folder / "out")
        phases = json.loads((self.folder / "out/cell.json").read_text())["phases"]
        self.assertEqual({phase["name"]: phase["thickness"] for phase in phases},
                         {"soft": 5e-4, "hard": 4e-4})
        # Behind others it is a decimal comma.
        self.refused("found `soft: 0,3`; expected a decimal point, not a comma",
                     **{"Poisson's ratio": "soft: 0,3, hard: 0.3"})
        # Axes by default and moduli by name, or the other way round, are both fine.
        del self.cell.keys["Young's modulus"]
        self.cell.keys.update({"Young's modulus": "soft: 1e6", "Poisson's ratio": "soft: 0.3",
                               "Orthotropic": "1e7 1e6 0.3 4e5 45"})
        self.assertEqual(self.check().returncode, 0)
        self.cell.keys.update({"Young's modulus": "1e6", "Poisson's ratio": "0.3",
                               "Orthotropic": "hard: 1e7 1e6 0.3 4e5 45"})
        self.assertEqual(self.check().returncode, 0)
        self.refused("is given both in `Orthotropic` and in", Orthotropic="1e7 1e6 0.3 4e5 45")

    def test_a_mesh_without_physical_groups_is_called_that(self):
        self.cell.groups = [0] * len(self.cell.groups)
        path = self.cell.write(self.folder)
        mesh = self.folder / "cell.msh"
        text = re.sub(r"\$PhysicalNames.*\$EndPhysicalNames\n", "", mesh.read_text(), flags=re.S)
        mesh.write_text(text)
        result = run("check", path)
        self.assertEqual(result.returncode, 2)
        self.assertIn("has no physical groups", result.stderr)
        self.assertIn("Physical Surface", result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)

    def test_an_absolute_path_within_the_folder_is_taken_and_one_outside_is_not(self):
        self.cell.keys["Mesh"] = str(self.folder / "cell.msh")
        self.assertEqual(self.check().returncode, 0)
        self.cell.keys["Mesh"] = str(CELLS / "layered.msh")
        self.assertIn("lies outside of the folder", self.check().stderr)

    def test_a_message_on_nu12_does_not_contradict_its_range(self):
        for key in ("Young's modulus", "Poisson's ratio"):
            del self.cell.keys[key]
        self.refused("strictly between -0.1 and 0.1", "was nu21 given?",
                     Orthotropic="soft: 1e5 1e7 0.3 1e5 0, hard: 1e7 1e7 0.3 4e6 0")
        self.assertNotIn("0.5 is fine", self.check().stderr)

    def test_a_phase_that_does_not_continue_across_the_sides_is_a_warning_with_its_place(self):
        sound = self.check()
        self.assertNotIn("does not continue", sound.stdout)
        # One square at the left side of the soft half is hard; that at the right side is not.
        for triangle in range(len(self.cell.triangles)):
            if self.cell.square_of(triangle) == (0, 1):
                self.cell.groups[triangle] = 2
        result = self.check()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("a phase does not continue across the sides", result.stdout)
        self.assertIn(f"vertex {vertex(0, 1)} at (0, {1 / N:g})", result.stdout)
        self.assertIn(f"vertex {vertex(N, 1)}", result.stdout)


class CutHoles(InFolder):
    """Holes that the outline of the cell cuts."""

    def cell_without(self, is_void):
        cell = Cell()
        cell.keep(lambda i, j: not is_void(i, j))
        return cell

    def homogenized(self, cell, name):
        folder = self.folder / name
        folder.mkdir()
        result = run("homogenize", cell.write(folder), "--order", "1", "--output", folder / "out")
        self.assertIn(result.returncode, (0, 4), result.stderr)
        return json.loads((folder / "out/homogenize.json").read_text()), result.stdout

    def test_the_cell_is_cut_at_another_place_and_every_result_says_so(self):
        ends = (0, N - 1)
        cut = self.cell_without(lambda i, j: i in ends and j in ends)
        sentence = "the outline of the mesh cuts holes: the cell is cut from the cloth"
        found, printed = self.homogenized(cut, "cut")
        self.assertIn(sentence, printed)
        self.assertIn(sentence, found["shift"]["remark"])
        for part, metres in zip(found["shift"]["parts"], found["shift"]["metres"]):
            self.assertAlmostEqual(0.01 * part, metres, delta=1e-15)
            self.assertIn(round(N * part, 9), range(1, N), "a line of the mesh between the holes")
        with h5py.File(self.folder / "cut/out/cell.h5") as file:
            self.assertIn(sentence, file.attrs["place_of_cut"].decode())
            corner = file["vertices"][...].min(axis=0)
        numpy.testing.assert_allclose(corner, found["shift"]["metres"], atol=1e-15)
        result = run("check", self.folder / "cut/cell.prm")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(sentence, result.stdout)
        result = run("strain", self.folder / "cut/cell.prm", "--loads", "strip-1", "--strains",
                     "0.01", *QUICK, "--output", self.folder / "strain")
        self.assertNotEqual(result.returncode, 2, result.stderr)
        notes = json.loads((self.folder / "strain/study.json").read_text())["notes"]
        self.assertTrue(any(note.startswith(f"cell: {sentence}") for note in notes), notes)
        # Drawn with the hole inside it is the same cloth.
        half = N // 2
        drawn = self.cell_without(lambda i, j: {i, j} <= {half - 1, half})
        drawn.groups = [3 - group for group in drawn.groups]
        other, printed = self.homogenized(drawn, "drawn")
        self.assertNotIn("cuts holes", printed)
        self.assertIsNone(other["shift"])
        numpy.testing.assert_allclose(found["C"], other["C"], rtol=0, atol=1e-9 * other["C"][0][0])

    def test_a_hole_that_every_line_meets_is_named_first(self):
        cell = self.cell_without(lambda i, j: j in (2, 3) and i != 4 or
                                 j in (5, 6) and i in (3, 4, 5))
        cell.keys["Lattice vectors"] = "1 0; 0 1"
        file = cell.write(self.folder)
        result = run("check", file)
        self.assertEqual(result.returncode, 0, result.stderr)
        said = result.stdout + result.stderr
        self.assertIn("the outline cuts holes", said)
        self.assertIn("every straight line along a2 meets a hole: ", said)
        # C^H is that of the torus, a sheet is refused with the reason.
        found, _ = self.homogenized(cell, "net")
        self.assertGreater(found["C"][2][2], 0)
        result = run("strain", file, "--quick", "--output", self.folder / "strain")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn("sheets and garments cannot be cut from this cloth", result.stderr)


class Options(InFolder):
    def test_what_is_misspelt_or_in_another_order_is_one_line_with_what_was_meant(self):
        cell = LAYERED
        for words, says in (
                (("homogenise", cell), "found `homogenise`; expected a command first; did you mean "
                                       "`homogenize`?"),
                (("homogenize", cell, "--tol", "1e-3"), "found `--tol`; expected an option of "
                 "`homespun homogenize`; did you mean `--tolerance`?"),
                (("strain", "--lods=strip-1", cell), "did you mean `--loads`?"),
                ((cell, "check"), f"found `{cell}`; expected a command first, as in "
                                  f"`homespun check {cell}`"),
                (("cells", "make", "twill", "--sets", "a=1"), "did you mean `--set`?"),
                (("homogenize",), "homespun homogenize: CELL.prm is required"),
                (("homogenize", cell, "--order", "3"), "--order: "),
                ((), "found nothing; expected a command")):
            with self.subTest(words=words):
                result = run(*words)
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stdout, "")
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertTrue(result.stderr.startswith("homespun: "), result.stderr)
                self.assertIn(says, result.stderr)

    def test_lists_that_blanks_part_are_understood(self):
        for words in (["--loads", "strip-1,", "strip-2"], ["--loads", "strip-1", ",strip-2"],
                      ["--loads=strip-1,", "strip-2"]):
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            result = run("strain", LAYERED, *words, "--strains", "0.01", *QUICK,
                         "--output", self.folder / "out")
            self.assertNotEqual(result.returncode, 2, result.stderr)
            self.assertEqual(json.loads((self.folder / "out/study.json").read_text())["loads"],
                             ["strip-1", "strip-2"])

    def test_strains_that_files_of_positions_would_have_one_name_for_are_refused(self):
        strains = ("strain", LAYERED, "--strains", "0.01,0.01000001,0.1", "--loads", "pull")
        result = run(*strains, "--keep")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn("--strains: found 0.01 and 0.01000001, which are both 0.01 in the names of "
                      "files that --keep leaves", result.stderr)
        self.assertNotIn("--keep", run(*strains).stderr)

    def test_percentages_are_strains_and_a_large_number_asks_whether_percent_was_meant(self):
        result = run("strain", LAYERED, "--loads", "periodic-11", "--strains",
                     "1%,60%", *QUICK, "--output", self.folder)
        self.assertNotEqual(result.returncode, 2, result.stderr)
        self.assertEqual(json.loads((self.folder / "study.json").read_text())["strains"],
                         [0.01, 0.6])
        for strain, words in (("0.5", "if percent was meant, write 0.5%, and else 50%"),
                              ("1", "which is 100 %; if percent was meant, write 1%"),
                              ("0,01", "decimal point")):
            result = run("strain", LAYERED, "--strains", strain)
            self.assertEqual(result.returncode, 2)
            self.assertIn(words, result.stderr)

    def test_quiet_is_silent(self):
        for words in (["homogenize", LAYERED],
                      ["verify", LAYERED, "--parts", "homogenize", "--no-report"]):
            result = run(*words, "--quiet", "--output", self.folder / words[0])
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))


class Frames(InFolder):
    def test_materials_of_a_cell_file_are_its_groups_with_names_and_axes(self):
        result = run("homogenize", WEAVE, "--no-bars", "--output", self.folder)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        path = self.folder / "characteristic-displacements.vtu"
        surface, names = read_vtu(path), words_of(path, "material names")
        numbers = set(surface.cell_data["material"].astype(int).reshape(-1))
        groups = {p["name"] for p in json.loads((self.folder / "cell.json").read_text())["phases"]}
        self.assertEqual(set(names), groups)
        self.assertEqual(numbers, set(range(len(groups))))
        first, second = (surface.cell_data[f"material axis {k}"] for k in (1, 2))
        self.assertLess(abs((first * second).sum(axis=1)).max(), 1e-6)
        self.assertLess(abs((first**2).sum(axis=1) - 1).max(), 1e-6)
        self.assertLess(abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0] - 1).max(),
                        1e-6)

    def test_frames_hold_materials_of_triangles_and_warn_of_pins_at_points(self):
        result = run("drape", SCENES / "hang-corner.prm", "--quick", "--unit-cells",
                     LAYERED, "--no-report", "--duration", "0.02", "--output",
                     self.folder)
        self.assertNotEqual(result.returncode, 2, result.stderr)
        self.assertIn("held at single points (`top left`)", result.stderr)
        study = json.loads((self.folder / "drape.json").read_text())
        self.assertTrue(any("logarithm of the mesh width" in note for note in study["notes"]))
        frame = sorted((self.folder / "layered-biot").glob("fine_*.vtu"))[-1]
        surface = read_vtu(frame)
        self.assertNotIn("material", surface.point_data)
        material = surface.cell_data["material"].astype(int).reshape(-1)
        # Two halves: as many triangles of one as of the other, in two numbers alone.
        self.assertEqual(sorted(set(material)), [0, 1])
        self.assertEqual((material == 0).sum(), (material == 1).sum())


if __name__ == "__main__":
    unittest.main()
