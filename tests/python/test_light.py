# SPDX-License-Identifier: MIT
"""Cells, cloths and up-sampling from Python: addresses, refusals, and what a step costs."""
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import threading
import time
import tracemalloc
import unittest

import numpy

import homespun

SIDE = 0.01


def address(array):
    return array.__array_interface__["data"][0]


def made_cell(folder):
    """Two stripes across axis 1, the laminate in closed form."""
    path = os.path.join(folder, "cell.h5")
    subprocess.run([os.environ["HOMESPUN_MAKE_CELL"], path], check=True)
    return path


class WithPath(os.PathLike):
    """What is no pathlib.Path and has a path."""

    def __init__(self, path):
        self.path = path

    def __fspath__(self):
        return self.path


class WithCell(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="homespun-python-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        cls.file = made_cell(folder.name)
        cls.cell = homespun.Cell.read(cls.file)

    def refused(self, call, *texts, kind=ValueError):
        with self.assertRaises(kind) as caught:
            call()
        for text in texts:
            self.assertIn(text, str(caught.exception))


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


class Upsampling(WithCell):
    n = 6

    def setUp(self):
        self.sheet = homespun.Sheet(self.cell, self.n, self.n)
        self.upsampler = homespun.Upsampler(self.cell, self.sheet)
        self.positions = numpy.zeros((self.upsampler.n_coarse, 3))
        self.positions[:, :2] = self.sheet.coarse_vertices

    def stretched(self, strain):
        moved = self.positions.copy()
        moved[:, 0] *= 1 + strain
        return moved

    def test_at_rest_the_fine_mesh_is_at_rest(self):
        fine = self.upsampler.upsample(self.positions)
        self.assertEqual((fine.dtype, fine.shape), (numpy.float32, (self.upsampler.n_fine, 3)))
        # Positions are single.
        numpy.testing.assert_allclose(fine[:, :2], self.sheet.vertices,
                                      atol=2 * numpy.finfo("f4").eps * self.n * SIDE)

    def test_stretch_adds_chi(self):
        strain = 0.01
        fine = self.upsampler.upsample(self.stretched(strain))
        affine = homespun.Upsampler(self.cell, self.sheet, method="affine").upsample(
            self.stretched(strain))
        fluctuation = (fine - affine)[:, 0]
        # w = −E11 chi_11, chi a tent of the soft stripe's slope, 1 − C11/D11, over half a cell.
        D = 500 / (1 - 0.3**2)
        height = strain * abs(1 - self.cell.stiffness[0, 0] / D) * SIDE / 2
        self.assertAlmostEqual(abs(fluctuation).max() / height, 1., 3)

    def test_out_is_written_where_it_lies(self):
        out = numpy.empty((self.upsampler.n_fine, 3), dtype=numpy.float32)
        place = address(out)
        given = self.upsampler.upsample(self.stretched(0.02), out=out)
        self.assertIs(given, out)
        self.assertEqual(address(given), place)
        numpy.testing.assert_array_equal(out, self.upsampler.upsample(self.stretched(0.02)))

    def test_upsampling_into_an_array_takes_no_memory(self):
        sheet = homespun.Sheet(self.cell, 60, 60)
        upsampler = homespun.Upsampler(self.cell, sheet)
        positions = numpy.zeros((upsampler.n_coarse, 3))
        positions[:, :2] = sheet.coarse_vertices
        out = numpy.zeros((upsampler.n_fine, 3), dtype=numpy.float32)
        upsampler.upsample(positions, out=out)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(50):
            upsampler.upsample(positions, out=out)
        # A copy of either array would be more than a megabyte each time.
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 512)

    def test_positions_that_fit_are_read_where_they_lie(self):
        out = numpy.empty((self.upsampler.n_fine, 3), dtype=numpy.float32)
        # NumPy reports its buffers to tracemalloc.
        for positions, copies in ((self.positions, 0), (self.positions.astype("f4"), 1)):
            tracemalloc.start()
            self.upsampler.upsample(positions, out=out)
            taken = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            self.assertEqual(taken >= self.positions.nbytes, bool(copies))
            self.assertLess(taken, copies * self.positions.nbytes + 1000)

    def test_whatever_numpy_takes_for_numbers_is_taken(self):
        good = self.stretched(0.02)
        whole = numpy.round(good / SIDE)
        upsample = self.upsampler.upsample
        for given, same in (
                (good.tolist(), good), (tuple(map(tuple, good)), good),
                (numpy.asfortranarray(good), good), (good[::-1].copy()[::-1], good),
                (numpy.repeat(good, 2, axis=0)[::2], good), (good.astype(">f8"), good),
                (good.astype("f4"), good.astype("f4").astype("f8")), (whole.astype("i8"), whole)):
            numpy.testing.assert_array_equal(upsample(given), upsample(same))

    def test_refusals_name_argument_dtype_and_shape(self):
        good = self.positions
        out = numpy.zeros((self.upsampler.n_fine, 3), dtype=numpy.float32)
        upsample = self.upsampler.upsample
        self.refused(lambda: upsample(good[:, :1].copy()), "positions", "(n, 3)", f"({len(good)}, 1)")
        self.refused(lambda: upsample(good[:-1]), f"have {len(good) - 1} rows; expected {len(good)}")
        self.refused(lambda: upsample(good.astype(str)), "positions: found a ndarray of <U",
                     "expected numbers of the shape (n, 3)")
        self.refused(lambda: upsample(good * 1j), "positions", "complex128")
        self.refused(lambda: upsample([[0, 0], [0]]), "positions: found a list", "(n, 3)")
        self.refused(lambda: upsample(None), "positions: found a NoneType", "(n, 3)")
        # What is written into is never converted.
        self.refused(lambda: upsample(good, out=out.astype("f8")), "out", "float64", "float32")
        self.refused(lambda: upsample(good, out=numpy.asfortranarray(out)), "out", "contiguous")
        self.refused(lambda: upsample(good, out=out.tolist()), "out: found a list", "(n, 3)")
        self.refused(lambda: upsample(good, out=out[:-1]), f"expected {len(out)}")
        out.flags.writeable = False
        self.refused(lambda: upsample(good, out=out), "out: is read-only")
        bad = good.copy()
        bad[3, 1] = numpy.nan
        self.refused(lambda: upsample(bad), "positions: found nan at [3, 1]; expected finite")
        bad[3, 1] = -numpy.inf
        self.refused(lambda: upsample(bad.astype("f4")), "positions: found -inf at [3, 1]")

    def test_others_run_meanwhile(self):
        # With the interpreter held, the counter of another thread would stand still.
        sheet = homespun.Sheet(self.cell, 150, 150)
        count, stop = [0], threading.Event()

        def counting():
            while not stop.is_set():
                count[0] += 1
                time.sleep(0)

        thread = threading.Thread(target=counting)
        thread.start()
        try:
            before = count[0]
            homespun.Upsampler(self.cell, sheet)
            self.assertGreater(count[0] - before, 3)
        finally:
            stop.set()
            thread.join()


