# SPDX-License-Identifier: MIT
"""Reads the frames of a cloth in motion: a .pvd list of times and the triangles of its .vtu files.

Of VTK's format it reads what `homespun drape` writes: one piece of linear triangles, arrays
appended as raw bytes. All else is refused by name, since a picture of misread bytes would look like
a result.
"""
import math
import os
import re
from dataclasses import dataclass, field
from xml.etree import ElementTree

import numpy

from read.stored import lies_within

AGAIN = "Run `homespun drape` again."
TYPES = {
    "Float32": "f4",
    "Float64": "f8",
    "Int8": "i1",
    "UInt8": "u1",
    "Int16": "i2",
    "UInt16": "u2",
    "Int32": "i4",
    "UInt32": "u4",
    "Int64": "i8",
    "UInt64": "u8",
}
TRIANGLE = 5  # VTK's number of a linear triangle
APPENDED = re.compile(rb'<AppendedData\s+encoding\s*=\s*"([^"]*)"\s*>\s*_')


@dataclass
class Surface:
    """One frame: triangles in space and what is stored on them."""

    points: numpy.ndarray  # (n,3) [m]
    triangles: numpy.ndarray  # (m,3)
    point_data: dict = field(default_factory=dict)  # name -> (n) or (n,c)
    cell_data: dict = field(default_factory=dict)  # name -> (m) or (m,c)

    def material(self):
        """Number of the material of each triangle (m), or None where the file does not say."""
        if "material" in self.cell_data:
            return self.cell_data["material"].reshape(-1).astype(int)
        # A vertex between two phases belongs to one of them: let two of three say.
        if "material" in self.point_data:
            return numpy.median(
                self.point_data["material"].reshape(-1)[self.triangles], axis=1
            ).astype(int)
        return None


class BadFrame(Exception):
    """A .pvd or .vtu that cannot be used."""


def read_pvd(path):
    """Times and files of a .pvd.

    @return list of (time [s], path of the .vtu), in the order of time
    @throws BadFrame
    """
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise BadFrame(f"{path}: not a readable .pvd ({error}). {AGAIN}") from error
    frames = []
    for entry in root.iter("DataSet"):
        try:
            time = float(entry.get("timestep"))
        except (TypeError, ValueError):
            time = math.nan
        if not math.isfinite(time) or not entry.get("file"):
            raise BadFrame(
                f"{path}: DataSet {len(frames)} has timestep `{entry.get('timestep')}` and file "
                f"`{entry.get('file')}`, expected a number and a name. {AGAIN}"
            )
        frame = os.path.join(os.path.dirname(path), entry.get("file"))
        if not lies_within(frame, os.path.dirname(path) or "."):
            raise BadFrame(
                f"{path}: DataSet {len(frames)} names `{entry.get('file')}`, which lies outside of"
                f" the folder of the list; expected a file in it or below. {AGAIN}"
            )
        frames.append((time, frame))
    if not frames:
        raise BadFrame(f"{path}: lists no frame, expected DataSet entries. {AGAIN}")
    frames.sort(key=lambda frame: frame[0])
    for one, other in zip(frames, frames[1:]):
        if one[0] == other[0]:
            raise BadFrame(
                f"{path}: lists two files at {one[0]:g} s, expected one piece per frame. {AGAIN}"
            )
    return frames


