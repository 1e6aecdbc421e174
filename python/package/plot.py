# SPDX-License-Identifier: MIT
"""Pictures of cells, sheets and errors with matplotlib, which is imported when one is drawn.

Every function gives back the figure that it drew in, its own or that of `axes`:
`plot.cell(cell).savefig("cell.png")`.
"""
from __future__ import annotations

import typing

import numpy

from ._light import BadInput

if typing.TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

    from ._light import Cell

    Numbers = NDArray[numpy.float64]


class Meshed(typing.Protocol):
    """A Sheet, and whatever else has its fine mesh."""

    @property
    def vertices(self) -> Numbers:
        """(n, 2) at rest [m]"""

    @property
    def triangles(self) -> NDArray[numpy.int32]:
        """(m, 3)"""

    @property
    def material(self) -> NDArray[numpy.int32]:
        """(m,) phase of each triangle"""


LOADS = ("11", "22", "12")
SHOWN_STRAIN = 0.2  # of cells that are drawn deformed
# Colours of Okabe and Ito (2008), as in reports, and what readers call the methods.
METHODS = {"affine": ("#D55E00", "coarse mesh alone"), "localized": ("#0072B2", "paper"),
           "full": ("#000000", "full")}
SPARE_COLOURS = ("#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#882255", "#999933")
MOST_TRIANGLES = 4_000_000  # of a picture: half a minute and 5 GB
ROUND_OFF = 1e-11  # errors per cell side below this are not told from round-off


def _new_axes(axes: Axes | None) -> Axes:
    if axes is not None:
        return axes
    from matplotlib import pyplot

    return typing.cast("Axes", pyplot.subplots(layout="constrained")[1])


def _unit(size: float) -> tuple[float, str]:
    """What lengths are multiplied by to be shown, and the unit."""
    return (1e3, "mm") if size < 0.03 else (1e2, "cm") if size < 1.0 else (1.0, "m")


def _phase_colours(material: NDArray[numpy.int32]) -> Numbers:
    """(m, 3) red, green, blue: phases from light to dark."""
    light, dark = numpy.array([0.93, 0.87, 0.76]), numpy.array([0.13, 0.25, 0.40])
    n = max(int(material.max()), 1)
    part = (material / n)[:, None]
    return numpy.asarray(light + part * (dark - light), dtype=float)


def _draw(axes: Axes, points: Numbers, triangles: NDArray[numpy.int32], colours: Numbers,
          unit: str) -> None:
    """Triangles in their order, points (n, 2) in the unit."""
    if len(triangles) > MOST_TRIANGLES:
        raise BadInput(f"picture: found {len(triangles)} triangles; expected at most "
                       f"{MOST_TRIANGLES}: save the mesh and look at it in Blender or ParaView")
    from matplotlib.collections import PolyCollection

    # Edges of the colour of the face close the hairlines between neighbours.
    axes.add_collection(PolyCollection(points[triangles], facecolors=colours, edgecolors="face",
                                       linewidths=0.4, rasterized=True))
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")


def cell(cell: Cell, *, axes: Axes | None = None) -> Figure:
    """The mesh of a cell, phases from light to dark."""
    axes = _new_axes(axes)
    size, unit = _unit(float(numpy.ptp(cell.vertices, axis=0).max()))
    _draw(axes, size * cell.vertices, cell.triangles, _phase_colours(cell.material), unit)
    return typing.cast("Figure", axes.figure)


