# SPDX-License-Identifier: MIT
"""The house keeps its walls, and each rule of walls.py notices a violation planted in a copy."""
import pathlib
import shutil
import tempfile
import unittest

import walls

ROOT = pathlib.Path(__file__).resolve().parents[2]


class House(unittest.TestCase):
    def test_no_wall_is_broken(self):
        self.assertEqual(walls.violations(ROOT), [])


class Planted(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(tempfile.mkdtemp(prefix="homespun-walls-"))
        cls.addClassCleanup(shutil.rmtree, cls.root)
        for folder in walls.FOLDERS:
            shutil.copytree(ROOT / folder, cls.root / folder,
                            ignore=lambda folder, names: [
                                name for name in names if "." in name and
                                not name.endswith((".h", ".cc", "README.md"))])
        for path, text in walls.House(ROOT).others.items():
            (cls.root / path).parent.mkdir(parents=True, exist_ok=True)
            (cls.root / path).write_text(text, encoding="utf-8")

    def write(self, path, text):
        """Into the copy that all tests share, for the length of this one."""
        whole = self.root / path
        if whole.exists():
            self.addCleanup(whole.write_text, whole.read_text(encoding="utf-8"), encoding="utf-8")
        else:
            self.addCleanup(whole.unlink)
        whole.write_text(text, encoding="utf-8")

    def read(self, path):
        return (self.root / path).read_text(encoding="utf-8")

    def expect(self, rule, *says):
        found = walls.violations(self.root, [rule])
        for words in says:
            self.assertTrue(any(words in text for text in found), f"{words!r} is not among {found}")

    def append(self, path, text):
        self.write(path, self.read(path) + text)

    def include(self, path, name):
        self.write(path, f"#include {name}\n" + self.read(path))

    def test_the_copy_is_sound(self):
        self.assertEqual(walls.violations(self.root), [])

    def test_an_empty_house_is_no_house(self):
        with self.assertRaises(SystemExit):
            walls.violations(self.root / "meshes")

    def test_arrow_between_folders(self):
        for path, name in [("meshes/plain/sheet.cc", "shell/terms/term.h"),
                           ("shell/solver/cloth.cc", "localization/options.h"),
                           ("localization/upsampler.cc", "shell/terms/term.h"),
                           ("homogenization/fem/homogenize.cc", "verification/law/laws.h")]:
            self.include(path, f'"{name}"')
            self.expect(walls.arrows, f"{path}: includes {name}")

    def test_arrow_between_wings(self):
        for path, name in [("shell/terms/wind.cc", "shell/solver/cloth.h"),
                           ("meshes/plain/sheet.cc", "meshes/files/write_whole.h"),
                           ("homogenization/bracket/bracket.cc", "homogenization/fem/homogenize.h"),
                           ("verification/converge/converge_cell.cc",
                            "verification/stress/stress_sheet.h"),
                           ("verification/record/verdict.cc", "verification/cell/cell_bars.h")]:
            self.include(path, f'"{name}"')
            self.expect(walls.arrows, f"{path}: includes {name}")

    def test_functions(self):
        long_one = "int long_one(int n)\n{\n" + 79 * "++n;\n" + "}\n"
        self.append("meshes/plain/sheet.cc", "namespace homespun\n{\n" + long_one + "}\n")
        many = "void many(int a, double b, std::map<int, int> c, int d, int e, int f, int g);\n"
        unclear = "void unclear(int n, bool is_fast);\n"
        self.append("shell/solver/cloth.h", f"namespace homespun\n{{\n{many}{unclear}}}\n")
        self.expect(walls.signatures, "long_one: 81 lines; at most 80",
                    "many: 7 parameters; at most 6", "unclear: a boolean parameter")

    def test_file_in_no_wing(self):
        self.write("shell/loose.cc", "")
        self.expect(walls.arrows, "shell/loose.cc: stands in no wing")

    def test_door_that_nobody_uses(self):
        for path in (self.root / "verification" / "drape").rglob("*.*"):
            text = path.read_text(encoding="utf-8")
            if '"verification/method/' in text:
                self.write(path, text.replace('"verification/method/', '"meshes/plain/'))
        self.expect(walls.unused_arrows, "verification/drape may include verification/method")

    def test_circle(self):
        self.include("meshes/plain/triangle_mesh.h", '"meshes/plain/lattice.h"')
        self.expect(walls.circles, "circle: meshes/plain/")

    def test_library_in_another_room(self):
        for path, name in [("verification/strain/strain_study.cc", "<deal.II/fe/fe_system.h>"),
                           ("shell/solver/cloth.cc", "<deal.II/base/mpi.h>"),
                           ("verification/strain/strain_study.cc", "<deal.II/base/mpi.h>"),
                           ("verification/law/laws.cc", "<Epetra_CrsMatrix.h>"),
                           ("homogenization/fem/elastic_solver.cc", "<Epetra_CrsMatrix.h>"),
                           ("verification/strain/strain_study.cc", "<CLI/App.hpp>"),
                           ("verification/drape/drape_study.cc", "<nlohmann/json.hpp>")]:
            self.include(path, name)
            self.expect(walls.places, f"{path}: includes {name}")

    def test_ground_that_has_worn_away(self):
        for wing, names in walls.GROUND.items():
            for name in names:
                with self.subTest(name):
                    for path in (self.root / wing).iterdir():
                        if name in (text := path.read_text(encoding="utf-8")):
                            self.write(path, text.replace(name, "Own") + f"// {name}\n")
                    self.expect(walls.ground, f"{wing}: uses no {name}")
                self.doCleanups()

    def test_column_by_number(self):
        self.append("verification/strain/validity.cc", "double x = row[3];\n")
        self.expect(walls.rows, "row[3]; columns have names")

    def test_header_that_only_tests_include(self):
        self.write("shell/terms/unused.h", "")
        self.expect(walls.test_headers, "shell/terms/unused.h: no product file includes it")

    def test_folder_of_too_many_files(self):
        for k in range(walls.MOST_FILES):
            self.write(f"meshes/cloth/more{k}{walls.SOURCES[k % len(walls.SOURCES)]}", "")
        self.expect(walls.sizes, "meshes/cloth: ")

    def test_test_that_nothing_runs(self):
        path = "tests/verification/CMakeLists.txt"
        self.write(path, self.read(path).replace("forces gains edges", "forces edges"))
        self.expect(walls.unlisted_tests, "program/gains_test.py: no CMakeLists.txt above it")

    def test_file_at_the_top(self):
        self.write("setup.cfg", "")
        self.expect(walls.top_level, "setup.cfg: stands at the top")

    def test_file_of_too_many_lines(self):
        self.append("shell/solver/cloth.cc", "\n" * walls.MOST_LINES)
        self.expect(walls.sizes, "shell/solver/cloth.cc: ")

    def test_long_line(self):
        long = "#" + "±" * walls.MOST_COLUMNS  # in characters, not in bytes
        paths = ["shell/solver/cloth.cc", "bootstrap", "CMakeLists.txt",
                 "tests/fuzz/CMakeLists.txt", "homogenization/dealii.cmake",
                 "meshes/homespun-config.cmake.in", "tests/walls/walls.py",
                 "tests/verification/program/cli.py"]
        for path in paths:
            self.append(path, long[1:] + "\n")
        self.assertEqual(walls.violations(self.root, [walls.texts]), [])
        for path in paths:
            self.append(path, long + "\n")
        found = walls.violations(self.root, [walls.texts])
        self.assertEqual(sorted(text.split(":")[0] for text in found), sorted(paths))
        self.expect(walls.texts, "101 columns; at most 100")

    def test_document_that_a_reader_has_not(self):
        self.append("shell/solver/cloth.cc", "// see " + "METHOD" + " 3\n")
        self.expect(walls.texts, "not part of the repository")

    def test_diary_of_a_limit(self):
        self.append("verification/strain/validity.cc", '// "limit set ' + 'before any run"\n')
        self.expect(walls.texts, "tells how a limit came about")


if __name__ == "__main__":
    unittest.main()
