# SPDX-License-Identifier: MIT
"""Meshes of other formats as a user meets them: converted once, by the first rank, without a trace;
what is missing is named with the package that brings it.
"""
import json
import os
import pathlib
import shutil
import unittest

from cli import InFolder, run

DATA = pathlib.Path(__file__).resolve().parents[2] / "homogenization" / "cell" / "data"
KEYS = """set Mesh = {mesh}
set Length unit = 0.01
set Young's modulus = {soft}: 1e6, {hard}: 1e7
set Poisson's ratio = {soft}: 0.3, {hard}: 0.3
set Thickness = {soft}: 5e-4, {hard}: 5e-4
set Density = {soft}: 400, {hard}: 400
"""
# A meshio that tells each time it is asked, and then gives way to the true one.
COUNTING = """import os, sys
with open(os.environ["ASKED"], "a") as file:
    file.write("asked\\n")
sys.path.remove(os.path.dirname(os.path.abspath(__file__)))
del sys.modules["meshio"]
import meshio
"""


class MeshFormats(InFolder):
    def setUp(self):
        super().setUp()
        self.passing = self.folder / "passing"
        self.passing.mkdir()
        self.environment = {**os.environ, "TMPDIR": str(self.passing)}

    def tearDown(self):
        names = [path.name for path in self.passing.iterdir() if path.name.startswith(".homespun")]
        self.assertEqual(names, [], "a temporary file was left")

    def cell(self, mesh, soft="7", hard="3"):
        shutil.copy(DATA / mesh, self.folder)
        path = self.folder / "cell.prm"
        path.write_text(KEYS.format(mesh=mesh, soft=soft, hard=hard), encoding="utf-8")
        return path

    def python_finds(self, name, text):
        """Puts a module in front of all others of its name."""
        modules = self.folder / "modules"
        modules.mkdir(exist_ok=True)
        (modules / f"{name}.py").write_text(text, encoding="utf-8")
        self.environment["PYTHONPATH"] = str(modules)

    def stiffness(self, mesh, ranks=1, **groups):
        output = self.folder / f"out-{mesh}-{ranks}"
        done = run("homogenize", self.cell(mesh, **groups), "--no-bars", "--output", output,
                   ranks=ranks, env=self.environment)
        self.assertIn(done.returncode, (0, 4), done.stderr)
        return json.loads((output / "homogenize.json").read_text(encoding="utf-8"))["C"]

    def assert_refused(self, cell, *parts, numbers=(1,)):
        for ranks in numbers:
            done = run("homogenize", cell, "--output", self.folder / "none", ranks=ranks,
                       env=self.environment)
            lines = [line for line in done.stderr.split("\n") if line.startswith("homespun: ")]
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(len(lines), 1, done.stderr)
            for part in parts:
                self.assertIn(part, lines[0])

    def test_every_format_has_the_stiffness_of_msh(self):
        names = {"soft": "soft", "hard": "hard"}
        expected = self.stiffness("halves-msh41.msh")
        for mesh, groups in (("halves.unv", names), ("halves-abaqus.inp", names),
                             ("halves.vtk", {})):
            for row, other in zip(self.stiffness(mesh, **groups), expected):
                for one, two in zip(row, other):
                    self.assertAlmostEqual(one, two, delta=1e-9 * expected[0][0], msg=mesh)

    def test_two_ranks_convert_once_and_agree_with_one(self):
        self.python_finds("meshio", COUNTING)
        asked = self.folder / "asked"
        self.environment["ASKED"] = str(asked)
        two = self.stiffness("halves.vtk", ranks=2)
        self.assertEqual(asked.read_text(encoding="utf-8"), "asked\n")
        for row, other in zip(two, self.stiffness("halves.vtk")):
            for one, two in zip(row, other):
                self.assertAlmostEqual(one, two, delta=1e-6 * other[0] + 1e-6)

    def test_a_missing_package_is_named(self):
        self.python_finds("meshio", "raise ImportError('none')\n")
        self.assert_refused(self.cell("halves.vtk"), "halves.vtk: cannot be read as a mesh",
                            "apt-get install python3-meshio")
        self.python_finds("gmsh", "raise ImportError('none')\n")
        self.assert_refused(self.cell("halves.unv"), "apt-get install python3-gmsh")

    def test_a_reader_that_dies_is_named(self):
        self.python_finds("meshio", "import os\nos.kill(os.getpid(), 11)\n")
        self.assert_refused(self.cell("halves.vtk"), "killed by signal 11", "write it again")

    def test_a_broken_mesh_is_refused_by_all_ranks(self):
        cell = self.cell("text.vtu")
        whole = (DATA / "text.vtu").read_text(encoding="utf-8")
        (self.folder / "text.vtu").write_text(whole[:900], encoding="utf-8")
        self.assert_refused(cell, "text.vtu: cannot be read as a mesh", "meshio", "expected",
                            "write it again", numbers=(1, 2))

    def test_no_module_of_the_working_folder_is_run(self):
        (self.folder / "meshio.py").write_text("raise SystemExit(1)\n", encoding="utf-8")
        done = run("check", self.cell("halves.vtk"), cwd=self.folder, env=self.environment)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
