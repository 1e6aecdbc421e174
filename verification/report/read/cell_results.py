# SPDX-License-Identifier: MIT
"""Reads the results of one cell: homogenize.json, cell.json, cell.h5 and the stored sheets."""
import math
import os
from dataclasses import dataclass, field

import h5py
import numpy

from read.stored import is_stiffness, read_json, version_is_known

AGAIN = "Run `homespun homogenize` or `homespun strain` again."


@dataclass
class Cell:
    """A homogenized cell. What the folder does not hold is None."""

    name: str
    folder: str = ""
    homogenize: dict = None  # homogenize.json
    # Of cell.json, in the order of the material numbers; of a group in many directions one, with
    # `angles`.
    phases: list = None
    group_of: numpy.ndarray = None  # of each phase in the files, its place in `phases`
    command: str = ""  # of the run that homogenized it
    # (command, homogenize.json) of other runs of the page with another C^H of the same cell
    others: list = field(default_factory=list)
    file: str = ""  # the .prm it came from
    vertices: numpy.ndarray = None  # (n,2) [m]
    triangles: numpy.ndarray = None  # (m,3)
    material: numpy.ndarray = None  # (m)
    lattice: numpy.ndarray = None  # (2,2) [m], rows a1, a2
    chi: numpy.ndarray = None  # (n,2,3) [m] per unit strain
    deflection: numpy.ndarray = None  # (n,3) [m^2]; None where it is not stored
    field_files: list = field(default_factory=list)

    @property
    def side(self):
        """sqrt(|Y|) [m], or None."""
        if self.lattice is not None:
            return float(abs(numpy.linalg.det(self.lattice))) ** 0.5
        area = (self.homogenize or {}).get("area")
        return area**0.5 if area else None

    def place_of_cut(self):
        """In words, where the cell is not cut from the cloth as it is drawn; else empty."""
        shift = (self.homogenize or {}).get("shift")
        return str(shift.get("remark", "")) if isinstance(shift, dict) else ""

    def stiffness(self, key="C"):
        """A 3 x 3 matrix of homogenize.json [N/m, of bending N m], or None."""
        value = (self.homogenize or {}).get(key)
        return None if value is None else numpy.array(value, dtype=float)


def datasets(path, shapes, faults):
    """Reads datasets of an HDF5 file and holds them against their shapes.

    @param shapes name -> (shape, kind); a letter in the shape is a size that must agree everywhere
    @return name -> array, plus the attributes under "attributes"; None with a fault
    """
    values, sizes = {}, {}
    try:
        with h5py.File(path, "r") as file:
            if not version_is_known(path, file.attrs, faults):
                return None
            for name, (shape, kind) in shapes.items():
                if name not in file:
                    faults.append(f"{path}: dataset `/{name}` is missing. {AGAIN}")
                    return None
                if not isinstance(file.get(name, getlink=True), h5py.HardLink):
                    faults.append(
                        f"{path}: `/{name}` is a link, perhaps into another file; expected the"
                        f" dataset itself. {AGAIN}"
                    )
                    return None
                values[name] = numpy.asarray(file[name][()])
            values["attributes"] = {
                key: value.decode() if isinstance(value, bytes) else value
                for key, value in file.attrs.items()
            }
    except OSError as error:
        faults.append(f"{path}: not a readable HDF5 file, perhaps truncated ({error}). {AGAIN}")
        return None
    for name, (shape, kind) in shapes.items():
        array = values[name]
        expected = tuple(
            (
                sizes.setdefault(s, array.shape[i] if i < array.ndim else None)
                if isinstance(s, str)
                else s
            )
            for i, s in enumerate(shape)
        )
        if array.shape != expected:
            faults.append(
                f"{path}: `/{name}` has shape {array.shape}, expected {expected}. {AGAIN}"
            )
            return None
        if kind == "real" and not numpy.isfinite(array).all():
            faults.append(f"{path}: `/{name}` has values that are not finite. {AGAIN}")
            return None
    return values


def stores(path, name):
    """Whether a file that was readable just now has a dataset that older ones lack."""
    with h5py.File(path, "r") as file:
        return name in file


def triangles_in_range(path, name, triangles, vertices, faults):
    """Whether all triangles refer to vertices that exist."""
    if triangles.size and (triangles.min() < 0 or triangles.max() >= len(vertices)):
        faults.append(
            f"{path}: `/{name}` refers to vertex {triangles.max()}, but there are "
            f"{len(vertices)} vertices. {AGAIN}"
        )
        return False
    return True


def check_homogenize(value, path, faults):
    """homogenize.json with matrices of shape 3 x 3; anything else in it is shown as it stands."""
    for key in ("C", "C_lower", "C_upper", "voigt", "reuss", "D", "D_lower", "D_upper"):
        if value.get(key) is not None and not is_stiffness(value[key]):
            faults.append(f"{path}: key `{key}` is not a 3 x 3 matrix of finite numbers. {AGAIN}")
            value = {**value, key: None}
    history = value.get("history")
    if history is not None and not (
        isinstance(history, list)
        and all(
            isinstance(row, dict)
            and all(
                isinstance(row.get(key), (int, float)) and row[key] > 0.0
                for key in ("dofs", "width")
            )
            for row in history
        )
    ):
        faults.append(
            f"{path}: key `history` is not a list of meshes with positive `dofs` and `width`."
            f" {AGAIN}"
        )
        value = {**value, "history": None}
    for key, kind in (
        ("engineering", dict),
        ("checks", list),
        ("bracket", dict),
        ("bending_bracket", dict),
        ("sensitivity", list),
        ("input_bars", dict),
    ):
        if value.get(key) is not None and not isinstance(value[key], kind):
            faults.append(
                f"{path}: key `{key}` is not {'an object' if kind is dict else 'a list'}. {AGAIN}"
            )
            value = {**value, key: None}
    return value


