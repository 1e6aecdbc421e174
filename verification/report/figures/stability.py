# SPDX-License-Identifier: MIT
"""The Bloch margin of an infinite cloth against strain, the zone of its waves, and the wave that is
lost first, drawn on the cells over which it repeats.
"""
import cmath
import math

import numpy
from matplotlib import pyplot
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize
from matplotlib.patches import Wedge

from figures import style
from figures.cell import CM, cell_axes, phase_legend

MESHES = {"given": ("-", style.BLUE), "refined": ("--", style.VERMILLION)}
MARKERS = {"long": "s", "finite": "o"}
ZONE_COLOURS = "cividis"
LARGEST = 0.16  # displacement of a mode that is drawn, in sides of the cell
DISC = 0.057  # radius of the long waves in the middle of the zone
LONG_CELLS = 3  # that a long wave is drawn on, along each lattice vector


def margin_axes(axes, path):
    """beta against strain on both meshes, with the strains of first loss."""
    for mesh, (line, colour) in MESHES.items():
        rows = path.of_mesh(mesh)
        if not rows:
            continue
        points = sorted([(0.0, 1.0, None)] + [(r["strain"], r["beta"], r["waves"]) for r in rows])
        axes.plot(
            [100.0 * x for x, _, _ in points],
            [y for _, y, _ in points],
            line,
            color=colour,
            label=f"{mesh} mesh",
        )
        for waves, marker in MARKERS.items():
            some = [(x, y) for x, y, w in points if w == waves]
            if some:
                axes.plot(
                    [100.0 * x for x, _ in some],
                    [y for _, y in some],
                    marker,
                    color=colour,
                    markerfacecolor="white" if mesh == "refined" else colour,
                    label="_",
                )
    for way in path.ways():
        loss = path.loss(way, "refined") or path.loss(way)
        if loss is None or loss["outcome"] != "lost":
            continue
        at, bar = 100.0 * loss["strain"], 100.0 * loss["strain_bar"]
        axes.axvline(at, color="#7F7F7F", linewidth=0.9)
        if bar > 0:
            axes.axvspan(at - bar, at + bar, color="#7F7F7F", alpha=0.18, linewidth=0)
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    axes.set(xlabel="strain [%]", ylabel="margin β [–]")
    shown = {row["waves"] for row in path.levels if row["waves"]}
    for waves, words in (("finite", "lowest wave finite: a pattern"), ("long", "lowest wave long")):
        if waves in shown:
            axes.plot([], [], MARKERS[waves], color="#7F7F7F", label=words)
    axes.legend(loc="lower left", bbox_to_anchor=(-0.12, 1.0), ncol=2, columnspacing=1.0)


def values_of_zone(rows):
    """Value of each wave of an even division of the zone in eighths, −k as k."""
    values = {}
    for row in rows:
        if row["waves"] == "finite":
            for sign in (1, -1):
                k = tuple(round(24 * sign * row[key]) % 24 for key in ("k1", "k2"))
                values[k] = row["beta"]
    return values


def direction(angle, lattice):
    """Angle in the plane of k1, k2 of waves along a direction of the cloth [degrees]."""
    n = (math.cos(math.radians(angle)), math.sin(math.radians(angle)))
    k = numpy.asarray(lattice) @ numpy.array(n)
    return math.degrees(math.atan2(k[1], k[0]))


