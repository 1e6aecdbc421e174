# SPDX-License-Identifier: MIT
"""Studies from Python: the program's numbers for somebody's own method, its messages as errors."""
import contextlib
import io
import re
import subprocess
import sys
import unittest
import unittest.mock
import warnings

import numpy

import homespun
from with_cell import BUILD, CELLS, WithFolder


def carried(mesh):
    """The method that carries fine vertices along with their coarse triangle."""
    triangles = mesh.coarse_triangles
    corners = mesh.coarse_rest[triangles]
    best, of = numpy.full(len(mesh.rest), -numpy.inf), numpy.zeros(len(mesh.rest), dtype=int)
    shares = numpy.zeros((len(mesh.rest), 3))
    for t, (a, b, c) in enumerate(corners):
        two = numpy.linalg.solve(numpy.column_stack([b - a, c - a]), (mesh.rest - a).T).T
        here = numpy.column_stack([1.0 - two.sum(axis=1), two])
        nearer = here.min(axis=1) > best
        best[nearer], of[nearer], shares[nearer] = here.min(axis=1)[nearer], t, here[nearer]
    return lambda coarse: numpy.einsum("nk,nkc->nc", shares, coarse[triangles[of]])


class Studies(WithFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.said = io.StringIO()
        with contextlib.redirect_stderr(cls.said):
            cls.run_ = cls.study()

    @classmethod
    def study(cls, **other):
        return homespun.study(CELLS / "layered.prm", **{
            "loads": ["strip-1", "periodic-11"], "strains": [0.01, 0.1], "laws": ["biot"],
            "methods": ["affine", "localized"], "cells": 4, "output": cls.folder / "study", **other})

    def setUp(self):
        self.quiet = io.StringIO()
        silence = contextlib.redirect_stderr(self.quiet)
        silence.__enter__()
        self.addCleanup(silence.__exit__, None, None, None)

    def by_the_program(self, fine, name):
        """Rows of strain.csv that `homespun judge` writes for positions in files."""
        files, output = self.folder / f"files-{name}", self.folder / f"program-{name}"
        files.mkdir()
        for (load, strain, law), positions in fine.items():
            numpy.save(files / f"{load}-{law}-{strain:g}.npy", positions)
        subprocess.run([BUILD / "homespun", "judge", self.run_.folder, files, "--name", name,
                        "--output", output, "--quiet", "--no-report"], check=False)
        table = homespun.results(output)["strain"]
        return table[table["method"] == name]

    def test_a_study_has_what_was_kept(self):
        run = self.run_
        self.assertEqual(len(run.levels), 4)
        self.assertEqual(run.triangles.max() + 1, len(run.rest))
        self.assertEqual(len(run.phases), len(run.triangles))
        self.assertEqual(run.reference("strip-1", 0.1, "biot").shape, run.rest.shape)
        self.assertEqual(run.coarse("strip-1", 0.1, "biot").shape, run.sheet.coarse_rest.shape)
        self.assertEqual(run.coarse("periodic-11", 0.1, "biot").shape,
                         run.periodic.coarse_rest.shape)
        numpy.testing.assert_array_equal(run.cell.lattice[:, 0].max(), run.periodic.rest[:, 0].max())
        self.assertIn("[", self.said.getvalue())  # progress
        again = self.study()  # nothing is run again
        self.assertEqual(again.levels, run.levels)
        self.assertIn("all rows are there", self.quiet.getvalue())
        self.assertEqual(homespun.Study(run.folder).levels, run.levels)

    def test_a_method_has_the_numbers_of_the_program(self):
        run = self.run_
        flat, cell = carried(run.sheet), carried(run.periodic)
        judged = run.judge_method(flat, "flat", periodic=cell)
        fine = {level: (flat if level.load == "strip-1" else cell)(run.coarse(*level))
                for level in run.levels}
        program = self.by_the_program(fine, "flat")
        self.assertEqual(len(program), 4)
        same = [name for name in program.dtype.names if name != "seconds_method"]
        for one, two in zip(judged.rows[same], program[same]):
            for name in same:
                numpy.testing.assert_array_equal(one[name], two[name], err_msg=name)
        # which are those of the coarse mesh alone; its run time has the coarse cloth's in it
        table = homespun.results(run.folder)["strain"]
        for row in judged.rows:
            affine = table[(table["load"] == row["load"]) & (table["strain"] == row["strain"])
                           & (table["method"] == "affine")][0]
            self.assertAlmostEqual(row["error_mean_m"] / affine["error_mean_m"], 1.0, delta=1e-9)
            self.assertGreater(row["seconds_method"], 0.0)
        self.assertIn("4 levels, run times are medians of 5 calls", self.quiet.getvalue())
        lines = repr(judged).splitlines()
        self.assertIn("mean errors in 1/1000 of strain x cell side", lines[0])
        self.assertEqual(lines[1].split(), ["load", "law", "strain", "flat", "affine", "localized"])
        self.assertEqual(len(lines), 6)
        for line, row, rank in zip(lines[2:], judged.rows, judged.ranks):
            error, affine, localized = re.fullmatch(
                r"\S+ +biot +(?:1|10) % +(\S+) ± \S+ +(\S+) +(\S+) +rank . of 3",
                line).groups()
            self.assertTrue(line.endswith(f"rank {rank} of 3"), line)
            here = table[(table["load"] == row["load"]) & (table["strain"] == row["strain"])]
            for text, method in ((affine, "affine"), (localized, "localized")):
                known = here["error_mean_m"][here["method"] == method][0]
                self.assertAlmostEqual(float(text) / float(error),
                                       known / row["error_mean_m"], delta=1e-3)

    def test_what_a_method_gives_is_its_level_s_even_if_it_gives_one_array_again(self):
        run, out = self.run_, numpy.empty_like(self.run_.rest)
        carry = carried(run.sheet)

        def in_place(coarse):
            out[:] = carry(coarse)
            return out

        def names(judged):
            return [name for name in judged.rows.dtype.names if name not in ("method",
                                                                           "seconds_method")]

        fresh, again = (run.judge_method(method, name) for method, name in
                        ((carry, "fresh"), (in_place, "again")))
        self.assertEqual(len(fresh.rows), 2)
        for name in names(fresh):
            numpy.testing.assert_array_equal(fresh.rows[name], again.rows[name], err_msg=name)

        def spoiling(coarse):
            coarse -= run.sheet.coarse_rest
            return carry(coarse)

        self.refused(lambda: run.judge_method(spoiling, "spoiling"), "read-only")

    def test_ranks_count_the_methods_that_are_closer(self):
        run, level = self.run_, ("strip-1", 0.1, "biot")
        table = homespun.results(run.folder)["strain"]
        errors = sorted(table["error_mean_m"][(table["load"] == "strip-1")
                                              & (table["strain"] == 0.1)])
        between = numpy.array([0.5 * (errors[0] + errors[1]), 0.0])
        for shift, rank in ((0.0, 1), (between, 2), (4.0 * between, 3)):
            judged = run.judge({level: run.reference(*level) + shift}, "shifted")
            self.assertEqual((judged.ranks.tolist(), judged.n_methods.tolist()), ([rank], [3]))
            if rank == 1:  # an error of zero is known to the bar of the reference, not better
                self.assertRegex(repr(judged), r" 0 ± 0?\.?[1-9]")

    def test_what_the_program_notes_of_positions_is_a_warning(self):
        run, level = self.run_, ("strip-1", 0.1, "biot")
        close = run.reference(*level) + [1e-9, 0.0]
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            run.judge({level: close}, "fine")
            self.assertEqual(caught, [])
            run.judge({level: close.astype("f4")}, "single")
        (said,) = caught
        self.assertRegex(str(said.message), r"^strip-1-biot-0\.1\.npy: its numbers tell .* m apart;")
        self.assertEqual(said.filename, __file__)

    def test_a_program_that_is_killed_is_told_from_one_that_ends(self):
        program = self.folder / "program"
        module = sys.modules[homespun.Study.__module__]
        for does, kind, *texts in (
                ("echo 'homespun: note' >&2; kill -9 $$", RuntimeError,
                 "homespun judge was killed by signal 9 (Killed): is there enough memory?",
                 "homespun: note"),
                ("kill -11 $$", RuntimeError, "homespun judge was killed by signal 11 (Segm"),
                ("echo 'homespun: no' >&2; exit 3", homespun.NotConverged, "no"),
                ("exit 7", RuntimeError, "homespun judge ended with status 7")):
            program.write_text(f"#!/bin/sh\n{does}\n", encoding="utf-8")
            program.chmod(0o755)
            with unittest.mock.patch.object(module, "program", lambda: str(program)):
                self.refused(lambda: self.run_.judge({}, "mine"), *texts, kind=kind)

    def test_a_name_is_checked_before_a_method_is_called(self):
        run, called = self.run_, []
        good = "expected letters, digits and _, and no method"
        for name in ("my method", "", "my-method", "mein_ä", "affine", "biot"):
            for judge in (lambda name: run.judge_method(called.append, name),
                          lambda name: run.judge({}, name)):
                self.refused(lambda: judge(name), f"name: found `{name}`; {good}")
        self.assertEqual(called, [])
        with self.assertRaises(ValueError) as caught:  # of the program, and not of this run
            run.judge({run.levels[0]: run.reference(*run.levels[0])}, "full")
        self.assertRegex(str(caught.exception), "^name: found `full`; expected letters")

    def test_a_result_that_is_no_array_of_positions_is_refused_at_the_first_level(self):
        run, n = self.run_, len(self.run_.sheet.rest)
        n_cell = len(run.periodic.rest)
        for argument, wrong, found in (
                ("method", lambda coarse: coarse, r"shape \(25, 2\) and type float64"),
                ("method", lambda coarse: None, r"shape \(\) and type object"),
                ("method", lambda coarse: numpy.zeros((n, 2), dtype=int),
                 rf"shape \({n}, 2\) and type int"),
                ("periodic", lambda coarse: run.rest, rf"shape \({n}, 2\) and type float64")):
            called = []
            methods = {"method": carried(run.sheet), "periodic": None, argument: lambda coarse: (
                called.append(coarse), wrong(coarse))[1]}
            with self.assertRaises(homespun.BadInput) as caught:
                run.judge_method(methods["method"], "mine", periodic=methods["periodic"])
            expected = n if argument == "method" else n_cell
            self.assertRegex(str(caught.exception),
                             rf"^{argument}: returned an array of {found}\S* for \('[a-z]+-11?', "
                             rf"0\.01, 'biot'\); expected shape \({expected}, 2\) or "
                             rf"\({expected}, 3\)")
            self.assertEqual(len(called), 1)

    def test_the_commands_of_the_page_name_no_file_that_is_gone(self):
        run, level = self.run_, ("strip-1", 0.1, "biot")
        judged = run.judge({level: run.reference(*level) + [1e-6, 0.0]}, "mine")
        for name in ("study.json", "verdicts.json"):
            text = (judged.folder / name).read_text(encoding="utf-8")
            self.assertIn(f"homespun judge {run.folder} YOURS.csv --name mine", text)
            self.assertNotIn("/homespun-", text.replace(str(self.folder), ""))

    def test_options_come_to_what_a_study_leaves_out(self):
        module, said = sys.modules[homespun.Study.__module__], []
        with unittest.mock.patch.object(module, "_run", lambda words, _: said.append(words)):
            self.study(options=["--overwrite"])
            self.study(also=["budget"])
        for words, there in zip(said, ({"--no-budget", "--no-runtime", "--overwrite"},
                                       {"--no-runtime"})):
            self.assertEqual(there, {"--no-budget", "--no-runtime", "--overwrite"} & set(words))

    def test_faults_are_the_messages_of_the_program(self):
        run, level = self.run_, ("strip-1", 0.1, "biot")
        wrong = run.reference(*level)
        wrong[3, 1] = numpy.nan
        self.refused(lambda: run.judge({level: wrong}, "mine"), "holds NaN")
        self.refused(lambda: run.judge({("strip-1", 0.2, "biot"): run.rest}, "mine"),
                     "is no level or frame of")
        self.refused(lambda: run.judge({level: run.rest}, "affine"), "no method, law or reference")
        self.refused(lambda: run.reference("strip-1", 0.2, "biot"), "has no level",
                     "('strip-1', 0.1, 'biot')")
        self.refused(lambda: self.study(loads=["strip-3"]), "unknown load `strip-3`")
        self.refused(lambda: self.study(also=["budgets"]), "also: found budgets; expected some of")
        # Without --resume a run of seconds is replaced.
        self.refused(lambda: self.study(strains=[0.02], options=["--resume"]),
                     "holds another run")
        self.refused(lambda: homespun.study("absent.prm"), "absent.prm: no such file")
        self.refused(lambda: homespun.Study(self.folder), "strain --keep")


if __name__ == "__main__":
    unittest.main()
