# SPDX-License-Identifier: MIT
"""CSV tables of the pictures of a cell: its triangles with their phases, its characteristic
displacements.
"""


def cell_table(cell):
    """(header, rows): the corners of each triangle [m] and the number of its phase."""
    header = ["triangle", "phase"] + [f"{axis}{corner}_m" for corner in (1, 2, 3) for axis in "xy"]
    places = cell.vertices[cell.triangles].reshape(-1, 6)
    return header, [
        [i, int(phase), *place] for i, (phase, place) in enumerate(zip(cell.material, places))
    ]


def chi_table(cell):
    """(header, rows): each vertex [m] and chi of the three unit strains there [m]."""
    header = ["vertex", "x_m", "y_m"] + [
        f"chi_{strain}_{axis}_m" for strain in ("11", "22", "12") for axis in "xy"
    ]
    return header, [
        [i, *place, *chi.T.reshape(-1)]
        for i, (place, chi) in enumerate(zip(cell.vertices, cell.chi))
    ]


def deflection_table(cell):
    """(header, rows): each vertex [m] and the deflections of the three unit curvatures [m^2]."""
    header = ["vertex", "x_m", "y_m"] + [f"w_{curvature}_m2" for curvature in ("11", "22", "12")]
    return header, [
        [i, *place, *w] for i, (place, w) in enumerate(zip(cell.vertices, cell.deflection))
    ]
