# SPDX-License-Identifier: MIT
"""Made-up results of `homespun drape` for the tests of the report: a cloth that swings down on an
edge.
"""
import json
import os

import numpy

from made_up_run import verdict, write_run, write_table, write_verdicts
from made_up_study import SIDE, square_mesh

GRAVITY = 9.81
STIFFNESS = [[2839.91, 299.7, 0.0], [299.7, 999.001, 0.0], [0.0, 0.0, 349.65]]
VARIANTS = ("biot", "yarn", "nodal-warping", "printed-nodal-warping")
METHODS = ("affine", "localized", "localized+modes")
REFERENCES = ("shell", "biot")


def write_vtu(path, points, triangles, point_data=(), cell_data=(), header="UInt32"):
    """Triangles with float arrays, appended raw, as `homespun drape` writes them."""
    heads, blobs = {"point": "", "cell": ""}, []

    def add(name, values, kind, components=1):
        kinds = {"Float32": "<f4", "Int32": "<i4", "UInt8": "u1"}
        data = numpy.ascontiguousarray(values).astype(kinds[kind]).tobytes()
        offset = sum(map(len, blobs))
        blobs.append(
            numpy.array([len(data)], "<u8" if header == "UInt64" else "<u4").tobytes() + data
        )
        return (
            f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" '
            f'format="appended" offset="{offset}"/>\n'
        )

    place = add("points", points, "Float32", 3)
    cells = (
        add("connectivity", triangles, "Int32")
        + add("offsets", 3 * numpy.arange(1, len(triangles) + 1), "Int32")
        + add("types", numpy.full(len(triangles), 5), "UInt8")
    )
    for name, values in dict(point_data).items():
        heads["point"] += add(name, values, "Float32")
    for name, values in dict(cell_data).items():
        heads["cell"] += add(name, values, "Float32")
    with open(path, "wb") as file:
        head = (
            '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0"'
            f' byte_order="LittleEndian" header_type="{header}">\n<UnstructuredGrid>'
            f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(triangles)}">\n'
            f'<PointData>{heads["point"]}</PointData><CellData>{heads["cell"]}</CellData>\n'
            f'<Points>{place}</Points><Cells>{cells}</Cells>\n</Piece></UnstructuredGrid>\n'
            '<AppendedData encoding="raw">\n_'
        )
        file.write(head.encode() + b"".join(blobs) + b"\n</AppendedData>\n</VTKFile>\n")


def swung(rest, size, time, ripple=0.0):
    """Where a sheet (n,2) [m] that hangs on its upper edge is after some time [s]: it swings and
    ripples (n,3).
    """
    angle = 0.5 * numpy.pi * (1.0 - numpy.cos(4.0 * time) * numpy.exp(-1.5 * time))
    drop = size - rest[:, 1]
    wave = 0.06 * drop * numpy.sin(4.0 * numpy.pi * rest[:, 0] / size + 0.5) * min(1.0, 2.0 * time)
    wave += (
        ripple
        * numpy.sin(2.0 * numpy.pi * rest[:, 0] / SIDE)
        * numpy.sin(2.0 * numpy.pi * rest[:, 1] / SIDE)
    )
    along = numpy.array([0.0, -numpy.cos(angle), -numpy.sin(angle)])
    normal = numpy.array([0.0, -numpy.sin(angle), numpy.cos(angle)])
    return (
        numpy.outer(rest[:, 0], [1.0, 0.0, 0.0])
        + numpy.outer(drop, along)
        + numpy.outer(wave, normal)
    )


