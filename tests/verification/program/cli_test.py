# SPDX-License-Identifier: MIT
"""The program as a user meets it: help, results, and what it says to broken input."""
import json
import math
import os
import tempfile
import unittest

import h5py

from cli import CELLS, LAYERED, THREE, InFolder, rows_of, run


class Help(unittest.TestCase):
    def test_help_names_the_commands_and_the_exit_status(self):
        text = run("--help").stdout
        for word in ("check", "homogenize", "strain", "converge", "drape", "stress", "verify",
                     "periodic", "report", "cells", "judge", "bend", "Exit status"):
            self.assertIn(word, text)

    def test_every_command_has_help(self):
        for command in ("check", "homogenize", "strain", "converge", "drape", "stress", "verify",
                        "periodic", "report", "cells", "judge", "bend"):
            result = run(command, "--help")
            self.assertEqual(result.returncode, 0)
            self.assertIn(command, result.stdout)

    def test_version_names_every_library(self):
        text = run("--version").stdout
        for word in ("homespun", "dealii", "trilinos", "hdf5", "eigen", "CLI11", "nlohmann-json",
                     "flags"):
            self.assertIn(word, text)
        self.assertRegex(text, r"(?m)^blas .*(OpenBLAS .*, \d+ threads?|/.*)$")

    def test_what_solves_nothing_starts_no_mpi(self):
        without = dict(os.environ, OMPI_MCA_pml="absent")  # with which MPI does not start
        cell = LAYERED
        with tempfile.TemporaryDirectory() as folder:
            self.assertNotEqual(run("homogenize", cell, "--no-bars", "--output", folder + "/cell",
                                    env=without).returncode, 0)
            for command in (("--version",), ("--help",), ("homogenize", "--help"), ("cells",),
                            ("check", cell), ("check", cell, "--output", folder + "/check")):
                result = run(*command, env=without)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertTrue(result.stdout)
            self.assertEqual(run("report", folder + "/absent", env=without).returncode, 2)

    def test_an_unknown_command_or_option_is_bad_input(self):
        self.assertEqual(run("knit").returncode, 2)
        self.assertEqual(run("check", "--purl", LAYERED).returncode, 2)
        self.assertEqual(run().returncode, 2)

    def test_the_shipped_cells_are_listed_and_sound(self):
        listing = run("cells").stdout
        for name in ("layered", "three-stiffness"):
            self.assertIn(name, listing)
            self.assertEqual(run("check", CELLS / f"{name}.prm").returncode, 0)


