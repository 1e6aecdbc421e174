# SPDX-License-Identifier: MIT
"""Tests of the page of `homespun strain`: /usr/bin/python3 -m unittest discover -s
tests/verification/report
"""
import glob
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

import h5py
import numpy

import report_path  # noqa: F401
from figures import style
from figures.sheet import coarse_positions
from figures.stiffness import bracket_history, directional_modulus, observed_slope
from made_up_run import list_again, verdict, write_run, write_verdicts
from made_up_study import LAMINATE, square_mesh, strain_rows, write_results
from page.contents import HEADINGS
from page.tables import phase_rows
from page_case import PageTest
from read import results
from read.cell_results import Cell, grouped, share_groups


class ReportTest(PageTest):
    def setUp(self):
        super().setUp()
        write_results(self.folder)

    def test_complete_results_make_every_section_in_one_file(self):
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        # There is one cell.
        places = [page.index(f'<h2 id="{key}">') for key in HEADINGS if key != "comparison"]
        self.assertEqual(places, sorted(places))
        self.assertFalse(
            re.search(r'src="(?!data:)|href="(?!figures/|#)', page), "the page must stand alone"
        )
        self.assertIn("a note &lt;of&gt; the study", page)
        self.assertIn("stripes, shear-frame, reference green at 20 %", page)
        self.assertIn("periodic-22: the error of localized is zero to round-off", page)
        self.assertIn(
            (
                "Law of that sheet: biot beside biot; it takes 400 ms a level (median); from a"
                " sheet half as fine the fluctuation differs by at most 0.500 %."
            ),
            page,
        )
        self.assertEqual(sorted(os.listdir(self.output)), ["figures", "report.html"])

    def test_ctrl_c_leaves_no_folder_and_no_traceback(self):
        script = os.path.join(report_path.REPORT, "report.py")
        process = subprocess.Popen(  # pylint: disable=consider-using-with
            [sys.executable, "-B", script, self.folder, "--output", self.output],
            start_new_session=True, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not glob.glob(f"{self.output}/.report-*/figures/*.svg"):
            time.sleep(0.01)  # until several processes draw
        os.killpg(process.pid, signal.SIGINT)
        told = process.communicate()[1]
        self.assertEqual(process.returncode, 130, told)
        self.assertEqual(told, "\nhomespun report: interrupted, no page was written\n")
        self.assertFalse(os.path.exists(self.output))

    def test_missing_pieces_are_named_and_the_report_is_written(self):
        self.remove(
            "study.json",
            "verdicts.json",
            "uncertainty.csv",
            "levels.csv",
            "stripes/cell.h5",
            "stripes/homogenize.json",
            "stripes/fields-shear-frame.h5",
        )
        self.edit_table("strain.csv", lambda rows: rows[:1])
        self.assertEqual(self.whole_report(), (0, ""))
        page = self.page()
        for name in ("study.json", "verdicts.json", "uncertainty.csv", "levels.csv"):
            self.assertIn(f"{name} does not exist", page)
        for what in (
            "Left out: verdicts",
            "Left out: picture of stripes",
            "Left out: sheets of stripes",
            "Left out: effective stiffness of stripes",
            "Left out: provenance",
        ):
            self.assertIn(what, page)
        # Of what the run did not make.
        for words in ("It was solved with P1, with P2 and with refined P2", "Notes of the run"):
            self.assertNotIn(words, page)

    def test_the_claims_of_verify_stand_for_those_of_its_parts(self):
        all_parts = os.path.join(self.place, "verify")
        os.makedirs(all_parts)
        write_verdicts(
            all_parts,
            [
                verdict(
                    "strain: runs to its end; no equilibrium",
                    "FAIL",
                    None,
                    "every solver converges",
                    command="homespun verify stripes.prm",
                )
            ],
        )
        write_run(all_parts, "verify")
        self.assertEqual(self.run_report(all_parts), (0, ""))
        self.assertIn("runs to its end; no equilibrium", self.page())  # without any part
        part = shutil.move(self.folder, os.path.join(all_parts, "strain"))
        self.assertEqual(self.run_report(all_parts, part), (0, ""))
        page = self.page()
        self.assertIn("0 of 1 claim hold, 1 fails: program: 0 of 1 claim hold, 1 fails.", page)
        self.assertIn("runs to its end; no equilibrium", page)
        self.assertIn("One run of <code>homespun verify</code> (revision abc1234", page)

    def test_claims_stand_by_what_they_speak_of_with_where_their_limits_come_from(self):
        claims = [
            verdict("a holds", "PASS", 1.0, "<= 2", "method"),
            verdict("b is open", "INCONCLUSIVE", 1.0, "<= 2", "method"),
            verdict("c fails", "FAIL", 3.0, "<= 2", "method", "twice the bar <of> the reference"),
            verdict("d holds", "PASS", 0.0, "<= 1"),
        ]
        self.edit("verdicts.json", lambda _: json.dumps({"verdicts": claims}))
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        places = [
            page.index(words)
            for words in (
                "The program computes what it says (program)",
                "d holds",
                "The method does what it is for, at this cell, load and strain (method)",
                "c fails",
                "twice the bar &lt;of&gt; the reference",
                "b is open",
                "a holds",
            )
        ]
        self.assertEqual(places, sorted(places))
        self.assertIn(
            (
                "2 of 4 claims hold, 1 fails, 1 is open: program: 1 of 1 claim holds; method: 1 of"
                " 3 claims holds, 1 fails, 1 is open."
            ),
            page,
        )
        self.assertIn("○ open</span>", page)
        self.assertNotIn("? INCONCLUSIVE", page)

    def test_claims_of_another_version_are_refused(self):
        for key in ("kind", "derivation"):
            claim = verdict("a", "PASS")
            del claim[key]
            self.edit("verdicts.json", lambda _, claim=claim: json.dumps({"verdicts": [claim]}))
            self.assert_refused(
                "verdicts.json: verdicts[0] has", "another version of homespun wrote the file"
            )

    def test_interrupted_last_line_is_left_out_and_said(self):
        self.edit(
            "strain.csv", lambda text: text + "stripes,shear-frame,0.2,biot,localized,2,8,32,0.00"
        )
        found = results.read_results([self.folder])
        self.assertEqual(len(found.strain), len(strain_rows()))
        self.assertTrue(any("it has no end of line" in item["why"] for item in found.missing))

    def test_pdf_is_made_where_asked_for_and_never_left_from_an_earlier_page(self):
        def figures(*endings):
            return {
                name
                for name in os.listdir(os.path.join(self.output, "figures"))
                if name.endswith(endings)
            }

        self.remove("forces.csv", "levels.csv", "stripes/cell.h5", "stripes/homogenize.json")
        self.remove("stripes/fields-shear-frame.h5")
        self.edit_table("strain.csv", lambda rows: rows[:2])
        self.assertEqual(self.whole_report(self.folder, "--pdf"), (0, ""))
        drawn = {name.removesuffix(".svg") for name in figures(".svg")}
        self.assertEqual(figures(".pdf"), {f"{name}.pdf" for name in drawn})
        self.assertIn('href="figures/stripes-error-strain.pdf"', self.page())
        self.assertEqual(self.whole_report(), (0, ""))
        self.assertEqual(figures(".pdf"), set())
        self.assertNotIn(".pdf", self.page())

    def test_of_rows_with_the_same_keys_the_last_one_counts(self):
        self.edit_table("strain.csv", lambda rows: rows + [{**rows[0], "error_mean_m": "0.5"}])
        found = results.read_results([self.folder]).strain
        self.assertEqual((len(found), found[0]["error_mean_m"]), (len(strain_rows()), 0.5))

    def test_number_that_is_none_is_refused_with_its_line(self):
        self.edit_table("strain.csv", lambda rows: rows[4].update(strain="one"))
        self.assert_refused(
            "strain.csv, line 6", "`strain` is `one`, expected a number above zero", "--overwrite"
        )

    def test_row_with_a_field_too_few_is_refused_with_its_line(self):
        n_fields = []

        def cut(text):
            n_fields.append(text.splitlines()[0].count(",") + 1)
            return text.replace(",localized,", ",", 1)

        self.edit("strain.csv", cut)
        self.assert_refused(
            "strain.csv, line 3", f"{n_fields[0] - 1} fields, expected {n_fields[0]}"
        )

    def test_wrong_header_is_refused(self):
        self.edit("strain.csv", lambda text: text.replace("error_mean_m", "error", 1))
        self.assert_refused("strain.csv, line 1", "expected the header")

    def test_all_faults_are_named_at_once(self):
        self.edit("study.json", lambda text: text[:40])
        self.edit("stripes/homogenize.json", lambda text: text.replace("299.7", "null"))
        self.edit("verdicts.json", lambda text: text.replace("PASS", "MAYBE"))
        self.assert_refused(
            "study.json, line 1", "not valid JSON", "homogenize.json: key `C`", "verdicts[0]"
        )

    def test_truncated_cell_file_is_refused(self):
        path = os.path.join(self.folder, "stripes", "cell.h5")
        os.truncate(path, os.path.getsize(path) // 2)
        list_again(self.folder)
        self.assert_refused("cell.h5: not a readable HDF5 file")

    def test_history_that_is_none_is_refused(self):
        self.edit("stripes/homogenize.json", lambda text: text.replace('"dofs": 60', '"dofs": -60'))
        self.assert_refused("homogenize.json: key `history`")

    def test_sheet_with_wrong_shape_is_refused_and_nothing_is_written(self):
        self.edit_table("strain.csv", lambda rows: rows[:1])
        with h5py.File(os.path.join(self.folder, "stripes", "fields-shear-frame.h5"), "a") as file:
            del file["upsampled"]
            file["upsampled"] = numpy.zeros((3, 2))
        list_again(self.folder)
        self.assert_refused(
            "fields-shear-frame.h5: `/upsampled` has shape (3, 2), expected (25, 2)"
        )

    def test_link_into_another_file_is_not_followed(self):
        path = os.path.join(self.folder, "stripes", "fields-shear-frame.h5")
        other = os.path.join(self.output + "-other.h5")
        shutil.copy(path, other)
        self.addCleanup(os.remove, other)
        with h5py.File(path, "a") as file:
            del file["upsampled"]
            file["upsampled"] = h5py.ExternalLink(other, "/upsampled")
        list_again(self.folder)
        self.assert_refused("`/upsampled` is a link")

    def test_folder_without_results_is_refused(self):
        shutil.rmtree(self.folder)
        self.assert_refused("no such folder")
        os.makedirs(self.folder)
        self.assert_refused(
            "is not a folder of results of this version: it holds no run.json",
            "run the study again",
        )
        write_run(self.folder, "check")
        self.assert_refused("holds no results that a page shows", "`homespun check`")


class NumbersTest(unittest.TestCase):
    def test_three_digits_in_print(self):
        for value, text in (
            (0.012345, "0.0123"),
            (2839.91, "2840"),
            (1.999, "2.00"),
            (9.996, "10.0"),
            (4.567e-7, "4.57 × 10⁻⁷"),
            (-1.234, "−1.23"),
            (0.0, "0"),
            (float("nan"), "–"),
        ):
            self.assertEqual(style.three(value), text)

    def test_modulus_along_the_axes_is_the_inverse_compliance(self):
        compliance = numpy.linalg.inv(LAMINATE)
        along = directional_modulus(LAMINATE, numpy.array([0.0, numpy.pi / 2.0]))
        numpy.testing.assert_allclose(
            along, [1.0 / compliance[0, 0], 1.0 / compliance[1, 1]], rtol=1e-14
        )

    def test_modulus_turns_with_the_stiffness(self):
        """E(theta) of the material turned by beta is E(theta − beta): catches signs of S16 and S26.
        """
        beta, theta = 0.4, numpy.linspace(0.0, 3.0, 7)
        c, s = numpy.cos(beta), numpy.sin(beta)
        # Strain in the turned axes.
        strain = numpy.array(
            [[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2 * c * s, 2 * c * s, c * c - s * s]]
        )
        turned = strain.T @ LAMINATE @ strain
        numpy.testing.assert_allclose(
            directional_modulus(turned, theta),
            directional_modulus(LAMINATE, theta - beta),
            rtol=1e-12,
        )

    def test_a_group_in_many_directions_is_one_phase(self):
        phases = [
            {"name": name, "angle": angle}
            for name, angle in (("yarn", 15.0), ("ground", 0.0), ("yarn", -30.0), ("yarn", 80.0))
        ]
        cell = Cell("made-up", phases=phases, material=numpy.array([0, 1, 2, 3, 1]))
        share_groups(cell)
        self.assertEqual(cell.material.tolist(), [0, 1, 0, 0, 1])
        self.assertEqual([phase["name"] for phase in cell.phases], ["yarn", "ground"])
        self.assertEqual([row[5] for row in phase_rows(cell)], ["−30.0 to 80.0, 3 directions", "0"])
        self.assertEqual(grouped(cell, numpy.array([3, 1])).tolist(), [0, 1])
        # A file of another cell: left alone.
        self.assertEqual(grouped(cell, numpy.array([4, 1])).tolist(), [4, 1])
        self.assertEqual(grouped(Cell("without"), numpy.array([], dtype=int)).tolist(), [])

    def test_slope_of_a_bracket_is_that_of_its_finer_half(self):
        dofs = numpy.array([10.0, 20.0, 100.0, 200.0, 400.0, 800.0])
        width = numpy.where(dofs < 50.0, 0.5, 3e4 * dofs**-2.0)
        cell = Cell(
            "made-up",
            homogenize={"history": [{"dofs": d, "width": w} for d, w in zip(dofs, width)]},
        )
        self.assertAlmostEqual(observed_slope(bracket_history(cell)), -2.0, places=12)
        self.assertEqual(bracket_history(Cell("without")).shape, (0, 2))

    def test_coarse_motion_is_linear_in_each_triangle(self):
        rest, _, _ = square_mesh(5, 1.0)
        coarse, triangles, _ = square_mesh(2, 1.0)
        motion = numpy.array([[1.1, 0.3], [-0.2, 0.9]])
        sheet = {
            "rest": rest,
            "coarse_rest": coarse,
            "coarse_triangles": triangles,
            "coarse": coarse @ motion.T,
        }
        numpy.testing.assert_allclose(coarse_positions(sheet), rest @ motion.T, atol=1e-14)


if __name__ == "__main__":
    unittest.main()