class Cloths(WithCell):
    def hanging(self, **choices):
        sheet = homespun.Sheet(self.cell, 5, 5)
        top = numpy.flatnonzero(sheet.coarse_vertices[:, 1] > 5 * SIDE - 1e-9)
        return homespun.Cloth(self.cell, sheet.coarse_vertices, sheet.coarse_triangles,
                              held=top.tolist(), **choices), top

    def test_a_free_cloth_falls_as_everything_does(self):
        sheet = homespun.Sheet(self.cell, 4, 4)
        cloth = homespun.Cloth(self.cell, sheet.coarse_vertices, sheet.coarse_triangles)
        h, steps = 0.01, 10
        for _ in range(steps):
            cloth.step(h)
        # Implicit Euler: z = −g h² n (n + 1) / 2.
        numpy.testing.assert_allclose(cloth.positions[:, 2],
                                      -9.81 * h * h * steps * (steps + 1) / 2, rtol=1e-9)
        self.assertAlmostEqual(cloth.time, 0.1)

    def test_positions_are_a_view_that_moves_with_the_cloth(self):
        cloth, top = self.hanging()
        positions = cloth.positions
        before = positions.copy()
        cloth.step(0.01)
        self.assertEqual(address(positions), address(cloth.positions))
        self.assertLess(positions[:, 2].min(), before[:, 2].min())
        numpy.testing.assert_array_equal(positions[top], before[top])
        self.assertFalse(positions.flags.writeable)

    def test_held_vertices_go_where_they_are_told(self):
        cloth, top = self.hanging(gravity=[0., 0., 0.])
        target = cloth.positions[top[0]] + [0., 0.001, 0.]
        cloth.prescribe(int(top[0]), target.tolist())
        cloth.step(0.01)
        numpy.testing.assert_array_equal(cloth.positions[top[0]], target)
        self.assertGreater(cloth.stored_energy, 0.)

    def test_refusals(self):
        sheet = homespun.Sheet(self.cell, 2, 2)
        rest, triangles = sheet.coarse_vertices, sheet.coarse_triangles
        make = lambda **more: homespun.Cloth(self.cell, rest, triangles, **more)
        self.refused(lambda: make(held=[99]), "99")
        self.refused(lambda: make(bending=True), "no D^H")
        self.refused(lambda: make(integrator="leapfrog"), "leapfrog", "linearly implicit")
        self.refused(lambda: make(positions=numpy.zeros((3, 3))), "positions", "found 3 rows")
        self.refused(lambda: make().step(0.), "0")
        for name, bad, texts in (
                ("held", [0.5], "held: found 0.5 at [0]; expected indices, whole numbers from 0"),
                ("held", numpy.array([0, -1]), "held: found -1"),
                ("held", [True, False], "held: found a list of bool"),
                ("gravity", [0., 1.], "gravity: found the shape (2,); expected (3,)"),
                ("gravity", [0., 0., numpy.nan], "gravity: found nan at [2]"),
                ("positions", numpy.full((9, 3), numpy.nan), "positions: found nan at [0, 0]")):
            self.refused(lambda: make(**{name: bad}), texts)
        cloth = make(held=[0])
        self.refused(lambda: cloth.prescribe(0, [0., 0.]), "position: found the shape (2,)")
        moved = triangles.astype(float)
        for value, text in ((0.5, "0.5"), (-1., "-1"), (numpy.nan, "nan"), (2.**31, "2147483648")):
            moved[1, 2] = value
            self.refused(lambda: homespun.Cloth(self.cell, rest, moved),
                         f"triangles: found {text}", "at [1, 2]; expected")
        wrong = triangles.copy()
        wrong[1, 2] = -1
        self.refused(lambda: homespun.Cloth(self.cell, rest, wrong), "triangles: found -1 at [1, 2]")
        self.refused(lambda: homespun.Cloth(self.cell, rest, triangles[:, :2]),
                     "triangles: found the shape (8, 2); expected (n, 3)")

    def test_whatever_numpy_takes_for_numbers_makes_the_same_cloth(self):
        sheet = homespun.Sheet(self.cell, numpy.int64(3), 3)
        rest, triangles = sheet.coarse_vertices, sheet.coarse_triangles
        top = numpy.flatnonzero(rest[:, 1] > rest[:, 1].max() - 1e-9)
        fallen = []
        for given in ((rest, triangles, top.tolist(), (0., 0., -9.81)),
                      (rest.tolist(), triangles.astype("i8"), top, numpy.array([0., 0., -9.81])),
                      (numpy.asfortranarray(rest), triangles.astype("u1"), tuple(top), [0, 0, -9.81]),
                      (rest, triangles.astype("f4"), top.astype("f8"), (0., 0., -9.81))):
            cloth = homespun.Cloth(self.cell, *given[:2], held=given[2], gravity=given[3])
            cloth.prescribe(top[0], rest[top[0]].tolist() + [0.])
            cloth.step(numpy.float32(0.25))
            fallen.append(cloth.positions.copy())
        self.assertLess(fallen[0][:, 2].min(), 0.)
        for positions in fallen[1:]:
            numpy.testing.assert_array_equal(positions, fallen[0])


class Importing(unittest.TestCase):
    def run_python(self, code):
        return subprocess.run([sys.executable, "-B", "-c", code], check=True, text=True,
                              stdout=subprocess.PIPE, env=dict(os.environ)).stdout

    def test_beside_h5py_in_both_orders(self):
        with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
            path = made_cell(folder)
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