def zone_axes(figure, axes, rows, lattice, loss):
    """The zone: β of each wave, the long ones in the middle by their direction."""
    values = values_of_zone(rows)
    every = [row["beta"] for row in rows]
    norm = Normalize(min(every), max(every))
    map_ = pyplot.get_cmap(ZONE_COLOURS)
    ticks = numpy.arange(-4, 5)
    grid = numpy.array(
        [[values.get(((3 * i) % 24, (3 * j) % 24), math.nan) for i in ticks] for j in ticks]
    )
    mesh = axes.pcolormesh(ticks / 8, ticks / 8, grid, cmap=map_, norm=norm, shading="nearest")
    for (i, j), value in values.items():
        if i % 8 == 0 and j % 8 == 0 and (i, j) != (0, 0):
            place = [(x - 24 if x > 12 else x) / 24 for x in (i, j)]
            axes.plot(*place, "o", color=map_(norm(value)), markeredgecolor="white", markersize=6)
    for row in rows:
        if row["waves"] == "long":
            ends = [direction(row["angle_deg"] + d, lattice) for d in (-7.5, 7.5)]
            for turn in (0, 180):
                axes.add_patch(
                    Wedge(
                        (0, 0),
                        DISC,
                        ends[0] + turn,
                        ends[1] + turn,
                        color=map_(norm(row["beta"])),
                        linewidth=0,
                        zorder=4,
                    )
                )
    if loss["waves"] == "finite":
        k = [(loss[key] + 0.5) % 1.0 - 0.5 for key in ("k1", "k2")]
        places = {
            (sx * abs(k[0]) if abs(abs(k[0]) - 0.5) < 1e-9 else s * k[0],
             sy * abs(k[1]) if abs(abs(k[1]) - 0.5) < 1e-9 else s * k[1])
            for s in (1, -1) for sx in (1, -1) for sy in (1, -1)
        }
        for place in places:
            axes.plot(*place, "*", color=style.VERMILLION, markeredgecolor="white", markersize=13,
                      clip_on=False, zorder=5)
    else:
        angle = math.radians(direction(loss["angle_deg"], lattice))
        along = numpy.array([math.cos(angle), math.sin(angle)])
        for sign in (1, -1):
            axes.annotate(
                "",
                sign * 3.2 * DISC * along,
                sign * 1.2 * DISC * along,
                arrowprops={"arrowstyle": "-|>", "color": style.VERMILLION, "linewidth": 1.6},
                zorder=5,
            )
    axes.set(
        xlabel="$k_1$",
        ylabel="$k_2$",
        xlim=(-0.5625, 0.5625),
        ylim=(-0.5625, 0.5625),
        xticks=(-0.5, -0.25, 0, 0.25, 0.5),
        yticks=(-0.5, -0.25, 0, 0.25, 0.5),
        aspect="equal",
    )
    axes.grid(False)
    figure.colorbar(mesh, ax=axes, label="β [–]", shrink=0.78)


def jumps(cell, field):
    """By how much a field that is not periodic grows along each lattice vector: of two vertices of
    the cell that are images of each other.
    """
    sides = numpy.linalg.norm(cell.lattice, axis=1).min()
    result = []
    for vector in cell.lattice:
        for v, place in enumerate(cell.vertices):
            gap = numpy.linalg.norm(cell.vertices - (place + vector), axis=1)
            image = int(gap.argmin())
            if gap[image] < 1e-6 * sides:
                result.append(field[image] - field[v])
                break
    return result


