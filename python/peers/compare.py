#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The table of peers: other methods than homespun's, trained and tested, beside homespun's own.

    compare.py CELL.prm TABLE.csv FOLDER

CELL.prm has isotropic phases. Training frames are linear sheets of 10 x 10 cells, two opposite
clamps of which move as waves drawn by chance: smooth, 20 of each pair of clamps. Tested are the
loads of sheets, and ten waves more of each pair; what was trained on is never tested. Rows are
added to TABLE.csv, in the place of those of the cell; an error is in 1/1000 of strain x cell side.
"""
import csv
import json
import pathlib
import re
import sys

import homespun
import numpy

from flat import flat
from learned import learned
from pod import modes, pod
from smooth import smooth
from training import equilibrium, stiffness_of, waves

CELLS, N_TRAINING, N_TESTED, SEED = 10, 20, 10, 1
LOADS = ("strip-1", "strip-2", "shear-frame")
METHODS = ("affine", "affine+p2", "localized", "full-micro", "full")
LEVELS = (("linear", 0.01), ("biot", 0.1))
PAIRS = ("left and right", "below and above")  # clamps, by axis
COLUMNS = ("cell", "tested", "law", "strain", "method", "trained_on", "cells_per_side", "error",
           "error_bar", "seconds", "outside_training", "run", "revision")


def phases_of(path):
    """Stiffness of each phase of a cell file, in its order (p,3,3)."""
    text = path.read_text(encoding="utf-8")
    keys = ("Young's modulus", "Poisson's ratio", "Thickness")
    values = [dict(re.findall(r"([\w-]+): ([\d.e+-]+)", re.search(f"set {key} .*", text)[0]))
              for key in keys]
    return numpy.array([stiffness_of(*(float(its[name]) for its in values)) for name in values[0]])


def in_cells(cell, points):
    """Points in lattice vectors."""
    return numpy.linalg.solve(numpy.transpose(cell.lattice), points.T).T


def at_ends(along):
    """Indices of the first and of the last among coordinates."""
    near = 1e-9 * numpy.ptp(along)
    return [numpy.flatnonzero(along < along.min() + near),
            numpy.flatnonzero(along > along.max() - near)]


def frames(run, stiffness, axis, n):
    """Positions of waves of a pair of clamps, coarse (n,k,2) and fine; strains 1e-3."""
    mesh, cell = run.sheet, run.cell
    coarse_place, fine_place = (in_cells(cell, its) for its in (mesh.coarse_rest, mesh.rest))
    centres = numpy.floor(fine_place[mesh.triangles].mean(axis=1) + 1e-9).astype(int)
    part = centres[:, 0] * 10 * CELLS + centres[:, 1]
    coarse_held, fine_held = at_ends(coarse_place[:, axis]), at_ends(fine_place[:, axis])
    coarse_values, fine_values = [], []
    for side, (coarse, fine) in enumerate(zip(coarse_held, fine_held)):
        where = coarse_place[coarse, 1 - axis]
        order = numpy.argsort(where)
        along = (where - where.min()) / numpy.ptp(where)
        values = waves(along, n, [SEED, axis, side])
        coarse_values.append(values)
        fine_values.append(numpy.stack([numpy.stack([numpy.interp(
            fine_place[fine, 1 - axis], where[order], value[order, c]) for c in range(2)], axis=1)
            for value in values]))
    one_part = numpy.zeros(len(mesh.coarse_triangles), dtype=int)
    coarse = equilibrium((mesh.coarse_rest, mesh.coarse_triangles),
                         numpy.broadcast_to(cell.stiffness, (len(one_part), 3, 3)), one_part,
                         numpy.concatenate(coarse_held), numpy.concatenate(coarse_values, axis=1))
    fine = equilibrium((mesh.rest, mesh.triangles), stiffness[mesh.phases], part,
                       numpy.concatenate(fine_held), numpy.concatenate(fine_values, axis=1))
    scale = 1e-3 / numpy.array([strain_of(mesh, moved) for moved in coarse])[:, None, None]
    return mesh.coarse_rest + scale * coarse, mesh.rest + scale * fine


def strain_of(mesh, moved):
    """Of a coarse cloth: the larger principal strain in size, root of its mean square."""
    rest, to = (values[mesh.coarse_triangles] for values in (mesh.coarse_rest, moved))
    gradient = numpy.linalg.solve(rest[:, 1:] - rest[:, :1], to[:, 1:] - to[:, :1])
    principal = numpy.linalg.eigvalsh(0.5 * (gradient + numpy.swapaxes(gradient, 1, 2)))
    area = numpy.abs(numpy.linalg.det(rest[:, 1:] - rest[:, :1]))
    return numpy.sqrt(numpy.average(numpy.abs(principal).max(axis=1)**2, weights=area))


def outside(rest, training, tested):
    """How far the tested positions are from all sums of training frames, relative to how far they
    moved. What was trained on, or its multiple, is refused."""
    moved = (tested - rest).ravel()
    moved = moved / numpy.linalg.norm(moved)
    for one in (training - rest).reshape(len(training), -1):
        if numpy.linalg.norm(moved - one * (one @ moved) / (one @ one)) < 1e-3:
            raise homespun.BadInput("a tested frame is a training frame; expected another")
    basis = modes(rest, training)
    return float(numpy.linalg.norm(moved - basis.T @ (basis @ moved)))


def localized(run):
    """The paper's method, of homespun, in single precision."""
    sheet = homespun.Sheet(run.cell, CELLS, CELLS)
    upsampler = homespun.Upsampler(run.cell, sheet)
    if not numpy.allclose(sheet.vertices, run.rest, rtol=0.0, atol=1e-12):
        raise homespun.BadInput("the vertices of Sheet are not those of the study")

    def method(coarse):
        return upsampler.upsample(numpy.pad(coarse, ((0, 0), (0, 1))))[:, :2]

    return method


