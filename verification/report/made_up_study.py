# SPDX-License-Identifier: MIT
"""Made-up results of `homespun strain` and `homespun stress` for the tests of the report."""
import json
import os

import h5py
import numpy

import results
import stress_results

SIDE = 0.01
LAMINATE = numpy.array([[2839.91, 299.7, 0.], [299.7, 999.001, 0.], [0., 0., 349.65]])


def square_mesh(n, size):
    """n x n squares of two triangles over a square; rows of squares alternate between two materials."""
    grid = numpy.linspace(0., size, n + 1)
    vertices = numpy.array([[x, y] for y in grid for x in grid])
    corners = [j * (n + 1) + i for j in range(n) for i in range(n)]
    triangles = numpy.array([t for a in corners for t in ([a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1])])
    material = numpy.array([1 + (j % 2) for j in range(n) for _ in range(2 * n)])
    return vertices, triangles, material


def strain_rows():
    """Rows of strain.csv for one cell: a load with slope 2, one that vanishes, one not reached."""
    rows = []
    for load in ("periodic-22", "shear-frame"):
        for strain in (0.001, 0.01, 0.1):
            for method in ("affine", "localized", "localized-piecewise"):
                error = 0.2 * strain
                if method != "affine":
                    error *= 0. if load == "periodic-22" else 4. * strain
                rows.append(f"stripes,{load},{strain},biot,{method},2,8,32,{error * SIDE},{error * SIDE},"
                            f"{error * SIDE},{error},{error / 0.2 / strain},{1e-4 * strain * SIDE},0.001,1.5")
    rows.append("stripes,shear-frame,0.2,green,unreached,2,8,32,,,nan,,,,,")
    return rows


def write_results(folder):
    """A complete result folder of one cell and a sheet of 2 x 2 cells."""
    os.makedirs(os.path.join(folder, "stripes"))

    def write(name, text):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    write("strain.csv", "\n".join([",".join(results.STRAIN_HEADER)] + strain_rows()) + "\n")
    write("uncertainty.csv", ",".join(results.UNCERTAINTY_HEADER)
          + "\nstripes,shear-frame,biot,0.01,2,1e-6,1.2e-6,2e-7,0.012\n")
    write("steps.csv", ",".join(results.STEPS_HEADER)
          + "\nstripes,shear-frame,biot,0.01,0.002,0.0001,6.5,3,25,578,2\n")
    write("study.json", json.dumps({
        "command": "homespun strain stripes.prm", "cells_per_side": 2, "ranks": 2, "seconds_total": 3.5,
        "peak_memory_bytes": 1e9, "left_out": [{"what": "bending", "why": "the load is in-plane"}],
        "notes": ["a note <of> the study"], "provenance": {"homespun": "0.1.0", "git": "abc1234"}}))
    write("verdicts.json", json.dumps({"verdicts": [
        {"claim": "slope 2", "verdict": "PASS", "value": 2.01, "limit": "2 ± 0.1", "command": "homespun strain"},
        {"claim": "bar", "verdict": "INCONCLUSIVE", "value": None, "limit": "", "command": ""}]}))
    write("stripes/homogenize.json", json.dumps({
        "C": LAMINATE.tolist(), "C_lower": (0.98 * LAMINATE).tolist(), "C_upper": LAMINATE.tolist(),
        "bracket": {"width": 0.02, "remark": "made up"}, "order": 2,
        "history": [{"dofs": n, "width": 320. / n ** 2} for n in (30, 60, 90, 126)], "voigt": (2. * LAMINATE).tolist(),
        "reuss": (0.5 * LAMINATE).tolist(), "area": SIDE ** 2, "areal_density": 0.2,
        "engineering": {"E1": 2750., "E2": 967.}, "dofs": 18, "iterations": [3, 3, 3], "seconds": 0.1,
        "checks": [{"name": "two forms agree", "value": 1e-12, "limit": "1e-9", "verdict": "PASS"}],
        "provenance": "homespun 0.1.0"}))
    write("stripes/cell.json", json.dumps({"name": "stripes", "file": "stripes.prm", "phases": [
        {"name": "hard", "E1": 1e7, "thickness": 5e-4}, {"name": "soft", "E1": 1e6, "thickness": 5e-4}]}))
    vertices, triangles, material = square_mesh(2, SIDE)
    with h5py.File(os.path.join(folder, "stripes", "cell.h5"), "w") as file:
        for key, value in {"vertices": vertices, "triangles": triangles, "material": material,
                           "lattice": SIDE * numpy.eye(2), "C": LAMINATE,
                           "chi": numpy.repeat(0.1 * vertices[:, :, None], 3, axis=2)}.items():
            file[key] = value
    rest, fine, material = square_mesh(4, 2. * SIDE)
    coarse, coarse_triangles, _ = square_mesh(2, 2. * SIDE)
    motion = numpy.array([[1., 0.1], [0., 1.]])
    with h5py.File(os.path.join(folder, "stripes", "fields-shear-frame.h5"), "w") as file:
        for key, value in {"rest": rest, "triangles": fine, "material": material, "reference": rest @ motion.T,
                           "upsampled": rest @ motion.T + 1e-5, "coarse_rest": coarse,
                           "coarse_triangles": coarse_triangles, "coarse": coarse @ motion.T}.items():
            file[key] = value
        file.attrs.update(load="shear-frame", strain=0.1, reference="biot", method="localized")


def write_stress(folder):
    os.makedirs(folder, exist_ok=True)
    rows = ["cell,contrast 1e12,finite C^H,finite C^H,1.5e-13,1e-9,PASS,10,0.2,round-off",
            "cell,\"sliver, 1e-6\",finite C^H,nan,,1e-9,FAIL,10,0.1,round-off",
            "start,flattened to a point,finite or refusal,refusal: triangle 3 is singular,,,PASS,10,0.01,requirement",
            "time step,1 s,energy does not grow,not run,,1e-12,INCONCLUSIVE,0,,theory"]
    with open(os.path.join(folder, "stress.csv"), "w", encoding="utf-8") as file:
        file.write("\n".join([",".join(stress_results.HEADER)] + rows) + "\n")
    rows = [f"contrast,{value},stripes,{order},1200,{iterations},0.01,0.02,3,converged"
            for value, iterations in ((1., 9), (1e6, 14)) for order in (1, 2)]
    rows += ["contrast,1e12,stripes,1,,,,,3,conjugate gradients did not reach 1e-11", "poisson,-0.99,inclusion,2,1200,21,0.01,0.02,3,converged"]
    with open(os.path.join(folder, "solver.csv"), "w", encoding="utf-8") as file:
        file.write("\n".join([",".join(stress_results.SOLVER_HEADER)] + rows) + "\n")
    with open(os.path.join(folder, "verdicts.json"), "w", encoding="utf-8") as file:
        json.dump({"verdicts": [{"claim": "every case ends finite or refused", "verdict": "FAIL", "value": 1,
                                 "limit": "0 cases", "command": "homespun stress"}]}, file)