def write_frames(folder, kind, times, mesh, position, header="UInt32"):
    """FOLDER/KIND.pvd and a .vtu per time."""
    os.makedirs(os.path.join(folder, kind), exist_ok=True)
    _, triangles, material = mesh
    entries = ""
    for i, time in enumerate(times):
        name = f"{kind}/{i:04d}.vtu"
        points = position(time)
        write_vtu(
            os.path.join(folder, name),
            points,
            triangles,
            {},
            {"material": material} if kind == "fine" else {},
            header,
        )
        entries += f'<DataSet timestep="{time:.9g}" part="0" file="{name}"/>\n'
    with open(os.path.join(folder, kind + ".pvd"), "w", encoding="utf-8") as file:
        file.write(
            '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1"><Collection>\n'
            + entries
            + "</Collection></VTKFile>\n"
        )


def write_drape(
    folder,
    cells=2,
    per_cell=3,
    frames=4,
    names=("layered",),
    variants=VARIANTS,
    references=REFERENCES,
):
    """A complete output folder of `homespun drape`; the defaults are as small as they can be."""
    os.makedirs(folder, exist_ok=True)
    size, times = cells * SIDE, numpy.linspace(0.0, 1.0, frames)
    coarse, fine = square_mesh(cells, size), square_mesh(cells * per_cell, size)
    errors, motion, terms, info = [], [], [], []
    growth = {variant: 10.0**i for i, variant in enumerate(VARIANTS)}
    for name in names:
        entry = {
            "cell": name,
            "cell_side_m": SIDE,
            "C": STIFFNESS,
            "areal_density": 0.2,
            "runs": [],
            "references": [],
        }
        info.append(entry)
        for reference in references:
            path = f"{name}-reference-{reference}"
            entry["references"].append(
                {
                    "reference": reference,
                    "folder": path,
                    "seconds_per_step": 1.3,
                    "ranks": 2,
                    "threads": 1,
                    "dofs": 3 * len(fine[0]),
                }
            )
            write_frames(
                os.path.join(folder, path),
                "fine",
                times,
                fine,
                lambda time: swung(fine[0], size, time, 0.1 * SIDE),
                header="UInt64",
            )
        for variant in variants:
            path, falls = f"{name}-{variant}", variant.startswith("printed")

            def position(rest, time, ripple=0.0, falls=falls, factor=growth[variant]):
                if falls:
                    height = numpy.full(len(rest), -0.5 * GRAVITY * time**2)
                    return numpy.column_stack([rest[:, 0], rest[:, 1] - size, height])
                return swung(rest, size, time * (1.0 + 1e-3 * factor), ripple)

            def upsampled(time, position=position):
                return position(fine[0], time, 0.09 * SIDE)

            def error(time, upsampled=upsampled):
                return numpy.linalg.norm(
                    upsampled(time) - swung(fine[0], size, time, 0.1 * SIDE), axis=1
                )

            entry["runs"].append(
                {
                    "variant": variant,
                    "folder": path,
                    "frames": frames,
                    "steps": 1000,
                    "cut_steps": 0,
                    "seconds_per_coarse_step": 1.1e-3,
                    "seconds_per_coarse_step_mean": 1.7e-3,
                    "seconds_per_coarse_step_95": 5.9e-3,
                    "seconds_per_upsampling": 9e-5,
                    "threads": 1,
                }
            )
            write_frames(
                os.path.join(folder, path),
                "coarse",
                times,
                coarse,
                lambda t: position(coarse[0], t),
            )
            write_frames(os.path.join(folder, path), "fine", times, fine, upsampled)
            for i, time in enumerate(times):
                value = float(error(time).mean())
                for reference in references:
                    for k, method in enumerate(METHODS):
                        one = value * (1.0, 0.5, 0.7)[k] + (1e-3 * SIDE if k == 0 else 0.0)
                        errors.append(
                            {
                                "scene": "swing",
                                "cell": name,
                                "variant": variant,
                                "reference": reference,
                                "method": method,
                                "frame": i,
                                "time_s": time,
                                "error_mean_m": one,
                                "error_rms_m": 1.2 * one,
                                "error_max_m": 4.0 * one,
                                "error_mean_per_cell": one / SIDE,
                                "error_mean_per_fluctuation": one / SIDE * 10.0,
                                "reference_uncertainty_m": 1e-5 if reference == "shell" else None,
                                "time_step_uncertainty_m": 2e-6 if reference == "shell" else None,
                                "displacement_mean_m": 0.1 * time,
                            }
                        )
        for variant, kind in (
            *((variant, "coarse") for variant in variants),
            *((reference, "reference") for reference in references),
        ):
            for i, time in enumerate(numpy.linspace(0.0, 1.0, 8 * frames)):
                falls = variant.startswith("printed")
                centre = (
                    -0.5 * GRAVITY * time**2
                    if falls
                    else swung(fine[0], size, time).mean(axis=0)[2]
                )
                is_run = kind == "coarse"
                motion.append(
                    {
                        "scene": "swing",
                        "cell": name,
                        "cloth": kind,
                        "variant": variant,
                        "frame": i,
                        "time_s": time,
                        "centre_x_m": size / 2.0,
                        "centre_y_m": -size / 2.0,
                        "centre_z_m": float(centre),
                        "kinetic_J": 0.01 * float(numpy.sin(5.0 * time)) ** 2,
                        "elastic_J": None if falls else 1e-4 * time,
                        "gravity_J": 0.02 * float(centre),
                        "max_stretch": 1.0 + 0.01 * time,
                        "seconds_coarse_step": 1.1e-3 if is_run else None,
                        "seconds_upsampling": 9e-5 if is_run else None,
                    }
                )
        term = {"scene": "swing", "cell": name}
        terms.append(
            {
                **term,
                "term": "membrane",
                "present": True,
                "seconds_per_step": 1e-3,
                "bytes": 80000,
                "seconds_spread": 2e-5,
            }
        )
        terms.append(
            {
                **term,
                "term": "wind",
                "present": False,
                "seconds_per_step": 1.1e-3,
                "seconds_per_step_forced": 1.25e-3,
                "bytes": 100000,
                "bytes_forced": 123456,
                "seconds_spread": 2e-5,
                "seconds_spread_forced": 3e-5,
            }
        )

    def write(file_name, text):
        with open(os.path.join(folder, file_name), "w", encoding="utf-8") as file:
            file.write(text)

    write(
        "drape.json",
        json.dumps(
            {
                "scene": "swing",
                "story": "A sheet, held along its upper edge, is let go <level> and swings down.",
                "command": "homespun drape swing.prm",
                "time_step_s": 1e-3,
                "duration_s": 1.0,
                "integrator": "implicit Euler",
                "coarse_triangles": len(coarse[1]),
                "fine_triangles": len(fine[1]),
                "fine_vertices": len(fine[0]),
                "terms": [
                    {"name": "membrane", "present": True, "parameters": "C^H of the cell"},
                    {"name": "wind", "present": False, "why": "the scene does not ask for it"},
                ],
                "cells": info,
                "parameters": {
                    "Gravity": "0, 0, -9.81",
                    "Time step": "0.001 s",
                    "solver": {"tolerance": 1e-8},
                },
                "provenance": {"homespun": "0.2.0", "git": "abc1234"},
            }
        ),
    )
    if references:
        write_table(folder, "drape.csv", errors)
    held = [
        {
            **{key: row[key] for key in ("scene", "cell", "cloth", "variant", "frame", "time_s")},
            "place": "top",
            "force_x_N": 0.3 * row["time_s"],
            "force_y_N": 0.0,
            "force_z_N": 0.4 * row["time_s"],
        }
        for row in motion
    ]
    write_table(folder, "motion.csv", motion + held)
    write_table(folder, "terms.csv", terms)
    write_verdicts(
        folder,
        [
            verdict(
                "the cloth follows the shell",
                "PASS",
                1e-4,
                "2e-4 m",
                "method",
                command="homespun drape swing.prm",
            ),
            verdict(
                "the printed Eq. 8 holds the sheet up",
                "FAIL",
                4.9,
                "0.1 m",
                command="homespun drape swing.prm",
            ),
        ],
    )
    write_run(folder, "drape")
