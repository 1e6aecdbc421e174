# SPDX-License-Identifier: MIT
"""The library of cells: the list, what `cells make` refuses, what it makes where Gmsh is installed.
"""
import csv
import math
import os
import re
import shutil
import sys
import unittest

from cli import CELLS, LONG, InFolder, run

sys.path.insert(0, str(CELLS))
import weave  # noqa: E402  pylint: disable=wrong-import-position

NAMES = sorted(path.stem for path in CELLS.glob("*.geo"))


def n_triangles(cell):
    """Triangles of a cell, as `homespun check` counts them."""
    return int(re.search(r"(\d+) triangles", run("check", cell).stdout).group(1))


def shape_of(cell):
    """Words and numbers of what `homespun check` says of size, lattice and phases."""
    first, *more = run("check", cell).stdout.splitlines()
    said = " ".join([first[first.index("cell of"):],
                     *(line for line in more if re.match("  (?!warning)", line))])
    parts = said.replace("(", " ").replace(")", " ").replace(",", " ").split()
    is_number = [re.fullmatch(r"-?[\d.]+(e[-+]\d+)?", part) is not None for part in parts]
    return ([part for part, number in zip(parts, is_number) if not number],
            [float(part) for part, number in zip(parts, is_number) if number])


def pulled(bending, pitch, height):
    """The modulus of a plain weave whose two sets of yarns are alike, from the equilibrium of two
    half beams, inclined and clamped where they cross, one pulled with unit force, the other not.
    """
    angle = math.atan2(height, pitch)
    length = math.hypot(pitch, height)
    give = (length / 2) ** 3 / (3 * bending)  # of a cantilever's end, across it
    # Half the force at the crossing, from: what one yarn loses in height the other one gains.
    contact = math.sin(angle) / (2 * math.cos(angle))
    across = math.sin(angle) - contact * math.cos(angle)
    stretch = give * across * math.sin(angle) / (pitch / 2)
    return 1 / pitch / stretch


class Weaves(unittest.TestCase):
    def test_materials_are_those_of_the_formula(self):
        for name in weave.DIVES:
            text = (CELLS / f"{name}.prm").read_text(encoding="utf-8")
            for line in weave.materials(name, **weave.SHIPPED):
                self.assertIn(line, text)

    def test_the_formula_is_the_equilibrium_of_two_bent_yarns(self):
        for seed in range(5):
            cloth = weave.drawn("plain-weave", seed)
            _, thickness, pitch = weave.cross_section(**cloth)
            fibres = cloth["tex"] / 0.17
            bending = fibres * 0.7 * 5e6 * 0.17e-6 ** 2 / (4 * math.pi * 1520)
            self.assertAlmostEqual(weave.crimp_modulus(**cloth) / pulled(bending, pitch, thickness),
                                   1, delta=1e-12)

    def test_drawn_yarns_are_those_of_their_seeds(self):
        with open(CELLS / "drawn_weaves.csv", encoding="utf-8") as table:
            for row in csv.DictReader(table):
                drawn = weave.drawn(row["cell"], int(row["seed"]))
                self.assertEqual({key: float(row[key]) for key in drawn}, drawn)


class WovenStiffness(InFolder):
    def test_a_plain_weave_has_the_modulus_of_its_crimp(self):
        run("homogenize", CELLS / "plain-weave.prm", "--no-bars", "--quiet",
            "--output", self.folder)
        text = (self.folder / "homogenize.json").read_text(encoding="utf-8")
        found = float(re.search(r'"E1[^"]*": ([\d.e+]+)', text).group(1))
        width, thickness, pitch = weave.cross_section(**weave.SHIPPED)
        dive = weave.dive_modulus(**weave.SHIPPED)
        crossing = 0.5 * (weave.SHARE_OF_MODULUS * weave.FIBRE_MODULUS * weave.YARN_DENSITY
                          + weave.ACROSS)
        held = 1 - 0.3 * 0.3 * weave.ACROSS / dive  # a dive that may not become narrower
        # Forces that each yarn carries by itself are in equilibrium; displacements along the yarns
        # that do not vary across are compatible: the two bounds of the energy.
        crossings = 2 * thickness * crossing
        low = 1 / ((pitch - width) / (dive * width * thickness) + 1 / crossings)
        beside = (pitch - width) * thickness * weave.ACROSS / (width * held)
        high = 1 / ((pitch - width) * held / (dive * width * thickness)
                    + 1 / (crossings / (1 - 0.05 ** 2) + beside))
        rounding = 1e-3  # of three digits in the file
        self.assertGreater(found, (1 - rounding) * low)
        self.assertLess(found, (1 + rounding) * high)


class List(unittest.TestCase):
    def test_every_cell_is_sound_and_listed_with_a_line_of_story_and_its_parameters(self):
        lines = run("cells").stdout.splitlines()
        self.assertEqual(len(lines), 3 * len(NAMES))
        for file, story, parameters in zip(lines[::3], lines[1::3], lines[2::3]):
            name = os.path.basename(file)[:-4]
            self.assertIn(name, NAMES)
            self.assertTrue(story.strip().startswith(f"{name}: "), story)
            self.assertRegex(parameters, r"--set \w+ \([\d.]+; [\d.]+ to [\d.]+\)")
        self.assertEqual(run("check", *CELLS.glob("*.prm")).returncode, 0)