def chi(cell: Cell) -> Figure:
    """The characteristic displacements: a cell under each unit macro strain, drawn at 20 %, its
    colour how far chi moves each triangle [mm per 1 % of strain]."""
    from matplotlib import colors, pyplot

    figure, panels = pyplot.subplots(1, 3, figsize=(10.0, 3.6), layout="constrained")
    size, unit = _unit(float(numpy.ptp(cell.vertices, axis=0).max()))
    displacements = cell.chi.reshape(-1, 3, 2)
    moved = 10.0 * numpy.linalg.norm(displacements[cell.triangles].mean(axis=1), axis=2)
    norm = colors.Normalize(0.0, float(moved.max()) or 1.0)
    colour_map = pyplot.get_cmap("viridis")
    for load, axes in enumerate(panels):
        strain = numpy.zeros((2, 2))
        if load < 2:
            strain[load, load] = SHOWN_STRAIN
        else:
            strain[0, 1] = strain[1, 0] = SHOWN_STRAIN / 2.0  # engineering shear
        points = cell.vertices @ (numpy.eye(2) + strain) - SHOWN_STRAIN * displacements[:, load]
        _draw(axes, size * points, cell.triangles, colour_map(norm(moved[:, load])), unit)
        axes.set_title(rf"$\chi_{{{LOADS[load]}}}$, drawn at {100 * SHOWN_STRAIN:.0f} %")
    figure.colorbar(pyplot.cm.ScalarMappable(norm, colour_map), ax=panels,
                    label="displacement by chi [mm per 1 % strain]")
    return typing.cast("Figure", figure)


def _seen(positions: Numbers, elevation: float, azimuth: float) -> Numbers:
    """(n, 3): to the right, up and towards the viewer; angles in degrees as in matplotlib's 3D."""
    e, a = numpy.radians([elevation, azimuth])
    towards = numpy.array([numpy.cos(e) * numpy.cos(a), numpy.cos(e) * numpy.sin(a), numpy.sin(e)])
    right = numpy.array([-numpy.sin(a), numpy.cos(a), 0.0])
    axes_of_view = numpy.array([right, numpy.cross(towards, right), towards])
    return numpy.asarray(positions @ axes_of_view.T, dtype=float)


def _scale_bar(axes: Axes, width: float, left: float, bottom: float) -> None:
    """A length of 1, 2 or 5 times a power of ten, about a fifth of the width [m]."""
    power = 10.0 ** numpy.floor(numpy.log10(width / 5.0))
    length = max(k * power for k in (1.0, 2.0, 5.0) if k * power <= width / 5.0)
    size, unit = _unit(length)
    axes.plot([left, left + length], [bottom, bottom], color="black", lw=2.0)
    axes.annotate(f"{size * length:g} {unit}", (left + length / 2.0, bottom), xytext=(0, -3),
                  textcoords="offset points", ha="center", va="top")


def sheet(sheet: Meshed, positions: ArrayLike | None = None, *, elevation: float = 30.0,
          azimuth: float = -60.0, axes: Axes | None = None) -> Figure:
    """The fine mesh of a sheet, phases from light to dark.

    positions: (n, 3) [m] of its vertices, such as Upsampler.upsample() gives, seen from elevation
    and azimuth [degrees] with z upwards and shaded; or (n, 2); None: at rest.
    Raises BadInput where their number is not that of the vertices.
    """
    axes = _new_axes(axes)
    points = numpy.asarray(sheet.vertices if positions is None else positions, dtype=float)
    n = len(sheet.vertices)
    if points.shape not in ((n, 2), (n, 3)):
        raise BadInput(f"positions: found the shape {points.shape}; expected ({n}, 3), one row per "
                       "fine vertex")
    triangles, colours = sheet.triangles, _phase_colours(sheet.material)
    if points.shape[1] == 2:
        size, unit = _unit(float(numpy.ptp(points, axis=0).max()))
        _draw(axes, size * points, triangles, colours, unit)
        return typing.cast("Figure", axes.figure)
    seen = _seen(points, elevation, azimuth)
    a, b, c = (seen[triangles[:, k]] for k in range(3))
    normals = numpy.cross(b - a, c - a)
    lengths = numpy.linalg.norm(normals, axis=1)
    light = numpy.array([-0.4, 0.5, 0.77])  # over the viewer's left shoulder
    bright = abs(normals @ light) / numpy.where(lengths > 0.0, lengths, 1.0)
    shaded = colours * (0.45 + 0.55 * bright)[:, None]
    order = numpy.argsort(seen[triangles, 2].mean(axis=1), kind="stable")  # the nearest last
    _draw(axes, seen[:, :2], triangles[order], shaded[order].clip(0.0, 1.0), "m")
    axes.set_axis_off()
    low, width = seen[:, :2].min(axis=0), float(numpy.ptp(seen[:, 0]))
    _scale_bar(axes, width, low[0], low[1] - 0.04 * width)
    return typing.cast("Figure", axes.figure)


