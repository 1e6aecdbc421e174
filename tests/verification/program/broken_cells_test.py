# SPDX-License-Identifier: MIT
"""Twenty cells, each broken in its own way: `homespun check` says what is wrong, where, what to do.
"""
import json
import math
import unittest

from cli import InFolder, run

N = 8  # squares along a side of the cell
KEYS = {"Mesh": "cell.msh", "Length unit": "0.01", "Young's modulus": "soft: 1e6, hard: 1e7",
        "Poisson's ratio": "soft: 0.3, hard: 0.3", "Thickness": "soft: 5e-4, hard: 5e-4",
        "Density": "soft: 400, hard: 400"}


class Cell:
    """A unit square of n x n x 2 triangles, the upper half hard, to be broken; its ten lines."""

    def __init__(self, n=N):
        self.keys, self.n = dict(KEYS), n
        self.points = [[i / n, j / n, 0.] for j in range(n + 1) for i in range(n + 1)]
        self.triangles, self.groups = [], []
        for j in range(n):
            for i in range(n):
                a = j * (n + 1) + i
                self.triangles += [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]
                self.groups += [1 if j < n // 2 else 2] * 2

    def square_of(self, triangle):
        """(i, j) of the square that a triangle is half of."""
        return (triangle // 2) % self.n, (triangle // 2) // self.n

    def keep(self, stays):
        """Leaves out the squares (i, j) that do not stay."""
        kept = [t for t in range(len(self.triangles)) if stays(*self.square_of(t))]
        self.triangles = [self.triangles[t] for t in kept]
        self.groups = [self.groups[t] for t in kept]

    def write(self, folder, name="cell"):
        path, keys = folder / f"{name}.prm", {**self.keys}
        keys["Mesh"] = keys["Mesh"].replace("cell.msh", f"{name}.msh")
        path.write_text("".join(f"set {key} = {value}\n" for key, value in keys.items()),
                        encoding="utf-8")
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '2 1 "soft"',
                 '2 2 "hard"', "$EndPhysicalNames", "$Nodes", str(len(self.points))]
        lines += [f"{k} {x!r} {y!r} {z!r}" for k, (x, y, z) in enumerate(self.points, 1)]
        lines += ["$EndNodes", "$Elements", str(len(self.triangles))]
        lines += [f"{t} 2 2 {g} {g} {a + 1} {b + 1} {c + 1}"
                  for t, ((a, b, c), g) in enumerate(zip(self.triangles, self.groups), 1)]
        (folder / f"{name}.msh").write_text("\n".join(lines + ["$EndElements", ""]),
                                            encoding="utf-8")
        return path


def vertex(i, j):
    return j * (N + 1) + i


def ring(i, j):
    """Two rows of squares along the outline."""
    return min(i, j, N - 1 - i, N - 1 - j) < 2


# Each breaks a sound cell.

def floating_island(cell):
    cell.keep(lambda i, j: ring(i, j) or (i, j) == (3, 4))
    # away from the ring's corners by one square: nothing shared
    cell.points = [list(p) for p in cell.points]
    corners = [vertex(3, 4), vertex(4, 4), vertex(4, 5), vertex(3, 5)]
    copies = {}
    for corner in corners:
        x, y, z = cell.points[corner]
        copies[corner] = len(cell.points)
        cell.points.append([0.5 + 0.5 * (x - 0.4375), 0.5 + 0.5 * (y - 0.5625), z])
    for triangle in cell.triangles[:]:
        if all(v in copies for v in triangle):
            triangle[:] = [copies[v] for v in triangle]


def hanging_square(cell):
    cell.keep(lambda i, j: ring(i, j) or (i, j) == (2, 2) or (i, j) == (3, 3))


def not_across_a_period(cell):
    cell.keep(lambda i, j: i != 3)


def unglued_parts(cell):
    first = len(cell.points)
    copy = {vertex(i, N // 2): first + i for i in range(N + 1)}
    cell.points += [list(cell.points[v]) for v in copy]
    cell.triangles = [[copy.get(v, v) for v in t] if g == 2 else t
                      for t, g in zip(cell.triangles, cell.groups)]


def slit(cell):
    """A crack between three squares in the middle, with both banks at the same place."""
    first = len(cell.points)
    copy = {vertex(i, N // 2): first + k for k, i in enumerate((3, 4, 5))}
    cell.points += [list(cell.points[v]) for v in copy]
    cell.triangles = [[copy.get(v, v) for v in t] if g == 2 else t
                      for t, g in zip(cell.triangles, cell.groups)]


def sliver(cell):
    cell.points[vertex(3, 1)][1] = 1e-4


def millimetres(cell):
    cell.points = [[10 * c for c in p] for p in cell.points]
    cell.keys["Length unit"] = "1"


def thick(cell):
    cell.keys["Thickness"] = "soft: 0.5, hard: 0.5"


def megapascals(cell):
    cell.keys["Young's modulus"] = "soft: 1, hard: 10"


def high_contrast(cell):
    cell.keys["Young's modulus"] = "soft: 1e-3, hard: 1e7"


def hopeless_contrast(cell):
    cell.keys["Young's modulus"] = "soft: 1e-9, hard: 1e9"


def sides_apart(cell):
    cell.points[vertex(N, 3)][1] += 0.01


def sides_nearly_apart(cell):
    cell.points[vertex(N, 3)][1] += 2e-8


def unused_phase(cell):
    cell.keys["Young's modulus"] += ", cord: 1e8"


def missing_phase(cell):
    cell.keys["Density"] = "soft: 400"


def thin_stripe(cell):
    cell.groups = [2 if cell.square_of(t)[1] == 4 else 1 for t in range(len(cell.triangles))]


def folded(cell):
    cell.points[vertex(3, 3)][0] += 0.4


def not_flat(cell):
    cell.points[vertex(4, 4)][2] = 0.3


def hole_in_the_outline(cell):
    cell.keep(lambda i, j: not (i == 0 and 3 <= j < 5))
    cell.keys["Lattice vectors"] = "1 0; 0 1"


def negative_energy(cell):
    cell.keys["Poisson's ratio"] = "soft: 0.3, hard: 1.2"


def lattice_of_two(cell):
    cell.keys["Lattice vectors"] = "1 0; 0 2"


def hinges(cell):
    """Two holes that touch in a point."""
    cell.keep(lambda i, j: (i, j) not in ((3, 3), (4, 4)))


ERROR, WARNING = "error", "warning"
# how it is broken: severity, words of the message, whether its place is known
TABLE = {
    floating_island: (ERROR, "a part of 2 triangles", "floats: nothing holds it", True),
    hanging_square: (ERROR, "a part of 2 triangles", "hangs on a single vertex and turns freely",
                     True),
    not_across_a_period: (ERROR, "the mesh falls into 2 pieces", "mesh what connects them", True),
    unglued_parts: (ERROR, "coincide without being one", "BooleanFragments", True),
    slit: (ERROR, "coincide without being one", "merge the points", True),
    sliver: (WARNING, "slivers: triangle", "remesh", True),
    millimetres: (WARNING, "the cell is 10 m wide", "0.001 (millimetres)", False),
    thick: (WARNING, "phase `soft` is 0.5 m thick", "0.5 mm is 5e-4", True),
    megapascals: (WARNING, "phase `soft` has modulus times thickness 0.0005",
                  "In Pa it would be 1e+06", True),
    high_contrast: (WARNING, "the contrast between phases `hard` and `soft`",
                    "make what is nearly void a hole", True),
    hopeless_contrast: (ERROR, "the contrast between phases", "no digit is left", True),
    sides_apart: (ERROR, "has no periodic image; the nearest candidate is vertex", "Periodic Curve",
                  True),
    sides_nearly_apart: (WARNING, "opposite sides match only within the tolerance", "16 digits",
                         True),
    unused_phase: (ERROR, "names the group `cord`", "which no triangle of the mesh has", False),
    missing_phase: (ERROR, "group `hard` of the mesh has no value in key `Density`", "hard: value",
                    False),
    thin_stripe: (WARNING, "phase `hard` has a single element across", "mesh finer there", True),
    folded: (ERROR, "on the same side", "untangle it", True),
    not_flat: (ERROR, "the mesh is not flat: z reaches from 0 to 0.3", "project it", False),
    hole_in_the_outline: (WARNING, "the outline of the mesh cuts holes",
                          "away from where it is drawn", False),
    negative_energy: (ERROR, "has Poisson's ratio 1.2", "strictly between", False),
    lattice_of_two: (ERROR, "the lattice vectors", "mend `Lattice vectors`", False),
    hinges: (WARNING, "parts meet in nothing but vertex", "widen the bridge", True),
}


class BrokenCells(InFolder):
    def findings(self, cell):
        """Exit status, what was printed, and the findings of check.json."""
        path = cell.write(self.folder)
        result = run("check", path, "--output", self.folder / "out")
        self.assertNotIn("terminate called", result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        stored = json.loads((self.folder / "out" / "check.json").read_text())["cells"][0]
        return result, stored["findings"]

    def test_the_cell_that_all_others_are_broken_from_is_sound(self):
        result, findings = self.findings(Cell())
        self.assertEqual((result.returncode, findings), (0, []), result.stdout + result.stderr)
        self.assertTrue((self.folder / "out" / "cell.svg").exists())

    def test_twenty_ways_to_break_a_cell_are_told_with_severity_place_and_remedy(self):
        self.assertGreaterEqual(len(TABLE), 20)
        paths = []
        for breaks in TABLE:
            cell = Cell()
            breaks(cell)
            paths.append(cell.write(self.folder, breaks.__name__))
        all_of_them = run("check", *paths, "--output", self.folder / "out")
        self.assertEqual(all_of_them.returncode, 2)
        stored = json.loads((self.folder / "out" / "check.json").read_text())["cells"]
        self.assertEqual(len(stored), len(TABLE))
        for path, one, (severity, words, more, has_place) in zip(paths, stored, TABLE.values()):
            with self.subTest(path.stem):
                result, findings = run("check", path), one["findings"]
                said = result.stdout + result.stderr
                for mishap in ("terminate called", "Traceback"):
                    self.assertNotIn(mishap, said + all_of_them.stderr)
                matching = [f for f in findings if words in f["what"] + "; " + f["remedy"]]
                self.assertTrue(matching, said)
                finding = matching[0]
                self.assertEqual(finding["severity"], severity, said)
                self.assertIn(more, finding["what"] + "; " + finding["remedy"])
                self.assertIn(finding["what"], said)
                self.assertEqual(finding["point"] is not None, has_place, finding)
                any_error = any(f["severity"] == ERROR for f in findings)
                self.assertEqual(any_error, severity == ERROR, said)
                self.assertEqual(result.returncode, 2 if any_error else 0, said)

    def test_a_cell_that_is_stiffer_in_folds_than_its_bending_stiffness_says_is_warned_of(self):
        # The radius goes as side^2 over thickness: 1 cm needs 2.3 cm, 2 cm more than 5.
        cell = Cell()
        cell.keys["Length unit"] = "0.02"
        result, findings = self.findings(cell)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([finding["kind"] for finding in findings], ["folds"])
        self.assertIn("cloth folds more tightly than that", result.stdout)
        cell.keys["Thickness"] = "soft: 1e-3, hard: 1e-3"
        self.assertEqual(self.findings(cell)[1], [])

    def test_how_a_large_cell_folds_is_left_to_a_command_that_solves(self):
        cell = Cell()
        cell.keys["Length unit"] = "0.02"
        fine = 7 * N  # 6,272 triangles
        cell.points = [[i / fine, j / fine, 0.] for j in range(fine + 1) for i in range(fine + 1)]
        corners = [j * (fine + 1) + i for j in range(fine) for i in range(fine)]
        cell.triangles = [half for a in corners
                          for half in ([a, a + 1, a + fine + 2], [a, a + fine + 2, a + fine + 1])]
        cell.groups = [1 if k < fine * fine else 2 for k in range(2 * fine * fine)]
        result, findings = self.findings(cell)
        self.assertEqual((result.returncode, findings), (0, []), result.stderr)
        self.assertIn("`homespun homogenize` tells from which radius on D^H holds", result.stdout)

    def test_the_lattice_of_a_hexagon_is_found_from_its_outline(self):
        cell = Cell()
        corner = [[math.cos(k * math.pi / 3), math.sin(k * math.pi / 3), 0.] for k in range(6)]
        middle = [[0.5 * (a + b) for a, b in zip(corner[k], corner[(k + 1) % 6])] for k in range(6)]
        cell.points = [[0., 0., 0.], *corner, *middle,
                       *[[0.5 * x, 0.5 * y, 0.] for x, y, _ in corner]]
        cell.triangles, cell.groups = [], []
        for k in range(6):
            here, side, inner = 1 + k, 7 + k, 13 + k
            after, inner_after = 1 + (k + 1) % 6, 13 + (k + 1) % 6
            cell.triangles += [[0, inner, inner_after], [inner, here, side],
                               [inner, side, inner_after], [inner_after, side, after]]
            cell.groups += [2, 1, 1, 1]
        path = cell.write(self.folder)
        result = run("check", path)
        self.assertEqual(result.returncode, 0, result.stderr)
        # |Y| of a hexagon of side 1 cm is 3/2 sqrt(3) cm^2.
        self.assertIn("|Y| = 0.000259808 m^2", result.stdout)
        path.write_text(path.read_text() +
                        "set Lattice vectors = 1.5 0.8660254037844386; 0 1.7320508075688772\n")
        self.assertEqual(run("check", path).returncode, 0)

    def test_a_place_is_in_the_unit_of_the_mesh_and_in_the_picture(self):
        cell = Cell()
        sides_apart(cell)
        _, findings = self.findings(cell)
        places = [f["point"] for f in findings if f["point"]]
        self.assertTrue(any(abs(x - 1) < 1e-9 and abs(y - (3 / N + 0.01)) < 1e-9
                            for x, y in places), places)
        self.assertIn(b"PNG", (self.folder / "out" / "cell.png").read_bytes()[:8])

    def test_what_cannot_be_solved_is_refused_by_the_commands_that_solve(self):
        for breaks, (severity, words, _, _) in TABLE.items():
            if severity == WARNING:
                continue
            with self.subTest(breaks.__name__):
                cell = Cell()
                breaks(cell)
                result = run("homogenize", cell.write(self.folder), "--output", self.folder / "out")
                self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
                if breaks is not unglued_parts:  # told there by what has no image
                    self.assertIn(words, result.stderr)
                self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
