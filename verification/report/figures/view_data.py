# SPDX-License-Identifier: MIT
"""What the page needs to show a cloth in space: positions of fewer vertices, in 16 bits each,
compressed.

Positions are those of the up-sampled cloth, and its difference from the reference has a scale of
its own, so that an error of a micrometre survives the 16 bits that hold a cloth of a metre.
"""
import base64
import zlib

import numpy
from matplotlib import colormaps
from matplotlib.colors import to_hex

from figures.cloth import ERROR_MAP, spread
from figures.decimation import decimate
from figures.sheet import unit_of
from read.vtu import read_vtu

SHEET_VERTICES = 20000  # of one sheet at most, and
ALL_SHEET_VERTICES = 120000  # of all of a page
FILM_NUMBERS = 400000  # coordinates of one film at most, and
ALL_FILM_NUMBERS = 1600000  # of all of a page
FRAMES = 9
LARGEST_INTEGER = 32767
SHOWN_PERCENTILE = 99.5  # where the colours end, as in the pictures


def packed(arrays):
    """Arrays as text: each scaled to 16 bits, a component after the other, differences of
    neighbours, deflated.

    @param arrays name -> (...) numbers, integers below 65536 or reals
    @return {"arrays": [{"name", "shape", "offset", "scale"}], "data"}; value = offset + scale *
        integer
    """
    heads, parts = [], []
    for name, array in arrays.items():
        array = numpy.asarray(array)
        if array.dtype.kind in "iu":
            offset, scale, integers = 0.0, 1.0, array.astype(numpy.uint16)
        else:
            low, high = (float(array.min()), float(array.max())) if array.size else (0.0, 0.0)
            offset, scale = 0.5 * (low + high), 0.5 * (high - low) / LARGEST_INTEGER or 1.0
            integers = numpy.round((array - offset) / scale).astype(numpy.int16).view(numpy.uint16)
        flat = numpy.moveaxis(integers, -1, 0).reshape(-1) if integers.ndim > 1 else integers
        parts.append(numpy.diff(flat, prepend=flat.dtype.type(0)).astype("<u2").tobytes())
        heads.append(
            {
                "name": name,
                "shape": list(array.shape),
                "offset": offset,
                "scale": scale,
                "whole": array.dtype.kind in "iu",
            }
        )
    return {
        "arrays": heads,
        "data": base64.b64encode(zlib.compress(b"".join(parts), 9)).decode("ascii"),
    }


def unpacked(view):
    """The arrays of a view as the page reads them."""
    values = numpy.frombuffer(zlib.decompress(base64.b64decode(view["data"])), "<u2")
    arrays, start = {}, 0
    for head in view["arrays"]:
        shape = head["shape"]
        size = int(numpy.prod(shape))
        flat = numpy.cumsum(values[start : start + size], dtype=numpy.uint16)
        start += size
        integers = flat.astype(float) if head["whole"] else flat.view(numpy.int16).astype(float)
        turned = integers.reshape([shape[-1]] + shape[:-1]) if len(shape) > 1 else integers
        arrays[head["name"]] = head["offset"] + head["scale"] * (
            numpy.moveaxis(turned, 0, -1) if len(shape) > 1 else turned
        )
    return arrays


def colour_scale(difference):
    """Colours of the error from zero up to its high percentile, with the unit that suits it."""
    length = numpy.linalg.norm(difference, axis=-1)
    largest = float(numpy.percentile(length, SHOWN_PERCENTILE))
    factor, unit = unit_of(largest)
    return {
        "largest": largest,
        "factor": factor,
        "unit": unit,
        "colours": [to_hex(colormaps[ERROR_MAP](i / 15.0)) for i in range(16)],
    }


def sheet_view(sheet, colours, sheets):
    """One stored sheet: reference, up-sampled and coarse mesh at one strain.

    @param colours material number -> colour
    @param sheets how many the page shows
    @return (view, Decimated)
    """
    few = decimate(
        sheet["rest"], sheet["triangles"], min(SHEET_VERTICES, ALL_SHEET_VERTICES // max(1, sheets))
    )
    up, difference = (
        sheet["upsampled"][few.vertices],
        (sheet["upsampled"] - sheet["reference"])[few.vertices],
    )
    palette = sorted(colours)
    phase = numpy.searchsorted(palette, sheet["material"][few.origin])
    view = {
        "times": [],
        "of": len(sheet["rest"]),
        "error": colour_scale(sheet["upsampled"] - sheet["reference"]),
        "phases": [colours[number] for number in palette],
        **packed(
            {
                "triangles": few.triangles,
                "phase": phase,
                "upsampled": up[None],
                "difference": difference[None],
                "coarse_triangles": sheet["coarse_triangles"],
                "coarse": sheet["coarse"][None],
            }
        ),
    }
    return view, few


def sheet_table(sheet, few):
    """Header and rows of the vertices of a view: places in metres."""
    columns = [
        ("rest", sheet["rest"]),
        ("reference", sheet["reference"]),
        ("upsampled", sheet["upsampled"]),
    ]
    header = ["vertex"] + [f"{name}_{axis}_m" for name, _ in columns for axis in "xy"]
    values = numpy.column_stack([array[few.vertices] for _, array in columns])
    return header, [[int(n), *row] for n, row in zip(few.vertices, values)]


def film_view(film, camera, phases, up, films):
    """A cloth in motion: some of the frames that have an up-sampled cloth; None with fewer than
    two.

    The reference is there where its triangles are those of the up-sampled cloth. The third axis of
    the view is up, the first is that of the picture.
    @param camera of the picture
    @param up (3)
    @param films how many the page shows
    """
    shots = [shot for shot in film.shots if shot["fine"]]
    if len(shots) < 2:
        return None
    shots = shots[:1] + spread(shots[1:], FRAMES - 1)
    up = numpy.asarray(up, dtype=float) / numpy.linalg.norm(up)
    right = camera.axes[0]
    axes = numpy.array([right, numpy.cross(up, right), up])
    fine = [read_vtu(shot["fine"]) for shot in shots]
    references = [read_vtu(shot["reference"]) if shot["reference"] else None for shot in shots]
    compared = all(
        r is not None and numpy.array_equal(r.triangles, f.triangles)
        for r, f in zip(references, fine)
    )
    numbers = min(FILM_NUMBERS, ALL_FILM_NUMBERS // max(1, films))
    few = decimate(fine[0].points, fine[0].triangles, numbers // (len(shots) * 3 * (1 + compared)))
    arrays = {
        "triangles": few.triangles,
        "upsampled": numpy.array([f.points[few.vertices] for f in fine]) @ axes.T,
    }
    view = {
        "times": [float(shot["time"]) for shot in shots],
        "of": len(fine[0].points),
        "error": None,
        "phases": [],
    }
    if compared:
        difference = numpy.array([f.points - r.points for f, r in zip(fine, references)])
        view["error"] = colour_scale(difference)
        arrays["difference"] = difference[:, few.vertices] @ axes.T
    material = fine[0].material()
    if material is not None and phases:
        palette = sorted(phases)
        view["phases"] = [to_hex(phases[number][0]) for number in palette]
        arrays["phase"] = numpy.searchsorted(palette, material[few.origin])
    if all(shot["coarse"] for shot in shots):
        coarse = [read_vtu(shot["coarse"]) for shot in shots]
        arrays["coarse_triangles"] = coarse[0].triangles
        arrays["coarse"] = numpy.array([c.points for c in coarse]) @ axes.T
    return {**view, **packed(arrays)}
