# SPDX-License-Identifier: MIT
"""Made-up results of `homespun strain` and `homespun stress` for the tests of the report."""
import json
import os

import h5py
import numpy

from made_up_run import verdict, write_run, write_table, write_verdicts

SIDE = 0.01
LAMINATE = numpy.array([[2839.91, 299.7, 0.0], [299.7, 999.001, 0.0], [0.0, 0.0, 349.65]])


def square_mesh(n, size):
    """n x n squares of two triangles over a square; rows of squares alternate between two
    materials.
    """
    grid = numpy.linspace(0.0, size, n + 1)
    vertices = numpy.array([[x, y] for y in grid for x in grid])
    corners = [j * (n + 1) + i for j in range(n) for i in range(n)]
    triangles = numpy.array(
        [t for a in corners for t in ([a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1])]
    )
    material = numpy.array([1 + (j % 2) for j in range(n) for _ in range(2 * n)])
    return vertices, triangles, material


def strain_rows():
    """Rows of strain.csv for one cell: a load with slope 2, one that vanishes, one not reached."""
    rows = []
    sheet = {"cell": "stripes", "cells": 2, "coarse_triangles": 8, "fine_triangles": 32}
    for load in ("periodic-22", "shear-frame"):
        for strain in (0.001, 0.01, 0.1):
            for method in ("affine", "localized", "localized-micro"):
                error = 0.2 * strain
                if method != "affine":
                    error *= 0.0 if load == "periodic-22" else 4.0 * strain
                rows.append(
                    {
                        **sheet,
                        "load": load,
                        "strain": strain,
                        "reference": "biot",
                        "method": method,
                        "error_mean_m": error * SIDE,
                        "error_rms_m": error * SIDE,
                        "error_max_m": error * SIDE,
                        "error_mean_per_cell": error,
                        "error_mean_per_fluctuation": error / 0.2 / strain,
                        "reference_uncertainty_m": 1e-4 * strain * SIDE,
                        "reference_uncertainty_max_m": 4e-4 * strain * SIDE,
                        "reference_to_refined_m": 7e-5 * strain * SIDE,
                        "error_bar_m": 1e-4 * strain * SIDE,
                        "error_bar_safety": 1.25,
                        "seconds_method": 0.001,
                        "seconds_reference": 1.5,
                    }
                )
    rows.append(
        {**sheet, "load": "shear-frame", "strain": 0.2, "reference": "green", "method": "unreached"}
    )
    return rows


def gain_rows():
    """Rows of gains.csv beside strain_rows(): the coarse cloth of `localized` is the coarse mesh."""
    return [
        {
            "cell": "stripes",
            "load": load,
            "strain": strain,
            "reference": "biot",
            "method": "localized",
            "base": "affine",
            "gain_of_coarse_cloth": 1.0,
            "gain_of_upsampling": gain,
            "gain_total": gain,
        }
        for load in ("periodic-22", "shear-frame")
        for strain in (0.001, 0.01, 0.1)
        for gain in (None if load == "periodic-22" else 0.25 / strain,)
    ]


def force_rows():
    """Rows of forces.csv: of an infinite cloth the coarse force is the resolved one, of a sheet it
    is 2 % more than 1000 N/m times strain, whose bar is 0.5 %; the affine motion takes threefold.
    """
    return [
        {
            "cell": "stripes",
            "load": load,
            "strain": strain,
            "reference": "biot",
            "method": method,
            "force_N": None if load.startswith("periodic") else factor * strain * 1000.0 * 2 * SIDE,
            "force_per_width_N_per_m": factor * strain * 1000.0,
            "reference_uncertainty_N_per_m": 0.005 * strain * 1000.0,
            "travel_m": None if load.startswith("periodic") else strain * 2 * SIDE,
            "stress_11_N_per_m": 0.0,
            "stress_22_N_per_m": factor * strain * 1000.0,
            "stress_12_N_per_m": 0.0,
            "stress_21_N_per_m": 0.0,
        }
        for load, coarse in (("periodic-22", 1.0), ("shear-frame", 1.02))
        for strain in (0.001, 0.01, 0.1)
        for method, factor in (("resolved", 1.0), ("coarse", coarse), ("affine", 3.0))
    ]