def read_vtu(path):
    """One frame.

    @return Surface
    @throws BadFrame with what was found and what was expected
    """
    try:
        with open(path, "rb") as file:
            content = file.read()
    except OSError as error:
        raise BadFrame(f"{path}: cannot be read ({error}). {AGAIN}") from error
    start = APPENDED.search(content)
    if start is None or start.group(1) != b"raw":
        raise BadFrame(
            f"{path}: has no `<AppendedData encoding=\"raw\">`, expected arrays appended as raw"
            f" bytes. {AGAIN}"
        )
    try:
        root = ElementTree.fromstring(content[: start.start()] + b"</VTKFile>")
    except ElementTree.ParseError as error:
        raise BadFrame(
            f"{path}: the part before the appended arrays is not valid XML ({error}). {AGAIN}"
        ) from error
    pieces = list(root.iter("Piece"))
    if len(pieces) != 1 or root.get("compressor"):
        raise BadFrame(
            f"{path}: has {len(pieces)} pieces, compressor {root.get('compressor')}; expected one"
            f" piece, not compressed. {AGAIN}"
        )
    piece = pieces[0]
    order = ">" if root.get("byte_order") == "BigEndian" else "<"
    header = numpy.dtype(order + ("u8" if root.get("header_type") == "UInt64" else "u4"))

    def array(element):
        """The values of a DataArray, flat or (n, components)."""
        name, kind = element.get("Name"), TYPES.get(element.get("type"))
        if (
            kind is None
            or element.get("format") != "appended"
            or not (element.get("offset") or "").isdigit()
        ):
            raise BadFrame(
                f"{path}: array `{name}` has type {element.get('type')}, format"
                f" {element.get('format')}, offset {element.get('offset')}; expected numbers in"
                f" format appended. {AGAIN}"
            )
        begin = start.end() + int(element.get("offset"))
        data = begin + header.itemsize
        size = int(numpy.frombuffer(content[begin:data], header)[0]) if data <= len(content) else 0
        kind = numpy.dtype(order + kind)
        if data + size > len(content) or size % kind.itemsize:
            raise BadFrame(
                f"{path}: array `{name}` ends behind the end of the file ({len(content)} bytes): it"
                f" is truncated. {AGAIN}"
            )
        values = numpy.frombuffer(content, kind, size // kind.itemsize, data)
        components = int(element.get("NumberOfComponents") or 1)
        return values.reshape(-1, components) if components > 1 else values

    def arrays(section):
        parent = piece.find(section)
        return {
            e.get("Name"): array(e)
            for e in (parent if parent is not None else ())
            if e.tag == "DataArray"
        }

    points, cells = arrays("Points"), arrays("Cells")
    if not points or not {"connectivity", "types"} <= cells.keys():
        raise BadFrame(f"{path}: has no Points or no Cells with connectivity and types. {AGAIN}")
    surface = Surface(
        next(iter(points.values())).astype(float),
        cells["connectivity"].astype(int),
        arrays("PointData"),
        arrays("CellData"),
    )
    sizes = (int(piece.get(name) or -1) for name in ("NumberOfPoints", "NumberOfCells"))
    check(surface, cells["types"], *sizes, path)
    surface.triangles = surface.triangles.reshape(-1, 3)
    return surface


def check(surface, types, n_points, n_cells, path):
    """@throws BadFrame where sizes, indices or numbers make no sense"""
    if (
        surface.points.shape != (n_points, 3)
        or surface.triangles.size != 3 * n_cells
        or len(types) != n_cells
        or (types != TRIANGLE).any()
    ):
        raise BadFrame(
            f"{path}: has points of shape {surface.points.shape} and"
            f" {surface.triangles.size} corners, expected ({n_points}, 3) and {n_cells} triangles."
            f" {AGAIN}"
        )
    if not numpy.isfinite(surface.points).all():
        vertex = int(numpy.flatnonzero(~numpy.isfinite(surface.points).all(axis=1))[0])
        raise BadFrame(
            f"{path}: vertex {vertex} is at {surface.points[vertex]}, expected finite numbers."
            f" {AGAIN}"
        )
    if (
        surface.triangles.size
        and not 0 <= surface.triangles.min() <= surface.triangles.max() < n_points
    ):
        raise BadFrame(
            f"{path}: `connectivity` refers to vertex {surface.triangles.max()}, but there are"
            f" {n_points} vertices. {AGAIN}"
        )
    for data, size, where in (
        (surface.point_data, n_points, "points"),
        (surface.cell_data, n_cells, "triangles"),
    ):
        for name, values in data.items():
            if len(values) != size or not numpy.isfinite(values).all():
                raise BadFrame(
                    f"{path}: array `{name}` has {len(values)} values for {size} {where}, or values"
                    f" that are not finite. {AGAIN}"
                )
