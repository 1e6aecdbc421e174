# SPDX-License-Identifier: MIT
"""Mutants apply to the sources as they are, are drawn alike, and their table can be taken up."""
import contextlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import draw
import executed
import patches
import results
import run

MOST_LINES = 5


def row_of(mutant, **more):
    return {**dict.fromkeys(results.COLUMNS, ""), "mutant": mutant, **more}


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="homespun-mutants-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Patches(unittest.TestCase):
    mutants = patches.read()

    def test_there_are_enough_of_them_with_names_of_their_own(self):
        self.assertGreaterEqual(len(self.mutants), 40)
        self.assertGreaterEqual(sum(mutant.kind == "chosen" for mutant in self.mutants), 24)
        self.assertEqual(len({mutant.name for mutant in self.mutants}), len(self.mutants))

    def test_each_says_what_is_wrong_in_one_line(self):
        for mutant in self.mutants:
            with self.subTest(mutant.name):
                self.assertGreater(len(mutant.sentence.split()), 1)
                if mutant.kind == "chosen":
                    self.assertRegex(mutant.sentence, r"^[\w].*\.$")
                    self.assertLessEqual(len(mutant.sentence), 98)

    def test_each_changes_a_few_lines_of_one_file_of_the_product(self):
        for mutant in self.mutants:
            with self.subTest(mutant.name):
                self.assertEqual(len(mutant.files), 1)
                self.assertRegex(mutant.file, rf"^({'|'.join(patches.PRODUCT)})/.*\.(cc|h)$")
                self.assertTrue(1 <= mutant.changed_lines() <= MOST_LINES, mutant.changed_lines())

    def test_each_applies_to_the_sources_as_they_are(self):
        for mutant in self.mutants:
            with self.subTest(mutant.name):
                sound = (patches.ROOT / mutant.file).read_text(encoding="utf-8")
                self.assertNotEqual(mutant.applied(sound), sound)

    def test_every_folder_of_the_product_has_chosen_ones(self):
        chosen = " ".join(mutant.file for mutant in self.mutants if mutant.kind == "chosen")
        for folder in ("meshes/plain", "meshes/cloth", "meshes/garment", "meshes/files",
                       "homogenization/algebra", "homogenization/cell", "homogenization/lint",
                       "homogenization/fem", "homogenization/bracket", "shell/algebra",
                       "shell/membrane", "shell/terms", "shell/solver", "shell/contact",
                       "localization", "verification/record", "verification/reference",
                       "verification/cell", "verification/method", "verification/strain/budget",
                       "verification/strain", "verification/converge", "verification/drape",
                       "verification/stress"):
            self.assertIn(folder + "/", chosen)

    def test_a_patch_is_read_as_it_was_written(self):
        old = "".join(f"line {k}\n" for k in range(20))
        new = old.replace("line 7\n", "").replace("line 15", "line fifteen")
        text = patches.patch_of("shell/a.cc", old, new, "Two lines.")
        mutant = patches.parsed(text, "a", "drawn")
        self.assertEqual((mutant.sentence, mutant.file), ("Two lines.", "shell/a.cc"))
        self.assertEqual(mutant.changed_lines(), 2)
        self.assertEqual(mutant.applied(old), new)
        self.assertEqual(mutant.applied("moved\n" + old), "moved\n" + new)

    def test_a_place_that_is_gone_or_not_the_only_one_is_refused(self):
        old = "".join(f"line {k}\n" for k in range(9))
        mutant = patches.parsed(patches.patch_of("shell/a.cc", old, old.replace("4", "four"), "A."),
                                "a", "drawn")
        for text in (old.replace("line 5", "line five"), old + old):
            with self.assertRaises(ValueError):
                mutant.applied(text)


