# SPDX-License-Identifier: MIT
"""Cells from Python: addresses, what objects say, refusals, and what importing does."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy

import homespun
from with_cell import WithCell, address, run_in_threads


class WithPath(os.PathLike):
    """What is no pathlib.Path and has a path."""

    def __init__(self, path):
        self.path = path

    def __fspath__(self):
        return self.path


class Cells(WithCell):
    def test_arrays_are_views_of_the_cell(self):
        for name, columns in [("vertices", 2), ("triangles", 3), ("chi", 6), ("material", None)]:
            array = getattr(self.cell, name)
            self.assertEqual(address(array), address(getattr(self.cell, name)), name)
            self.assertFalse(array.flags.writeable, name)
            if columns:
                self.assertEqual(array.shape[1], columns)

    def test_a_view_keeps_its_cell_alive(self):
        vertices = homespun.Cell.read(self.file).vertices
        numpy.testing.assert_array_equal(vertices, self.cell.vertices)

    def test_numbers_are_those_of_the_file(self):
        import h5py
        with h5py.File(self.file) as file:
            numpy.testing.assert_array_equal(file["C"][:], self.cell.stiffness)
            # The file has (vertex, component, load), the cell a row of three loads per vertex.
            chi = file["chi"][:].transpose(0, 2, 1).reshape(-1, 6)
            numpy.testing.assert_array_equal(chi, self.cell.chi)
        # Two stripes of equal width, 500 and 5000 N/m over 1 − nu²: C11 is their harmonic mean.
        D = numpy.array([500., 5000.]) / (1 - 0.3**2)
        self.assertAlmostEqual(self.cell.stiffness[0, 0] / (2 / (1 / D).sum()), 1., 14)
        self.assertIsNone(self.cell.bending_stiffness)

    def test_what_is_written_is_read(self):
        name = os.path.join(self.folder, "copy.h5")
        for path in (name, pathlib.Path(name), WithPath(name)):
            self.cell.write(path)
            again = homespun.Cell.read(path)
            os.remove(name)
            numpy.testing.assert_array_equal(again.chi, self.cell.chi)
            numpy.testing.assert_array_equal(again.stiffness, self.cell.stiffness)

    def test_files_may_be_read_and_written_in_many_threads(self):
        # HDF5 takes one thread at a time.
        run_in_threads("cell = homespun.Cell.read(sys.argv[1])\n"
                       "def work():\n"
                       "    file = f'{sys.argv[1]}-{threading.get_ident()}'\n"
                       "    for _ in range(200):\n"
                       "        cell.write(file)\n"
                       "        assert (homespun.Cell.read(file).chi == cell.chi).all()", self.file)

    def test_refusals_have_the_text_of_the_program(self):
        self.refused(lambda: homespun.Cell.read("nowhere.h5"), "nowhere.h5")
        self.refused(lambda: homespun.Cell.read(__file__), "test_light.py",
                     kind=homespun.BadInput)
        self.refused(lambda: homespun.Sheet(self.cell, 0, 1), "n1: found 0; expected at least 1")
        self.refused(lambda: homespun.Sheet(self.cell, 1, -2), "n2: found -2; expected at least 1")
        each = len(self.cell.triangles)
        self.refused(lambda: homespun.Sheet(self.cell, 60000, 60000),
                     f"3600000000 of {each} triangles would be a fine mesh of {3600000000 * each}",
                     "at most max_triangles = 10000000")
        self.refused(lambda: homespun.Sheet(self.cell, 2**40, 2), "cells: 2199023255552 of")
        self.refused(lambda: homespun.Sheet(self.cell, 2**62, 2**62), "cells: 2.12676479325587e+37 of")
        self.refused(lambda: homespun.Sheet(self.cell, -2**40, 2), "n1: found -1099511627776; exp")
        for most in (0, -1, 2**31, 2**62):
            self.refused(lambda: homespun.Sheet(self.cell, 60000, 60000, max_triangles=most),
                         f"max_triangles: found {most}; expected 1 to 715827882")
        homespun.Sheet(self.cell, 2, 3, max_triangles=6 * each)
        self.refused(lambda: homespun.Sheet(self.cell, 2, 3, max_triangles=6 * each - 1), "raise max")


class Saying(WithCell):
    """What an interpreter shows."""

    def test_the_version_is_that_of_the_project(self):
        lists = pathlib.Path(__file__).resolve().parents[2] / "CMakeLists.txt"
        project = re.search(r"project\(homespun VERSION (\S+)", lists.read_text(encoding="utf-8"))
        self.assertEqual(homespun.__version__, project[1])

    def test_objects_say_what_they_are(self):
        sheet = homespun.Sheet(self.cell, 2, 3)
        cloth = homespun.Cloth(self.cell, sheet.coarse_vertices, sheet.coarse_triangles)
        cloth.step(0.5)
        C, density = self.cell.stiffness, self.cell.areal_density
        cell = repr(self.cell)
        self.assertRegex(cell, "^<homespun.Cell 10 x 10 mm: [0-9]+ triangles, 2 phases, C11 .* N/m, "
                               ".* kg/m.2>$")
        for name, value in (("C11", C[0, 0]), ("C22", C[1, 1]), ("C12", C[0, 1]), ("C66", C[2, 2])):
            self.assertAlmostEqual(float(re.search(name + " ([^, ]+)", cell)[1]) / value, 1., 2)
        self.assertIn(f", {density:.3g} kg/m^2", cell)
        self.assertNotIn("D11", cell)
        self.assertEqual(repr(sheet), "<homespun.Sheet of 2 x 3 cells: 12 coarse triangles, "
                                      f"{len(sheet.triangles)} fine>")
        self.assertRegex(repr(cloth), "^<homespun.Cloth of 12 vertices, .* kg, at 0.5 s: kinetic "
                                      "energy [^ ]+ J, stored [^ ]+ J>$")
        upsampler = homespun.Upsampler(self.cell, sheet)
        self.assertIn("of 12 coarse vertices to %d fine" % len(sheet.vertices), repr(upsampler))

    def test_classes_are_of_the_package_and_explain_themselves(self):
        for name in set(homespun.__all__) - {"__version__", "plot"}:
            thing = getattr(homespun, name)
            self.assertTrue(thing.__doc__, name)
            self.assertEqual(thing.__module__.split(".")[0], "homespun", name)
            self.assertNotIn("_light", thing.__module__, name)
            for member, value in vars(thing).items() if isinstance(thing, type) else ():
                if not member.startswith("_"):
                    self.assertTrue((value.__doc__ or "").strip(), f"{name}.{member}")


class Importing(WithCell):
    def run_python(self, code):
        return subprocess.run([sys.executable, "-B", "-c", code], check=True, text=True,
                              stdout=subprocess.PIPE, env=dict(os.environ)).stdout

    def test_beside_h5py_in_both_orders(self):
        path = str(self.file)
        for modules in ("h5py, homespun", "homespun, h5py"):
            out = self.run_python(
                f"import {modules}\ncell = homespun.Cell.read({path!r})\n"
                f"with h5py.File({path!r}) as file:\n"
                "    print((file['C'][:] == cell.stiffness).all())\n")
            self.assertEqual(out.split(), ["True"], modules)

    def test_starts_no_mpi_and_loads_no_finite_elements(self):
        out = self.run_python("import homespun, ctypes, sys\n"
                              "libraries = open('/proc/self/maps').read()\n"
                              "print('libdeal' in libraries, 'Trilinos' in libraries)\n"
                              "if 'libmpi.so' in libraries:\n"
                              "    flag = ctypes.c_int(0)\n"
                              "    ctypes.CDLL('libmpi.so.40').MPI_Initialized(ctypes.byref(flag))\n"
                              "    print(bool(flag.value))\n")
        self.assertNotIn("True", out)


class Results(WithCell):
    def test_tables_of_a_folder(self):
        with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
            self.assertRaises(ValueError, homespun.results, folder)
            pathlib.Path(folder, "strain.csv").write_text(
                "load,strain,error_mean_m\nstrip-1,0.01,1.2345678901234567e-05\nstrip-2,0.1,\n",
                encoding="utf-8")
            table = homespun.results(folder)["strain"]
            self.assertEqual(list(table["load"]), ["strip-1", "strip-2"])
            self.assertEqual(table["error_mean_m"][0], 1.2345678901234567e-05)
            self.assertTrue(numpy.isnan(table["error_mean_m"][1]))
            self.assertEqual(table[table["load"] == "strip-2"]["strain"], [0.1])
            pathlib.Path(folder, "upsample.csv").write_text(
                "frame,frame_crc32,strain\n0001,12345678,0.1\n", encoding="utf-8")
            table = homespun.results(folder)["upsample"]
            self.assertEqual((table["frame"][0], table["frame_crc32"][0]), ("0001", "12345678"))

    def test_tables_of_a_newer_format_are_refused_and_older_ones_read(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "strain.csv").write_text("load,strain\na,1\n", encoding="utf-8")
            run = pathlib.Path(folder, "run.json")
            for text in ('{"format": 1}', '{"format_version": 1}'):
                run.write_text(text, encoding="utf-8")
                self.assertEqual(homespun.results(folder)["strain"]["strain"], [1.])
            for text, words in (
                    ('{"format_version": 2}', "run.json: found format_version 2; expected at most"),
                    ('{"format_version": "x"}', 'found format_version "x"; expected a whole'),
                    ('{"format_version"', "run.json: is damaged")):
                run.write_text(text, encoding="utf-8")
                self.refused(lambda: homespun.results(folder), words)
            import h5py
            newer = os.path.join(folder, "newer.h5")
            self.cell.write(newer)
            with h5py.File(newer, "a") as file:
                self.assertEqual(file.attrs["format_version"], 1)
                file.attrs["format_version"] = 2
            self.refused(lambda: homespun.Cell.read(newer),
                         "newer.h5: found format_version 2; expected at most 1")


if __name__ == "__main__":
    unittest.main()