def share_groups(cell):
    """Makes one phase of those of one name: a group whose angle differs from triangle to triangle.
    """
    names = [str(phase.get("name", number)) for number, phase in enumerate(cell.phases or [])]
    places = {name: place for place, name in enumerate(dict.fromkeys(names))}
    cell.group_of = numpy.array([places[name] for name in names], dtype=int)
    if len(places) < len(names):
        groups = [
            [phase for phase, its in zip(cell.phases, names) if its == name] for name in places
        ]
        cell.phases = [
            (
                {**group[0], "angles": [phase.get("angle") for phase in group]}
                if len(group) > 1
                else group[0]
            )
            for group in groups
        ]
    if cell.material is not None:
        cell.material = grouped(cell, cell.material)


def grouped(cell, material):
    """Material numbers of a file as places in the phases of the cell; as they are where the cell
    does not know them.
    """
    known = material.size and 0 <= material.min() and material.max() < len(cell.group_of)
    return cell.group_of[material] if known else material


def read_cell(name, run, inner, faults, missing):
    """Reads what a run wrote of one cell; what is absent is noted in `missing`.

    @param inner folder of the cell in that of the run, empty where they are one
    """
    cell = Cell(name, os.path.join(run.folder, inner), command=run.command)

    def path_of(file, consequence):
        path, why = run.take(os.path.join(inner, file))
        if path is None:
            missing.append({"what": f"{name}: {consequence}", "why": why})
        return path

    if path := path_of("homogenize.json", "effective stiffness"):
        if value := read_json(path, faults):
            cell.homogenize = check_homogenize(value, path, faults)
    if path := path_of("cell.json", "names and moduli of the phases"):
        if value := read_json(path, faults):
            cell.file = str(value.get("file", ""))
            phases = value.get("phases")
            if isinstance(phases, list) and all(isinstance(phase, dict) for phase in phases):
                cell.phases = phases
            else:
                faults.append(f"{path}: key `phases` is missing or not a list of objects. {AGAIN}")
    if path := path_of("cell.h5", "pictures of the cell and its characteristic displacements"):
        values = datasets(
            path,
            {
                "vertices": (("n", 2), "real"),
                "triangles": (("m", 3), "index"),
                "material": (("m",), "index"),
                "lattice": ((2, 2), "real"),
                "chi": (("n", 2, 3), "real"),
            },
            faults,
        )
        if values and triangles_in_range(
            path, "triangles", values["triangles"], values["vertices"], faults
        ):
            for key in ("vertices", "triangles", "material", "lattice", "chi"):
                setattr(cell, key, values[key])
            if stores(path, "deflection"):
                more = datasets(path, {"deflection": ((len(cell.vertices), 3), "real")}, faults)
                cell.deflection = more["deflection"] if more else None
    share_groups(cell)
    for file in run.names(os.path.join(inner, "fields-*.h5")):
        if path := path_of(os.path.relpath(file, inner or "."), "picture of the sheet"):
            cell.field_files.append(path)
    return cell


def read_fields(path, faults):
    """One stored sheet: name -> array and attributes load, strain, reference, method; None with a
    fault.
    """
    values = datasets(
        path,
        {
            "rest": (("n", 2), "real"),
            "triangles": (("m", 3), "index"),
            "material": (("m",), "index"),
            "reference": (("n", 2), "real"),
            "upsampled": (("n", 2), "real"),
            "coarse_rest": (("k", 2), "real"),
            "coarse_triangles": (("l", 3), "index"),
            "coarse": (("k", 2), "real"),
        },
        faults,
    )
    if values is None:
        return None
    attributes = values["attributes"]
    for key in ("load", "strain", "reference", "method"):
        if key not in attributes:
            faults.append(f"{path}: attribute `{key}` is missing. {AGAIN}")
            return None
    try:
        values["strain"] = float(attributes["strain"])
    except (TypeError, ValueError):
        faults.append(
            f"{path}: attribute `strain` is `{attributes['strain']}`, expected a number. {AGAIN}"
        )
        return None
    values["load"], values["method"] = str(attributes["load"]), str(attributes["method"])
    values["reference_law"] = str(attributes["reference"])  # `reference` is the positions
    sound = triangles_in_range(path, "triangles", values["triangles"], values["rest"], faults)
    sound &= triangles_in_range(
        path, "coarse_triangles", values["coarse_triangles"], values["coarse_rest"], faults
    )
    return values if sound else None


def relative_width(lower, upper):
    """The largest v.(upper − lower).v / v.upper.v of two 3 x 3 matrices; nan where the upper one is
    not positive definite.
    """
    if numpy.linalg.eigvalsh(upper).min() <= 0.0:
        return math.nan
    root = numpy.linalg.inv(numpy.linalg.cholesky(upper))
    return float(numpy.linalg.eigvalsh(root @ (upper - lower) @ root.T).max())