class Pictures(InFolder):
    def test_every_cell_is_drawn(self):
        result = run("cells", "--pictures", self.folder / "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in NAMES:
            self.assertIn(b"PNG", (self.folder / "out" / f"{name}.png").read_bytes()[:8])
            self.assertGreater((self.folder / "out" / f"{name}.svg").stat().st_size, 10000)


class Refusals(InFolder):
    def refused(self, *arguments, says, **options):
        result = run("cells", "make", *arguments, "--output", self.folder, **options)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for part in says:
            self.assertIn(part, result.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_cell_that_does_not_exist_is_refused_with_those_that_do(self):
        self.refused("houndstooth", says=["found `houndstooth`", *NAMES])
        self.refused("../cells/twill", says=["expected a shipped cell"])

    def test_all_faults_of_the_settings_come_at_once(self):
        self.refused("random-dots", "--set", "colour=3", "--set", "radius=9", "--set", "seed=1.5",
                     "--set", "h=fine", "--set", "dots", "--set", "radius=0.1", "--set", "h=nan",
                     "--name", "a/b",
                     says=["found `colour=3`; expected a parameter of `random-dots`: seed (1; 1 to "
                           "1000000), dots",
                           "found `radius=9`; expected a number from 0.03 to 0.15",
                           "found `seed=1.5`; expected a whole number from 1 to 1000000",
                           "found `h=fine`; expected a number",
                           "found `dots`; expected `key=value`",
                           "found `radius=0.1`; expected each parameter once",
                           "--name: found `a/b`"])
        self.refused("twill", "--set", "yarn_width=nan",
                     says=["found `yarn_width=nan`; expected a number from 0.3"])

    def test_files_that_exist_are_left_alone(self):
        (self.folder / "twill.prm").write_text("mine", encoding="utf-8")
        result = run("cells", "make", "twill", "--output", self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("twill.prm: exists already", result.stderr)
        self.assertEqual((self.folder / "twill.prm").read_text(encoding="utf-8"), "mine")

    def test_a_missing_gmsh_is_named_with_its_package(self):
        tools = self.folder.parent / (self.folder.name + "-tools")
        tools.mkdir()
        self.addCleanup(shutil.rmtree, tools)
        (tools / "ssh").symlink_to("/bin/true")  # Open MPI does not begin without
        self.refused("twill", says=["install the package gmsh"],
                     env={**os.environ, "PATH": str(tools)})


@unittest.skipUnless(shutil.which("gmsh"), "Gmsh is not installed")
class Making(InFolder):
    def test_a_variant_is_sound_and_its_source_makes_it_again(self):
        result = run("cells", "make", "twill", "--set", "yarn_width=0.4", "--name", "open",
                     "--output", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"open\.prm: sound")
        self.assertIn("holes: 36 % of the area", result.stdout)  # (1 - 0.4)^2
        self.assertEqual({path.name for path in self.folder.iterdir()},
                         {"open.geo", "open.msh", "open.prm"})
        self.assertIn("yarn_width = { 0.4, Min",
                      (self.folder / "open.geo").read_text(encoding="utf-8"))
        self.assertIn("twill, made by homespun: yarn_width = 0.4.",
                      (self.folder / "open.prm").read_text(encoding="utf-8"))

    def test_every_shipped_mesh_is_what_its_source_makes(self):
        for name in NAMES if LONG else ("checkerboard", "twill"):
            result = run("cells", "make", name, "--output", self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            made, shipped = self.folder / f"{name}.prm", CELLS / f"{name}.prm"
            n_made, n_shipped = n_triangles(made), n_triangles(shipped)
            # Versions of Gmsh differ a little.
            self.assertLess(abs(n_made - n_shipped), 0.05 * n_shipped, name)
            words, numbers = shape_of(made)
            self.assertEqual(words, shape_of(shipped)[0], name)
            for one, two in zip(numbers, shape_of(shipped)[1]):
                self.assertAlmostEqual(one, two, delta=2e-3 * abs(two) + 1e-9, msg=name)

    def test_the_seed_decides(self):
        for name, seed in (("one", 3), ("again", 3), ("other", 4)):
            run("cells", "make", "random-dots", "--set", f"seed={seed}", "--name", name, "--output",
                self.folder)
        # Nodes and elements: Gmsh lists the periodic curves after them, in any order.
        meshes = [(self.folder / f"{name}.msh").read_text(encoding="utf-8")
                  for name in ("one", "again", "other")]
        one, again, other = (text.split("$Periodic")[0] for text in meshes)
        self.assertEqual(one, again)
        self.assertNotEqual(one, other)

    def test_values_that_do_not_fit_together_leave_nothing_behind(self):
        result = run("cells", "make", "random-dots", "--set", "dots=60", "--set", "radius=0.15",
                     "--output", self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("of 60 dots found a place", result.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