class Drawing(InFolder):
    def drawn_in(self, name, seed):
        draw.write(self.folder / name, seed, 24)
        return {path.name: path.read_text(encoding="utf-8")
                for path in (self.folder / name).glob("*.patch")}

    def test_the_same_seed_gives_the_same_patches(self):
        first = self.drawn_in("first", 17)
        self.assertEqual(len(first), 24)
        self.assertEqual(first, self.drawn_in("second", 17))
        self.assertNotEqual(first, self.drawn_in("third", 18))

    def test_they_are_spread_over_folders_and_files(self):
        files = [patches.parsed(text, name, "drawn").file
                 for name, text in draw.drawn(17, 24)]
        self.assertLessEqual(max(files.count(file) for file in files), 2)
        for folder in patches.PRODUCT:
            self.assertGreaterEqual(sum(file.startswith(folder + "/") for file in files), 3)
        self.assertFalse([file for file in files if draw.LEFT_OUT.match(file)])

    def test_what_speaks_is_left_alone(self):
        text = ('#include "a - b"\n// a - b\n  throw Bad("a" + b - c);\n'
                "  AssertThrow(a < b, c());\n"
                "  double x = a - b; // c - d\n  std::string name = a + b;\n")
        self.assertEqual(list(draw.sites(text, draw.other_sign)),
                         [(4, "  double x = a + b; // c - d")])
        self.assertEqual(list(draw.sites(text, draw.other_comparison)), [])

    def test_operators(self):
        for operator, line, expected in [
                (draw.other_factor, "x = 0.5 * y;", ["x = 2. * y;"]),
                (draw.other_factor, "x = 1e-3 * y(0) + 3;", ["x = 0.0011 * y(0) + 3;"]),
                (draw.other_index, "x = f(0) * g(1);", ["x = f(1) * g(1);", "x = f(0) * g(0);"]),
                (draw.other_comparison, "if (a < b)", ["if (a <= b)"]),
                (draw.other_comparison, "std::vector<int> a;", []),
                (draw.other_logic, "if (a && b ||", ["if (a || b ||", "if (a && b &&"]),
                (draw.other_logic, "auto &&a = b;", []),
                (draw.other_extremum, "std::min(a, std::max_element(b))",
                 ["std::max(a, std::max_element(b))"]),
                (draw.dropped_term, "  a(k) += b * c;", [None]),
                (draw.dropped_term, "  a = b;", []),
                (draw.dropped_not, "if (!a && b != c)", ["if (a && b != c)"])]:
            with self.subTest(line):
                self.assertEqual(list(operator(line)), expected)