class Verify(InFolder):
    def test_a_cell_that_cannot_be_read_fails_on_the_first_line_before_anything_runs(self):
        path = self.cell_with("soft: 0.3", "soft: 1.0")
        result = run("verify", LAYERED, path, "--output", self.folder / "out")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stdout.splitlines()[0], "^FAIL: .*Poisson's ratio 1")
        self.assertFalse((self.folder / "out").exists())

    def test_one_part_of_one_cell_ends_with_its_outcome_and_one_file_of_claims(self):
        result = run("verify", LAYERED, "--parts", "homogenize", "--no-report",
                     "--output", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"^PASS: (\d+) of \1 claims hold\n")
        claims = json.loads((self.folder / "verdicts.json").read_text())["verdicts"]
        self.assertTrue(all(claim["claim"].startswith("homogenize cells/layered: ")
                            for claim in claims))
        self.assertTrue((self.folder / "cells" / "layered" / "homogenize.json").exists())

    def test_without_a_cell_only_self_tests_can_be_asked_for(self):
        result = run("verify", "--parts", "strain", "--output", self.folder / "out")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--parts: strain needs a cell", result.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_an_unknown_part_is_refused(self):
        result = run("verify", LAYERED, "--parts", "weave", "--output", self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("--parts: found `weave`; expected homogenize", result.stderr)


class Homogenize(InFolder):
    def test_results_have_the_names_that_other_programs_read(self):
        result = run("homogenize", LAYERED, "--output", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        found = json.loads((self.folder / "homogenize.json").read_text())
        self.assertEqual(found["C_bar"], "bracket")
        self.assertIsNone(found["C_uncertainty"])
        for key in ("C", "C_lower", "C_upper", "bracket_of", "geometry", "voigt", "reuss", "area",
                    "areal_density", "engineering", "dofs", "iterations", "seconds", "checks",
                    "provenance"):
            self.assertIn(key, found)
        # 500 N/m x (E = 1, 10; unit thickness)
        self.assertAlmostEqual(found["C"][0][0], 500 * 5.67982018, delta=1e-5)
        self.assertAlmostEqual(found["C"][1][1], 500 * 1.99800200, delta=1e-5)
        self.assertAlmostEqual(found["C"][2][2], 500 * 0.699300699, delta=1e-6)
        self.assertEqual({check["verdict"] for check in found["checks"]}, {"PASS"})
        self.assertEqual(found["bracket_of"], "mesh")
        self.assertIsNone(found["geometry"])
        self.assertIn("Bracket of the mesh", result.stdout)
        self.assertTrue((self.folder / "cell.h5").exists())
        self.assertIn(b"chi_12", (self.folder / "characteristic-displacements.vtu").read_bytes())

    def test_the_bracket_of_a_laminate_closes_and_holds_its_exact_stiffness(self):
        result = run("homogenize", LAYERED, "--order", "1", "--output", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("relative width", result.stdout)
        found = json.loads((self.folder / "homogenize.json").read_text())
        self.assertLess(found["bracket"]["width"], 1e-9)
        self.assertGreaterEqual(found["bracket"]["width"], found["bracket"]["round_off"])
        self.assertEqual(len(found["history"]), 1)
        self.assertLessEqual(found["C_lower"][1][1], 500 * 1.998001998001998)
        self.assertGreaterEqual(found["C_upper"][1][1], 500 * 1.998001998001998)

    def test_a_width_that_is_not_reached_fails_and_one_that_is_passes(self):
        cell = THREE
        result = run("homogenize", cell, "--tolerance", "1e-6", "--max-dofs", "5000", "--output",
                     self.folder)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("raise --max-dofs", result.stdout)
        again = run("homogenize", cell, "--tolerance", "6e-4", "--output", self.folder,
                    "--overwrite")
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        history = json.loads((self.folder / "homogenize.json").read_text())["history"]
        self.assertGreater(len(history), 1)
        self.assertLess(history[-1]["width"], 6e-4)
        self.assertLess(history[0]["dofs"], history[-1]["dofs"])
        result = run("homogenize", cell, "--tolerance", "6e-4", "--no-bars", "--output",
                     self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr,
                         "--no-bars excludes --tolerance|--tolerance excludes --no-bars")

    def test_bending_stands_between_its_sides_beside_what_the_inputs_are_worth(self):
        result = run("homogenize", LAYERED, "--uncertain",
                     "soft.E=20%,hard.E=20%", "--output", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        found = json.loads((self.folder / "homogenize.json").read_text())
        # t^3/12 of E = 1 and 10 MPa at nu = 0.3: D22 harmonic, D66 arithmetic.
        t3 = 5e-4**3 / 12
        D22, D66 = 2e7 / 11 / 0.91 * t3, 5.5e6 / 2.6 * t3
        for key in ("D", "D_lower", "D_upper"):
            self.assertAlmostEqual(found[key][1][1] / D22, 1, delta=1e-9)
            self.assertAlmostEqual(found[key][2][2] / D66, 1, delta=1e-9)
        self.assertLess(found["bending_bracket"]["width"], 1e-9)
        self.assertLess(found["bending_moduli_bars"]["strip_2"], 1e-8 * D22)
        # Moduli scale stiffness: with both at 20 % all entries move by 20 %.
        for key in ("C", "D"):
            for i in range(3):
                self.assertAlmostEqual(found["input_bars"][key][i][i] / found[key][i][i], 0.2,
                                       delta=1e-9)
        self.assertEqual({row["phase"] + "." + row["constant"] for row in found["sensitivity"]},
                         {phase + "." + name for phase in ("soft", "hard")
                          for name in ("E", "nu", "thickness")})
        self.assertIn("D^H [1e-6 N m]", result.stdout)
        # At 45 deg phi K11 stretches stripes by Q / D = 1.10 % of (3 cm)^2, in closed form.
        rolled = dict(zip(found["rolled"]["degrees_from_x"], found["rolled"]["least_radius_m"]))
        self.assertAlmostEqual(0.5 * (rolled[44] + rolled[46]),
                               0.03 * math.sqrt(0.01102 / 0.02), delta=1e-4)
        self.assertIn(found["rolled"]["says"], result.stdout)
        # On ever tighter rolls: D^H across the stripes, the plain mean at 45 deg.
        limits = {tuple(one["ruling"]): one["most_stiffening"]
                  for one in found["rolled"]["isometric"]}
        self.assertAlmostEqual(limits[1, 0], 1., delta=1e-9)
        self.assertAlmostEqual(limits[1, 1], 1.394, delta=5e-4)
        self.assertIn("bending without stretching", found["rolled"]["says"])
        with h5py.File(self.folder / "cell.h5") as cell:
            self.assertAlmostEqual(cell["D"][1][1] / D22, 1, delta=1e-9)
            self.assertEqual(cell["deflection"].shape, (len(cell["vertices"]), 3))
            self.assertEqual(cell["deflection"].attrs["unit"], b"m^2")
        for name in ("abaqus.inp", "code_aster.comm"):
            self.assertTrue((self.folder / f"shell-section-{name}").exists())
        result = run("homogenize", LAYERED, "--uncertain", "sfot.E=20%", "--output",
                     self.folder / "misspelt")
        self.assertEqual(result.returncode, 2)
        self.assertIn("names the phase `sfot`", result.stderr)

    def test_every_check_says_of_whom_it_speaks_and_where_its_limit_comes_from(self):
        result = run("homogenize", CELLS / "layered.prm", "--max-dofs", "100", "--output",
                     self.folder)
        # What --max-dofs leaves out is said and not claimed.
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("raise --max-dofs", result.stdout)
        found = json.loads((self.folder / "homogenize.json").read_text())
        self.assertIn("raise --max-dofs", found["bracket"]["remark"])
        self.assertRegex(found["bracket"]["remark"], r"2880 DoFs on this mesh, more than 100, "
                                                     r"which is about \S+ s and \S+ GB:")
        # The finer solve is the bar of a cell without a bracket.
        self.assertIsNotNone(found["C_uncertainty"])
        self.assertEqual(len(found["checks"]), 6)
        for check in found["checks"]:
            self.assertEqual(sorted(check), ["derivation", "id", "kind", "limit", "name", "value",
                                             "verdict"])
            self.assertEqual(check["kind"], "program")
            self.assertTrue(check["derivation"])


    def test_a_drawing_has_its_own_bracket_and_a_polygon_in_its_place_is_called_faceted(self):
        cell = CELLS / "hexagonal-dots.prm"
        result = run("homogenize", cell, "--tolerance", "5e-4", "--output", self.folder / "drawn")
        self.assertEqual(result.returncode, 0, result.stderr)
        for text in ("C^H of the drawing", "Bracket of the drawing, C_lower",
                     "C of the straight triangles"):
            self.assertIn(text, result.stdout)
        self.assertNotIn("faceted", result.stdout)
        text_of_drawn = result.stdout
        drawn = json.loads((self.folder / "drawn" / "homogenize.json").read_text())
        self.assertEqual(drawn["bracket_of"], "drawing")
        self.assertIsNone(drawn["geometry"])
        # The same triangles with straight sides.
        mesh = (CELLS / "hexagonal-dots.msh").read_text().split("$Elements\n")
        lines, straight = mesh[1].split("\n"), []
        for line in lines:
            words = line.split()
            if len(words) == 4 and words[2] == "9":
                line = f"{words[0]} {words[1]} 2 {words[3]}"
            straight.append(" ".join(words[:4]) if len(words) == 7 else line)
        (self.folder / "faceted.msh").write_text(mesh[0] + "$Elements\n" + "\n".join(straight))
        (self.folder / "faceted.prm").write_text(cell.read_text().replace("hexagonal-dots.msh",
                                                                          "faceted.msh"))
        result = run("check", self.folder / "faceted.prm")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout,
                         "warning: .*the outline of phase `dot` is faceted: 42 of its sides")
        result = run("homogenize", self.folder / "faceted.prm", "--output", self.folder / "faceted")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Bracket of the mesh", result.stdout)
        self.assertIn("geometry (an estimate, in no bar)", result.stdout)
        faceted = json.loads((self.folder / "faceted" / "homogenize.json").read_text())
        self.assertEqual(faceted["bracket_of"], "mesh")
        # All but brackets and the mass is that of the straight triangles; the mass is of circles.
        self.assertEqual(faceted["C"], drawn["C"])
        density = 0.12 + 0.24 * math.pi * 0.28**2 / math.sqrt(0.75)
        self.assertAlmostEqual(drawn["areal_density"] / density, 1, delta=1e-5)
        self.assertLess(faceted["areal_density"] / density, 1 - 1e-3)
        self.assertIn(f"; {density:.4g} kg/m^2", text_of_drawn)
        self.assertIn(f"{density:.6g} kg/m^2 between curved sides", run("check", cell).stdout)
        self.assertEqual(faceted["geometry"]["faceted_sides"], 42)
        # The estimate brings C to within the drawing's bracket and what P2 leaves on these
        # triangles.
        arcs = faceted["C"][0][0] + faceted["geometry"]["C_change"][0][0]
        middle = 0.5 * (drawn["C_lower"][0][0] + drawn["C_upper"][0][0])
        self.assertLess(abs(arcs - middle), 0.3 * abs(faceted["C"][0][0] - middle))


class BadInput(InFolder):
    def refused(self, *arguments, says):
        result = run(*arguments)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for part in says:
            self.assertIn(part, result.stderr)
        self.assertNotIn("terminate called", result.stderr)

    def test_a_missing_file_is_named(self):
        for command in ("check", "homogenize", "strain"):
            self.refused(command, self.folder / "none.prm", says=["none.prm: no such file"])

    def test_all_faults_come_at_once(self):
        cell = self.cell_with("soft: 1e6, hard: 1e7", "soft: -1e6")
        self.refused("check", cell, says=["Young's modulus -1e+06 Pa", "group `hard`"])

    def test_poissons_ratio_of_one_is_refused_and_half_is_not(self):
        self.refused("check", self.cell_with("soft: 0.3", "soft: 1"), says=["Poisson's ratio 1"])
        self.assertEqual(run("check", self.cell_with("soft: 0.3", "soft: 0.5")).returncode, 0)

    def test_a_truncated_mesh_is_refused_and_leaves_nothing_behind(self):
        cell = self.cell_with("soft", "soft")
        mesh = self.folder / "layered.msh"
        mesh.write_bytes(mesh.read_bytes()[:-500])
        output = self.folder / "out"
        self.refused("homogenize", cell, "--output", output, says=["layered.msh: cannot be read"])
        self.refused("strain", cell, "--quick", "--output", output,
                     says=["layered.msh: cannot be read"])
        self.assertFalse(output.exists())

    def test_unknown_loads_methods_and_strains_are_refused_together(self):
        self.refused("strain", LAYERED, "--loads", "strip-3", "--methods", "magic",
                     "--references", "hooke", "--strains", "0.1,-2",
                     says=["`strip-3`", "`magic`", "`hooke`", "-2"])

    def test_methods_are_read_in_any_order_and_old_names_are_told_once(self):
        study = ["strain", LAYERED, "--quick", "--loads", "strip-1", "--references",
                 "linear", "--strains", "0.01", "--cells", "2", "--no-budget", "--no-runtime",
                 "--no-report", "--output", self.folder / "run"]
        result = run(*study, "--methods", "localized,p2,localized+edges+p2,full,full-fitted",
                     ranks=2)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        self.assertEqual(result.stderr.count("`p2` is called `localized+p2` since 0.2.0"), 1,
                         result.stderr)
        self.assertEqual({row["method"] for row in rows_of(self.folder / "run" / "strain.csv")},
                         {"localized", "localized+p2", "full"})
        for methods, words in (("full,localized+micro+p2", "localized has the term micro already"),
                               ("full,full-cubic-cubic", "the term cubic is there twice"),
                               ("localized+curved", "the term curved does nothing here"),
                               ("localized+p2,full-edges-cubic-modes",
                                "`full-edges-cubic-modes` has the terms of `localized+p2`")):
            self.refused(*study, "--methods", methods, says=[words])

    def test_an_output_that_cannot_be_written_is_named(self):
        for ranks in (1, 2):
            result = run("homogenize", LAYERED, "--quiet", "--output",
                         "/proc/nowhere", ranks=ranks)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn("/proc/nowhere", result.stderr)
            self.assertNotIn("terminate called", result.stderr)

    def test_a_length_with_its_unit_is_refused_in_one_line(self):
        cell = self.cell_with("= 0.01", "= 1 cm")
        result = run("check", cell)
        self.assertEqual(result.returncode, 2)
        self.assertIn("key `Length unit`: found `1 cm`", result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1)

    def test_left_handed_lattice_vectors_are_refused(self):
        self.refused("check", self.cell_with("= auto", "= 0 1; 1 0"), says=["exchange the two"])

    def test_a_name_that_breaks_a_table_is_refused(self):
        cell = self.cell_with("soft", "soft")
        self.refused("strain", cell.rename(self.folder / "a,b.prm"), "--output",
                     self.folder / "out", says=["comma"])

    def test_options_with_lists_leave_the_cell_alone(self):
        self.refused("strain", "--strains", "0.01", self.folder / "none.prm",
                     says=["none.prm: no such file"])

    def test_two_cells_of_one_name_are_refused(self):
        self.refused("strain", LAYERED, self.cell_with("soft", "soft"), "--output",
                     self.folder / "out", says=["rename one"])


if __name__ == "__main__":
    unittest.main()