def write_results(folder):
    """A complete run of `homespun strain` of one cell and a sheet of 2 x 2 cells."""
    os.makedirs(os.path.join(folder, "stripes"))

    def write(name, text):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    level = {"cell": "stripes", "load": "shear-frame", "reference": "biot", "strain": 0.01}
    write_table(folder, "strain.csv", strain_rows())
    write_table(folder, "gains.csv", gain_rows())
    write_table(folder, "forces.csv", force_rows())
    write_table(
        folder,
        "uncertainty.csv",
        [
            {
                **level,
                "cells": 2,
                "method": "reference",
                "p1_minus_p2_m": 1e-6,
                "p1_minus_refined_p2_m": 1.2e-6,
                "p2_minus_refined_p2_m": 2e-7,
                "uncertainty_per_strain_and_side": 0.012,
                "uncertainty_max_per_strain_and_side": 0.031,
                "force_p1_minus_p2": 0.003,
                "force_p1_minus_refined_p2": 0.0035,
                "force_p2_minus_refined_p2": 0.0005,
                "force_uncertainty": 0.005,
            }
        ],
    )
    write_table(
        folder,
        "levels.csv",
        [
            {
                **level,
                "seconds_coarse_solve": 0.002,
                "seconds_upsample": 0.0001,
                "seconds_fine_step": 6.5,
                "coarse_iterations": 3,
                "fine_iterations": 25,
                "fine_dofs": 578,
                "ranks": 2,
                "fluctuation_m": 2e-5,
                "fluctuation_bar_m": 1e-7,
                "homogenized_law": "biot",
                "reference_stability": "every triangle",
                "seconds_stability": 0.1,
                "seconds_homogenized_sheet": 0.4,
            }
        ],
    )
    write(
        "study.json",
        json.dumps(
            {
                "command": "homespun strain stripes.prm",
                "cells_per_side": 2,
                "ranks": 2,
                "seconds_total": 3.5,
                "peak_memory_bytes": 1e9,
                "left_out": [{"what": "bending", "why": "the load is in-plane"}],
                "notes": ["a note <of> the study"],
                "provenance": {"homespun": "0.2.0", "git": "abc1234"},
            }
        ),
    )
    write_verdicts(
        folder,
        [
            verdict("slope 2", "PASS", 2.01, "2 ± 0.1", "method"),
            verdict("bar", "INCONCLUSIVE", derivation="the bar of the same run", command=""),
        ],
    )
    write(
        "stripes/homogenize.json",
        json.dumps(
            {
                "cell": "stripes",
                "C": LAMINATE.tolist(),
                "C_lower": (0.98 * LAMINATE).tolist(),
                "C_upper": LAMINATE.tolist(),
                "bracket": {"width": 0.02, "remark": "made up"},
                "order": 2,
                "history": [
                    {"dofs": n, "width": 320.0 / n**2, "seconds": 0.1} for n in (30, 60, 90, 126)
                ],
                "voigt": (2.0 * LAMINATE).tolist(),
                "reuss": (0.5 * LAMINATE).tolist(),
                "area": SIDE**2,
                "areal_density": 0.2,
                "engineering": {"E1": 2750.0, "E2": 967.0},
                "dofs": 18,
                "iterations": [3, 3, 3],
                "seconds": 0.1,
                "checks": [
                    {"name": "two forms agree", "value": 1e-12, "limit": "1e-9", "verdict": "PASS"}
                ],
                "provenance": "homespun 0.2.0",
            }
        ),
    )
    write(
        "stripes/cell.json",
        json.dumps(
            {
                "name": "stripes",
                "file": "stripes.prm",
                "phases": [
                    {"name": "hard", "E1": 1e7, "thickness": 5e-4},
                    {"name": "soft", "E1": 1e6, "thickness": 5e-4},
                ],
            }
        ),
    )
    vertices, triangles, material = square_mesh(2, SIDE)
    with h5py.File(os.path.join(folder, "stripes", "cell.h5"), "w") as file:
        for key, value in {
            "vertices": vertices,
            "triangles": triangles,
            "material": material,
            "lattice": SIDE * numpy.eye(2),
            "C": LAMINATE,
            "chi": numpy.repeat(0.1 * vertices[:, :, None], 3, axis=2),
        }.items():
            file[key] = value
    rest, fine, material = square_mesh(4, 2.0 * SIDE)
    coarse, coarse_triangles, _ = square_mesh(2, 2.0 * SIDE)
    motion = numpy.array([[1.0, 0.1], [0.0, 1.0]])
    with h5py.File(os.path.join(folder, "stripes", "fields-shear-frame.h5"), "w") as file:
        for key, value in {
            "rest": rest,
            "triangles": fine,
            "material": material,
            "reference": rest @ motion.T,
            "upsampled": rest @ motion.T + 1e-5,
            "coarse_rest": coarse,
            "coarse_triangles": coarse_triangles,
            "coarse": coarse @ motion.T,
        }.items():
            file[key] = value
        file.attrs.update(load="shear-frame", strain=0.1, reference="biot", method="localized")
    write_run(folder)


def write_stress(folder):
    """A run of `homespun stress`."""
    os.makedirs(folder, exist_ok=True)
    names = ("axis", "of", "reached", "end", "ended_by", "why", "error", "theory")
    rows = [
        ("contrast", "stripes", 1e9, 1e10, "error", "error 2e-06 above 1e-06", 2e-6, 1e11),
        ("triangles", "stripes", 32768, None, "cap", "not more than 1e5 triangles", 1e-12, None),
        ("time step", "scene hang", 0.01, 0.02, "solver", "found no lower potential", None, None),
        ("turned and mirrored", "stripes", 180, None, "ladder", "none is wrong", 1e-15, 180),
        ("density ratio", "hung sheet", None, 10, "error", "error 2 above 1", 2.0, None),
    ]
    write_table(
        folder,
        "limits.csv",
        [
            {
                **dict(zip(names, row)),
                "value_is": "a ratio [-]",
                "limit": 1e-6,
                "criterion": "energy against the closed form",
                "theory_is": "round-off" if row[-1] else "",
                "seconds": 0.1,
            }
            for row in rows
        ],
    )
    names = ("axis", "of", "value", "error", "outcome", "iterations", "dofs")
    write_table(
        folder,
        "stress.csv",
        [
            {**dict(zip(names, row)), "limit": 1e-6, "seconds": 0.02}
            for row in (
                ("contrast", "stripes", 1e9, 1e-9, "right", 14, 1200),
                ("contrast", "stripes", 1e10, 2e-6, "error 2e-06 above 1e-06", 15, 1200),
                ("time step", "scene hang", 0.02, None, "found no lower potential", None, None),
            )
        ],
    )
    write_verdicts(
        folder,
        [
            verdict(
                "contrast of stripes: no answer is wrong up to 1e10", "FAIL", 1, "0",
                command="homespun stress"
            )
        ],
    )
    write_run(folder, "stress")