def _names(column: NDArray[typing.Any]) -> list[str]:
    """Each name once, in the order of the table."""
    return list(dict.fromkeys(str(name) for name in column))


def _law_of(table: NDArray[numpy.void], law: str | None) -> str:
    laws = _names(table["reference"])
    if law is None:
        return next((one for one in ("yarn", "biot") if one in laws), laws[0])
    if law not in laws:
        raise BadInput(f"law: found {law}; expected one of {', '.join(laws)}")
    return law


def strain(table: NDArray[numpy.void], *, loads: Sequence[str] | None = None,
           methods: Sequence[str] | None = None, law: str | None = None) -> Figure:
    """Figure 3 of the paper: mean error per vertex against strain, a panel per load.

    table: `homespun.results("out/dots/strain")["strain"]`
    loads, methods: names in the table; None: all loads, and affine, localized and full
    law: of the reference; None: yarn where it is there, else biot
    Grey: less than the error bar of the smallest error. Raises BadInput naming what is not there.
    """
    from matplotlib import pyplot

    needed = {"load", "strain", "reference", "method", "error_mean_m", "error_mean_per_cell",
              "error_bar_m"} - set(table.dtype.names or ())
    if needed:
        raise BadInput(f"table: has no column {', '.join(sorted(needed))}; expected the table "
                       "`strain` of homespun.results()")
    law = _law_of(table, law)
    table = table[table["reference"] == law]
    known = _names(table["method"])
    chosen = {"loads": loads or _names(table["load"]),
              "methods": methods or [one for one in METHODS if one in known]}
    for name, column in (("loads", "load"), ("methods", "method")):
        for one in chosen[name]:
            if one not in table[column]:
                raise BadInput(f"{name}: found {one}; expected some of "
                               f"{', '.join(_names(table[column]))}")
    n = len(chosen["loads"])
    columns = min(n, 3)
    rows = -(-n // columns)
    figure, panels = pyplot.subplots(rows, columns, sharex=True, squeeze=False,
                                     figsize=(1.0 + 3.0 * columns, 0.8 + 2.6 * rows),
                                     layout="constrained")
    for axes, load in zip(panels.flat, chosen["loads"]):
        _draw_load(axes, table[table["load"] == load], chosen["methods"])
        axes.set_title(load)
    for axes in panels.flat[n:]:
        axes.set_visible(False)
    figure.supxlabel("strain [%]")
    figure.supylabel(f"mean error against {law} [cell sides]")
    panels.flat[0].legend(fontsize="small")
    return typing.cast("Figure", figure)


def _draw_load(axes: Axes, table: NDArray[numpy.void], methods: Sequence[str]) -> None:
    spare = iter(SPARE_COLOURS * 3)
    of_round_off = []
    best: dict[float, tuple[float, float]] = {}  # strain -> smallest error and its bar
    for method in methods:
        rows = numpy.sort(table[table["method"] == method], order="strain")
        error = rows["error_mean_per_cell"]
        with numpy.errstate(invalid="ignore", divide="ignore"):
            bars = rows["error_bar_m"] * error / rows["error_mean_m"]  # in cell sides, too
        colour, label = METHODS.get(method) or (next(spare), method)
        axes.loglog(100.0 * rows["strain"], numpy.where(error > ROUND_OFF, error, numpy.nan), "o-",
                    color=colour, label=label, markersize=3.5)
        for strain_, value, bar in zip(rows["strain"], error, bars):
            best[strain_] = min(best.get(strain_, (numpy.inf, 0.0)), (value, bar))
        if len(rows) and not (error > ROUND_OFF).any():
            of_round_off.append(label)
    if of_round_off:
        axes.annotate(f"{', '.join(of_round_off)}: round-off", (0.97, 0.03), ha="right",
                      xycoords="axes fraction")
    if best:
        strains = numpy.array(sorted(best))
        bars = numpy.array([best[one][1] for one in strains])
        bottom = axes.get_ylim()[0]
        axes.fill_between(100.0 * strains, bottom, bars, where=bars > bottom, color="0.85", zorder=0)
        axes.set_ylim(bottom=bottom)
    axes.grid(color="0.9")