def mode_axes(axes, cell, rows, loss):
    """The wave on the cells over which it repeats, at a size that can be seen; a long one on a few
    cells of its endless period.
    """
    rows = sorted(rows, key=lambda row: row["number"])
    place = numpy.array([[row["x_m"], row["y_m"]] for row in rows])
    wave = numpy.array(
        [
            [complex(row[f"{c}_real"], row[f"{c}_imaginary"]) for c in "uv"]
            for row in rows
        ]
    )
    is_long = loss["waves"] == "long"
    counts = (LONG_CELLS, LONG_CELLS) if is_long else (int(loss["cells_1"]), int(loss["cells_2"]))
    of_place, of_wave = jumps(cell, place), jumps(cell, wave)
    size = LARGEST * math.sqrt(abs(numpy.linalg.det(cell.lattice)))
    polygons, outlines, rims, colours = [], [], [], []
    holes = rims_of(cell)
    colour_of = {number: colour for number, colour, _ in phase_legend(cell)}
    blocks = []
    for i in range(counts[0]):
        for j in range(counts[1]):
            moved = wave
            if is_long:
                moved = wave + i * of_wave[0] + j * of_wave[1]
            else:
                moved = wave * cmath.exp(2j * math.pi * (i * loss["k1"] + j * loss["k2"]))
            blocks.append((place + i * of_place[0] + j * of_place[1], moved.real))
    if is_long:  # around the middle
        mean = numpy.mean([m.mean(axis=0) for _, m in blocks], axis=0)
        blocks = [(p, m - mean) for p, m in blocks]
    largest = max(numpy.linalg.norm(m, axis=1).max() for _, m in blocks)
    factor = size / largest
    if is_long:  # grown over its cells, as long as what repeats in each stays as small
        even = cell.vertices @ numpy.linalg.inv(cell.lattice) @ numpy.array(of_wave)
        within = (wave - even).real
        within = numpy.linalg.norm(within - within.mean(axis=0), axis=1).max()
        factor = min(max(counts) * factor, size / within if within > 0 else math.inf)
    for points, moved in blocks:
        there = CM * (points + factor * moved)
        polygons += [there[t] for t in cell.triangles]
        colours += [colour_of[int(m)] for m in cell.material]
        for k in (0, 1):  # the sides of the cell where they are in the mesh
            outlines += sides_of(cell, there, k)
        rims += [there[list(edge)] for edge in holes]
    axes.add_collection(PolyCollection(polygons, facecolors=colours, edgecolors=colours,
                                       linewidths=0.2))
    axes.add_collection(LineCollection(rims, colors="#7F7F7F", linewidths=0.8))
    axes.add_collection(LineCollection(outlines, colors=style.BLACK, linewidths=0.8))
    cell_axes(axes, numpy.vstack([numpy.asarray(p) for p in polygons]) / CM)


def rims_of(cell):
    """Edges of the mesh that belong to one triangle: the sides of the cell, and its holes."""
    count = {}
    for t in cell.triangles:
        for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
            edge = (min(a, b), max(a, b))
            count[edge] = count.get(edge, 0) + 1
    return sorted(edge for edge, n in count.items() if n == 1)


def sides_of(cell, points, k):
    """Those on the two sides of the cell along lattice vector k."""
    parts = cell.vertices @ numpy.linalg.inv(cell.lattice)
    parts = parts - parts.min(axis=0)
    edges = []
    for a, b in rims_of(cell):
        x = (parts[a][1 - k], parts[b][1 - k])
        if max(x) < 1e-6 or min(x) > parts[:, 1 - k].max() - 1e-6:
            edges.append((a, b))
    return [points[list(edge)] for edge in edges]


def shown_way(path):
    """The way whose zone and mode are drawn: the one that is lost first, or else the first."""
    lost = [row for row in path.losses if row["mesh"] == "given" and row["outcome"] == "lost"]
    if lost:
        return min(lost, key=lambda row: abs(row["strain"]))["way"]
    return path.ways()[0] if path.ways() else None


def stability_figure(path, cell):
    """Margin, zone and mode of one load of one cell.

    @param cell Cell, or None where its picture cannot be drawn
    """
    way = shown_way(path)
    rows = [row for row in path.waves if row["way"] == way]
    mode = [row for row in path.mode if row["way"] == way]
    has_cell = cell is not None and cell.vertices is not None
    has_zone = bool(rows) and has_cell
    has_mode = has_zone and len(mode) == len(cell.vertices)
    figure, grid = pyplot.subplots(
        1, 1 + has_zone + has_mode, squeeze=False, layout="constrained",
        figsize=(3.6 + 3.9 * has_zone + 3.3 * has_mode, 3.5),
    )
    margin_axes(grid[0][0], path)
    if has_zone:
        zone_axes(figure, grid[0][1], rows, cell.lattice, path.loss(way))
        if has_mode:
            mode_axes(grid[0][2], cell, mode, path.loss(way))
    return figure