class Running(InFolder):
    def test_a_table_is_taken_up(self):
        table = results.Table(self.folder / "mutants.csv")
        table.add(row_of("one", file="a, b", builds="true"))
        table.add(row_of("two", builds="false"))
        table.add(row_of("half", builds="true", noticed_by_program=results.NOT_YET))
        asked = []

        def row(mutant, row, who):
            asked.append((mutant.name, who))
            return {**row, "noticed_by_test": "x.y", "noticed_by_program": "claim"}

        mutants = [patches.Mutant(name, "chosen", "", ["shell/a.cc"], [])
                   for name in ("one", "two", "half", "three")]
        with contextlib.redirect_stdout(io.StringIO()):
            run.measure(mutants, results.Table(self.folder / "mutants.csv"), row, ["tests"])
        self.assertEqual(asked, [("three", ["tests"])])
        with contextlib.redirect_stdout(io.StringIO()):
            run.measure(mutants, results.Table(self.folder / "mutants.csv"), row)
        self.assertEqual(asked[1:], [("half", ["program"])])
        again = results.Table(self.folder / "mutants.csv")
        self.assertEqual(list(again.rows), ["one", "two", "half", "three"])
        self.assertEqual(again.rows["one"]["file"], "a, b")
        self.assertEqual(again.rows["three"]["noticed_by_test"], "x.y")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["mutants.csv"])

    def test_a_foreign_table_is_refused(self):
        (self.folder / "mutants.csv").write_text("mutant,other\n", encoding="utf-8")
        with self.assertRaises(SystemExit):
            results.Table(self.folder / "mutants.csv")

    def test_a_copy_is_mended_whatever_was_left_there(self):
        source, copy = self.folder / "source", self.folder / "copy"
        for path, text in [("shell/a.cc", "sound\n"), ("shell/b.cc", "b\n"), ("build/x", "x\n")]:
            (source / path).parent.mkdir(parents=True, exist_ok=True)
            (source / path).write_text(text, encoding="utf-8")
        run.make_equal(source, copy)
        untouched = (copy / "shell/b.cc").stat().st_mtime_ns
        (copy / "shell/a.cc").write_text("faulty\n", encoding="utf-8")
        (copy / "shell/c.cc").write_text("more\n", encoding="utf-8")
        run.make_equal(source, copy)
        self.assertEqual((copy / "shell/a.cc").read_text(encoding="utf-8"), "sound\n")
        self.assertEqual((copy / "shell/b.cc").stat().st_mtime_ns, untouched)
        self.assertFalse((copy / "shell/c.cc").exists() or (copy / "build").exists())

    def test_a_folder_of_somebody_else_is_refused(self):
        (self.folder / "source").mkdir()
        for work in (self.folder, patches.ROOT, patches.ROOT / "shell" / "work"):
            with self.assertRaises(SystemExit):
                run.refuse_places(work)
        run.refuse_places(patches.ROOT / "build" / "mutants")

    def test_the_quickest_tests_come_first(self):
        names = ["consumer", "a.b", "walls", "verification.cli", "c.d", "mutants", "e.f"]
        seconds = {"a.b": 5., "c.d": 0.01, "verification.cli": 70., "consumer": 22., "e.f": 0.02}
        self.assertEqual(run.batches_of(names, seconds), [[5, 7], [2], [1], [4]])
        self.assertEqual(run.batches_of(names, {}), [[2, 5, 7], [4], [1]])

    def test_tests_of_the_folder_of_a_file_and_their_programs(self):
        names = ["walls", "meshes.plain.exact", "meshes.files.exact", "meshes.plain.bound"]
        self.assertEqual(run.tests_beside(names, "meshes/plain/lattice.cc"), {2, 4})
        tests = [{"command": ["/a/build/tests/meshes/tests_meshes", "--label", "exact"]},
                 {"command": ["/usr/bin/python3", "walls.py"]}]
        self.assertEqual(run.programs_of(tests, "/a/build"), ["tests/meshes/tests_meshes", None])

    def test_what_the_program_notices(self):
        usual = {"status": 4, "claims": ["known"]}
        for status, claims, expected in [(4, ["known"], ""), (0, [], ""),
                                         (1, ["known", "new"], "new"),
                                         (3, ["known"], "exit status 3, usually 4"),
                                         (-11, [], "exit status -11, usually 4"),
                                         (None, [], "exit status None, usually 4")]:
            self.assertEqual(run.what_the_program_says(status, claims, usual), expected)

    def test_lines_that_are_executed(self):
        old = "".join(f"line {k}\n" for k in range(1, 10))
        text = patches.patch_of("shell/a.cc", old, old.replace("line 5\n", "fault\n"), "A fault.")
        mutant = patches.parsed(text, "a", "chosen")
        self.assertEqual(executed.changed_lines_of(mutant, "moved\n" + old), [6])
        self.assertTrue(executed.is_executed([6], {3: 0, 6: 2, 7: 0}))
        self.assertTrue(executed.is_executed([6], {3: 0, 5: 2, 7: 0}))
        self.assertFalse(executed.is_executed([6], {3: 4, 5: 0, 7: 5}))
        self.assertFalse(executed.is_executed([2], {3: 4}))

    def test_only_files_with_mutants_are_counted(self):
        script = self.folder / "compiler"
        script.write_text(executed.launcher_of({"shell/a.cc", "meshes/b.h"}), encoding="utf-8")
        script.chmod(0o755)
        for file, expected in (("../../shell/a.cc", "--coverage -O1"), ("../../shell/aa.cc", ""),
                               ("/x/shell/a.cc", "--coverage -O1"), ("../../shell/b.cc", "")):
            command = [str(script), "/bin/echo", "-c", file]
            answer = subprocess.run(command, capture_output=True, text=True, check=True,
                                    env={**os.environ, "CCACHE_DISABLE": "1"})
            self.assertEqual(answer.stdout.split(file)[1].strip(), expected)

    def test_the_score_counts_what_the_program_could_notice(self):
        rows = [row_of("a", builds="true", noticed_by_test="x"),
                row_of("b", builds="true", noticed_by_program="claim"),
                row_of("c", builds="true"), row_of("d", builds="false"),
                row_of("e", builds="true", noticed_by_test=results.NOT_YET)]
        self.assertIn("4 mutants build; tests notice 1 of 3, the program 1 of 4; unnoticed: c",
                      results.score(rows, None))
        self.assertIn("the program 1 of 3 in lines that it executes; unnoticed: c",
                      results.score(rows, {"b", "c", "d", "e"}))

    def test_a_program_that_did_not_end_is_the_worst(self):
        self.assertEqual(sorted([0, 4, None, 1, 2, -11, 3], key=run.place_of)[2:], [2, 3, 1, 4, 0])

    def test_settings_and_seconds_of_a_build_are_read(self):
        (self.folder / "Testing/Temporary").mkdir(parents=True)
        (self.folder / "CMakeCache.txt").write_text(
            "// a comment\nCMAKE_BUILD_TYPE:STRING=Release\nCMAKE_GENERATOR:INTERNAL=Ninja\n"
            "CMAKE_HOME_DIRECTORY:INTERNAL=/a\nHOMESPUN_AUDIT:BOOL=OFF\n", encoding="utf-8")
        (self.folder / "Testing/Temporary/CTestCostData.txt").write_text(
            "consumer 1 22.5\nwalls 0 0\n---\nwalls\n", encoding="utf-8")
        self.assertEqual(run.settings_of(self.folder),
                         ["-G", "Ninja", "-DCMAKE_BUILD_TYPE:STRING=Release",
                          "-DHOMESPUN_AUDIT:BOOL=OFF"])
        self.assertEqual(run.seconds_of_tests(self.folder / "no", self.folder), {"consumer": 22.5})

    def test_all_go_in_and_out_of_a_copy(self):
        run.make_equal(patches.ROOT, self.folder / "source")
        workshop = run.Workshop.__new__(run.Workshop)  # without a build
        workshop.copy = self.folder / "source"
        for mutant in patches.read():
            self.assertEqual(workshop.tried(mutant)["mutant"], mutant.name)


    @unittest.skipUnless(shutil.which("ctest"), "needs ctest")
    def test_a_row_says_who_notices(self):
        # A build tree whose tests and program read the source, so that nothing is built.
        workshop = run.Workshop.__new__(run.Workshop)
        workshop.work, workshop.environment = self.folder, dict(os.environ)
        workshop.copy, workshop.build = self.folder / "source", self.folder / "build"
        for folder in (workshop.copy / "shell", workshop.build):
            folder.mkdir(parents=True)
        source = workshop.copy / "shell/a.cc"
        old = "one\ntwo\nthree\n"
        source.write_text(old, encoding="utf-8")
        (workshop.build / "CTestTestfile.cmake").write_text("".join(
            f'add_test({name} "grep" "-q" "{word}" "{source}")\n'
            for name, word in [("slow", "t"), ("fails", "never"), ("shell.second", "two"),
                               ("a.third", "three")]), encoding="utf-8")
        program = workshop.build / "homespun"
        program.write_text(
            "#!/bin/sh\n"
            f"grep -q three {source} && exit 4\n"
            "mkdir -p $5\n"
            "echo '{\"verdicts\": [{\"claim\": \"it holds\", \"kind\": \"program\", "
            "\"verdict\": \"FAIL\"}]}' > $5/verdicts.json\n"
            "exit 1\n", encoding="utf-8")
        program.chmod(0o755)
        workshop.usual = {part: {"status": 4, "claims": []} for part in run.PARTS}
        workshop.names = ["slow", "fails", "shell.second", "a.third"]
        workshop.programs = [None, None, "tests_shell", None]
        workshop.revision = "1234abcd"
        workshop.batches = run.batches_of(workshop.names, {"slow": 20.}, ["fails"])
        built = []

        def builds(*targets):
            built.append(targets)
            return "all" not in refused or targets != ()

        for fault, refused, test, claim, expected in [
                ("two", "", "shell.second", "", [("tests_shell",), ("homespun",)]),
                ("three", "", "a.third", "it holds", [("tests_shell",), (), ("homespun",)]),
                ("one", "", "", "", [("tests_shell",), (), ("homespun",)]),
                ("one", "all", "", "", [("tests_shell",), ()])]:
            built.clear()
            workshop.builds = builds
            text = patches.patch_of("shell/a.cc", old, old.replace(fault, "fault"), "A fault.")
            mutant = patches.parsed(text, fault, "chosen")
            row = workshop.measured(mutant, results.new_row(mutant), ["tests", "program"])
            self.assertEqual((row["builds"], row["noticed_by_test"], row["noticed_by_program"]),
                             ("false" if refused else "true", test, claim))
            self.assertEqual(row["seconds_to_notice"] != "", test != "")
            self.assertEqual(row["tests_at"] + row["program_at"], "" if refused else 2 * "1234abcd")
            self.assertEqual(built, expected)
            self.assertEqual(source.read_text(encoding="utf-8"), old)


class Readme(unittest.TestCase):
    def test_its_score_is_that_of_the_table(self):
        table = results.Table(patches.HERE / "measured.csv")
        said = results.score(list(table.rows.values()), results.executed_in(patches.HERE))
        text = " ".join((patches.HERE / "README.md").read_text(encoding="utf-8").split())
        self.assertIn(said.split("; unnoticed")[0], text.replace("**", ""))
        names = {mutant.name for mutant in patches.read()}
        self.assertLessEqual(set(table.rows), names)
        for name in said.split("unnoticed: ")[1].split(", "):
            self.assertIn(f"`{name}`", text)

    def test_mutants_that_it_names_are_there(self):
        text = (patches.HERE / "README.md").read_text(encoding="utf-8")
        names = set(re.findall(r"`(\d\d-\w+)`", text))
        self.assertTrue(names)
        self.assertEqual(names - {mutant.name for mutant in patches.read()}, set())


if __name__ == "__main__":
    unittest.main()