def peers(mesh, trained):
    """{(name, trained on): f(coarse) -> fine}."""
    methods = {("flat", ""): flat(mesh), ("smooth", ""): smooth(mesh)}
    for on, (coarse, fine) in trained.items():
        for n in (8, 32):
            methods[f"learned_{n}", on] = learned(mesh, coarse, fine, n)
    return methods


def compare(path, folder):
    """The rows of a cell."""
    run = homespun.study(path, cells=CELLS, loads=LOADS, laws=["linear", "biot"],
                         strains=[0.01, 0.1], methods=METHODS, output=folder / path.stem)
    said = json.loads((run.folder / "run.json").read_text(encoding="utf-8"))
    mesh, side = run.sheet, numpy.sqrt(numpy.linalg.det(run.cell.lattice))
    pairs = [frames(run, phases_of(path), axis, N_TRAINING + N_TESTED) for axis in (0, 1)]
    training = [(coarse[:N_TRAINING], fine[:N_TRAINING]) for coarse, fine in pairs]
    trained = {PAIRS[0]: training[0],
               "both pairs": tuple(numpy.concatenate(both) for both in zip(*training))}
    waves_tested = {pair: list(zip(coarse[N_TRAINING:], fine[N_TRAINING:]))
                    for pair, (coarse, fine) in zip(PAIRS, pairs)}
    waves_away = {(pair, on): numpy.mean([outside(mesh.rest, fine, one) for _, one in tested])
                  for pair, tested in waves_tested.items() for on, (_, fine) in trained.items()}
    nearest = {on: pod(mesh.rest, fine) for on, (_, fine) in trained.items()}
    rows = []

    def add(tested, law, strain, method, on="", away="", error="", bar="", seconds=""):
        rows.append(dict(zip(COLUMNS, (
            path.stem, tested, law, strain, method, on, CELLS, f"{1e3 * error:.5g}",
            bar and f"{1e3 * bar:.3g}", seconds and f"{seconds:.2g}", away and f"{away:.2g}",
            said["fingerprint"], said["revision"]))))

    def add_table(table, name, on=""):
        for row in table[table["method"] == name]:
            level = (row["load"], row["strain"], row["reference"])
            if level[:0:-1] not in LEVELS:
                continue
            unit = row["strain"] * side
            away = outside(mesh.rest, trained[on][1], run.reference(*level)) if on else ""
            add(level[0], level[2], level[1], name, on, away, row["error_mean_m"] / unit,
                row["error_bar_m"] / unit, "" if name == "pod" else row["seconds_method"])

    methods = peers(mesh, trained)
    for name in METHODS:
        add_table(homespun.results(run.folder)["strain"], name)
    for (name, on), method in methods.items():
        add_table(run.judge_method(method, name).rows, name, on)
    for on, its in nearest.items():
        add_table(run.judge({level: its(run.reference(*level)) for level in run.levels},
                            "pod").rows, "pod", on)
    methods["localized", ""] = localized(run)
    for pair, tested in waves_tested.items():
        for (name, on), method in [*methods.items(),
                                   *((("pod", on), None) for on in nearest)]:
            found = [nearest[on](one) if method is None else method(its) for its, one in tested]
            distance = [numpy.linalg.norm(up - one, axis=1).mean() / (1e-3 * side)
                        for up, (_, one) in zip(found, tested)]
            add(f"waves {pair}", "linear", 1e-3, name, on, waves_away.get((pair, on), ""),
                numpy.mean(distance))
    return rows


def main(path, table, folder):
    table = pathlib.Path(table)
    rows = compare(pathlib.Path(path), pathlib.Path(folder))
    if table.exists():
        with open(table, newline="", encoding="utf-8") as file:
            rows += [row for row in csv.DictReader(file) if row["cell"] != rows[0]["cell"]]
    with open(table, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows, key=lambda row: row["cell"]))


if __name__ == "__main__":
    main(*sys.argv[1:])
