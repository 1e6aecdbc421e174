# SPDX-License-Identifier: MIT
"""Cells whose effective stiffness is known, on n x n squares of two triangles each.

`laminate`: half and half, contrast 10: closed form, which P1 reproduces to round-off.
`inclusion`: a square of a quarter of the area, contrast 100: singular at its corners; known from a
narrow guaranteed bracket.
`checkerboard`: shear moduli 1 and 10 with one area bulk modulus K: of the three moduli of C^H one
is K itself, and the other two obey a relation of duality (duality_gap()); known from a narrow
bracket.
"""
import dataclasses

import numpy

LENGTH = 0.01  # side of the cell [m]
THICKNESS = 1e-3  # [m]


@dataclasses.dataclass
class Phase:
    name: str
    young: float  # [Pa]
    poisson: float

    def stiffness(self):
        """Plane stress times the thickness, Voigt order with engineering shear (3, 3) [N/m]."""
        factor = THICKNESS * self.young / (1 - self.poisson**2)
        return factor * numpy.array(
            [[1, self.poisson, 0], [self.poisson, 1, 0], [0, 0, (1 - self.poisson) / 2]]
        )


def phase_of_moduli(name, bulk, shear):
    """The phase of an area bulk modulus and a shear modulus [Pa]: E = 4 K G / (K + G)."""
    return Phase(name, 4 * bulk * shear / (bulk + shear), (bulk - shear) / (bulk + shear))


BULK = 2.5e6  # of both phases of the checkerboard [Pa]
SHEAR = (1e6, 1e7)

PHASES = {
    "laminate": (Phase("soft", 1e6, 0.3), Phase("hard", 1e7, 0.3)),
    "inclusion": (Phase("soft", 1e6, 0.3), Phase("hard", 1e8, 0.3)),
    "inclusion-10": (Phase("soft", 1e6, 0.3), Phase("hard", 1e7, 0.3)),
    "checkerboard": (
        phase_of_moduli("soft", BULK, SHEAR[0]),
        phase_of_moduli("hard", BULK, SHEAR[1]),
    ),
}


def is_hard(name, x, y):
    """Where the hard phase lies, of centres in cell sides."""
    if name == "laminate":
        return y > 0.5
    if name == "checkerboard":
        return (x > 0.5) == (y > 0.5)
    return (abs(x - 0.5) < 0.25) & (abs(y - 0.5) < 0.25)


@dataclasses.dataclass
class Cell:
    name: str
    vertices: numpy.ndarray  # (n, 2) [m]
    triangles: numpy.ndarray  # (m, 3)
    material: numpy.ndarray  # (m)

    @property
    def stiffness(self):
        """Of the phases (2, 3, 3) [N/m]."""
        return numpy.array([phase.stiffness() for phase in PHASES[self.name]])


def make_cell(name, n):
    """`n` squares along a side, a multiple of 4, so that triangles lie within one phase."""
    if n % 4:
        raise ValueError(f"found {n} squares along a side; expected a multiple of 4")
    side = numpy.linspace(0, LENGTH, n + 1)
    vertices = numpy.stack(numpy.meshgrid(side, side, indexing="ij"), axis=-1).reshape(-1, 2)
    column, row = (k.ravel() for k in numpy.meshgrid(range(n), range(n), indexing="ij"))
    corner = column * (n + 1) + row
    triangles = numpy.concatenate(
        [
            numpy.stack([corner, corner + n + 1, corner + n + 2], axis=1),
            numpy.stack([corner, corner + n + 2, corner + 1], axis=1),
        ]
    )
    centre = (numpy.stack([column, row], axis=1) + 0.5) / n
    hard = is_hard(name, centre[:, 0], centre[:, 1]).astype(int)
    return Cell(name, vertices, triangles, numpy.concatenate([hard, hard]))


def write_cell_file(cell, path):
    """`path`.prm and `path`.msh, for homespun."""
    n_vertices, n_triangles = len(cell.vertices), len(cell.triangles)
    with open(f"{path}.msh", "w", encoding="utf-8") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
        out.write('$PhysicalNames\n2\n2 1 "soft"\n2 2 "hard"\n$EndPhysicalNames\n')
        out.write(f"$Nodes\n{n_vertices}\n")
        out.writelines(
            f"{k} {x!r} {y!r} 0\n" for k, (x, y) in enumerate(cell.vertices.tolist(), start=1)
        )
        out.write(f"$EndNodes\n$Elements\n{n_triangles}\n")
        out.writelines(
            f"{k} 2 2 {group} {group} {a} {b} {c}\n"
            for k, (group, a, b, c) in enumerate(
                zip((cell.material + 1).tolist(), *(cell.triangles.T + 1).tolist()), start=1
            )
        )
        out.write("$EndElements\n")
    soft, hard = PHASES[cell.name]
    with open(f"{path}.prm", "w", encoding="utf-8") as out:
        out.write(
            f"set Mesh = {path.name}.msh\nset Length unit = 1\n"
            f"set Young's modulus = soft: {soft.young!r}, hard: {hard.young!r}\n"
            f"set Poisson's ratio = soft: {soft.poisson!r}, hard: {hard.poisson!r}\n"
            f"set Thickness = soft: {THICKNESS!r}, hard: {THICKNESS!r}\n"
            "set Density = soft: 400, hard: 400\n"
        )


def laminate_stiffness():
    """C^H of the laminate (3, 3) [N/m], layers stacked along axis 2."""
    c = numpy.array([phase.stiffness() for phase in PHASES["laminate"]])
    c11, c12, c22, c66 = c[:, 0, 0], c[:, 0, 1], c[:, 1, 1], c[:, 2, 2]
    harmonic = 1 / (1 / c22).mean()
    ratio = (c12 / c22).mean()
    return numpy.array(
        [
            [(c11 - c12**2 / c22).mean() + ratio**2 * harmonic, ratio * harmonic, 0],
            [ratio * harmonic, harmonic, 0],
            [0, 0, 1 / (1 / c66).mean()],
        ]
    )


def duality_gap(stiffness):
    """What C^H of the checkerboard misses of its two exact relations, relative.

    K of all phases is K of the whole. In the plane, compliances 1/(2K) and 1/(2G) may be moved by
    one constant against each other (Cherkaev, Lurie, Milton 1992); with 1/(2K) moved to zero the
    phases are incompressible, and there Airy's function of one medium is the stream function of the
    medium of 1/G, with both modes of shear exchanged. The board with its phases exchanged is the
    board moved, so that the moved shear moduli g of diagonal and of straight shear have
    g_diagonal g_straight = g_soft g_hard.
    """
    def moved(shear):
        return 1 / (1 / shear + 1 / BULK)

    bulk = (stiffness[0, 0] + stiffness[0, 1]) / 2 / THICKNESS
    diagonal = (stiffness[0, 0] - stiffness[0, 1]) / 2 / THICKNESS
    straight = stiffness[2, 2] / THICKNESS
    product = moved(diagonal) * moved(straight) / (moved(SHEAR[0]) * moved(SHEAR[1]))
    return abs(bulk / BULK - 1), abs(product - 1)


def energy_error(stiffness, answer):
    """The largest relative difference of an energy: max over E of |E.(C - A).E| / E.A.E."""
    root = numpy.linalg.cholesky(answer)
    inverse = numpy.linalg.inv(root)
    difference = inverse @ (stiffness - answer) @ inverse.T
    return abs(numpy.linalg.eigvalsh((difference + difference.T) / 2)).max()
