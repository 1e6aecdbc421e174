# SPDX-License-Identifier: MIT
"""The sheet at one strain: fine reference, up-sampled sheet and the error per vertex, with a
close-up.

A sheet at full size has 288,000 triangles: they are drawn into an image once, and the image is
placed on the axes, so that the files stay small and quick.
"""
from types import SimpleNamespace

import numpy
from matplotlib import colormaps, pyplot, tri
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from matplotlib.transforms import Affine2D

from figures import style
from figures.cell import CM, boundary, phase_edges, phase_legend

PIXELS = 760  # along the longer side of a panel
CELLS_IN_CLOSE_UP = 3


def raster(points, triangles, values, largest, cmap, extent):
    """An RGBA image over (left, right, bottom, top): a value per vertex, from zero to the largest.
    """
    left, right, bottom, top = extent
    longer = max(right - left, top - bottom)
    size = [PIXELS * (right - left) / longer / 100.0, PIXELS * (top - bottom) / longer / 100.0]
    canvas = FigureCanvasAgg(Figure(figsize=size, dpi=100, facecolor="none"))
    renderer = canvas.get_renderer()
    pixels = (points - [left, bottom]) * (PIXELS / longer)
    colours = colormaps[cmap](values / (largest or 1.0))
    # Straight to the renderer: an artist would make an object of each triangle first, ten times
    # slower.
    renderer.draw_gouraud_triangles(
        renderer.new_gc(), pixels[triangles], colours[triangles], Affine2D()
    )
    return numpy.array(canvas.buffer_rgba())


def coarse_positions(sheet):
    """The motion of the coarse mesh at all fine vertices (n,2) [m]: linear in each coarse triangle.

    A fine vertex on the border may lie outside by round-off; it takes the nearest coarse triangle's
    map through its nearest coarse vertex.
    """
    mesh = tri.Triangulation(*sheet["coarse_rest"].T, sheet["coarse_triangles"])
    finder = mesh.get_trifinder()
    rest = sheet["rest"]
    centre = sheet["coarse_rest"].mean(axis=0)
    owner = finder(*rest.T)
    for shrink in (1e-9, 1e-6, 1e-3):  # towards the middle, for vertices on the border alone
        outside = owner < 0
        if outside.any():
            owner[outside] = finder(*(rest[outside] + shrink * (centre - rest[outside])).T)
    owner = numpy.maximum(owner, 0)
    corners = sheet["coarse_triangles"][owner]
    a, b, c = (sheet["coarse_rest"][corners[:, i]] for i in range(3))
    matrix = numpy.stack([b - a, c - a], axis=2)
    weights = numpy.linalg.solve(matrix, (rest - a)[:, :, None])[:, :, 0]
    weights = numpy.column_stack([1.0 - weights.sum(axis=1), weights])
    return numpy.einsum("nk,nkc->nc", weights, sheet["coarse"][corners])


def unit_of(largest):
    """(factor, unit) that brings a length in metres to between 1 and 1000, as far as there is one.
    """
    for limit, factor, unit in ((1e-6, 1e9, "nm"), (1e-3, 1e6, "µm"), (1.0, 1e3, "mm")):
        if largest < limit:
            return factor, unit
    return 1.0, "m"


def close_up_triangles(sheet, side):
    """Triangles of a few cells next to the middle of the sheet, and of their rest rectangle the
    corners.

    The middle is far from the clamped edges; what happens there is the method's own error.
    """
    rest = sheet["rest"]
    low, high = rest.min(axis=0), rest.max(axis=0)
    size = numpy.minimum(CELLS_IN_CLOSE_UP * side, high - low)
    start = low + side * numpy.round((high - low - size) / 2.0 / side)
    middle = rest[sheet["triangles"]].mean(axis=1)
    inside = numpy.flatnonzero(((middle > start) & (middle < start + size)).all(axis=1))
    return inside if inside.size else numpy.arange(len(middle))


def image(axes, pixels, extent):
    axes.imshow(pixels, extent=[CM * e for e in extent], interpolation="none", aspect="equal")
    axes.grid(False)


def bar(figure, axes, largest, factor, unit, cmap, label):
    """A colour bar from zero to the largest value."""
    scale = pyplot.Normalize(0.0, factor * largest if largest > 0 else 1.0)
    figure.colorbar(
        pyplot.cm.ScalarMappable(scale, cmap),
        ax=axes,
        location="bottom",
        shrink=0.86,
        pad=0.02,
        label=f"{label} [{unit}]",
    )


class WholeSheet:
    """What is drawn of a stored sheet: distances at its vertices [m], and the frame around it."""

    def __init__(self, sheet):
        self.sheet = sheet
        coarse = coarse_positions(sheet)
        self.beyond = {
            key: numpy.linalg.norm(sheet[key] - coarse, axis=1)
            for key in ("reference", "upsampled")
        }
        self.error = numpy.linalg.norm(sheet["upsampled"] - sheet["reference"], axis=1)
        everything = numpy.vstack([sheet["reference"], sheet["upsampled"]])
        low, high = everything.min(axis=0), everything.max(axis=0)
        pad = 0.02 * (high - low).max()
        self.extent = (low[0] - pad, high[0] + pad, low[1] - pad, high[1] + pad)

    @property
    def ratio(self):
        """Height over width."""
        left, right, bottom, top = self.extent
        return (top - bottom) / (right - left)


BARS = ("beyond the coarse mesh |x − coarse x|", "|x up-sampled − x reference|")
SHORT = ("from coarse", "distance")  # of narrow panels


def draw_whole(figure, line, whole, titles, bars=BARS):
    """Reference, up-sampled and error over the whole sheet, into three axes.

    Colour of the first two is what the coarse mesh alone lacks, on one scale.
    """
    sheet, extent, triangles = whole.sheet, whole.extent, whole.sheet["triangles"]
    # A high percentile, not the maximum: one vertex in a clamped corner would darken all others.
    largest = float(numpy.percentile(whole.beyond["reference"], 99.5))
    factor, unit = unit_of(largest)
    for axes, key in zip(line, ("reference", "upsampled")):
        picture = raster(sheet[key], triangles, whole.beyond[key], largest, "viridis", extent)
        image(axes, picture, extent)
    for axes in line[:2]:
        bar(figure, axes, largest, factor, unit, "viridis", bars[0])
    largest_error = float(numpy.percentile(whole.error, 99.5))
    error_factor, error_unit = unit_of(largest_error)
    picture = raster(sheet["upsampled"], triangles, whole.error, largest_error, "magma_r", extent)
    image(line[2], picture, extent)
    bar(figure, line[2], largest_error, error_factor, error_unit, "magma_r", bars[1])
    for axes, title in zip(line, titles):
        axes.set_title(title, loc="left", fontweight="bold")


def small_sheet_figure(sheet):
    """The three panels of the whole sheet alone, for a first screen.

    @return (figure, mean error [m])
    """
    whole = WholeSheet(sheet)
    figure, grid = pyplot.subplots(
        1, 3, figsize=(5.2, 1.55 * whole.ratio + 0.95), sharey=True, layout="constrained"
    )
    method = style.PAPER if sheet["method"] == "localized" else style.HOMESPUN
    draw_whole(figure, grid, whole, ("reference", method, "error"), SHORT)
    for axes in grid:
        axes.set_xlabel("axis 1 [cm]")
    grid[0].set_ylabel("axis 2 [cm]")
    return figure, float(whole.error.mean())


def sheet_figure(cell, sheet, side):
    """Six panels: above reference, up-sampled and error over the whole sheet; below the close-up.

    Colour above is what the coarse mesh alone lacks: the distance of a vertex from where it puts
    it.
    @return (figure, {"error_mean", "error_max", "affine_mean"} [m])
    """
    triangles = sheet["triangles"]
    whole = WholeSheet(sheet)
    extent = whole.extent

    close = close_up_triangles(sheet, side)
    near = numpy.vstack(
        [sheet[key][triangles[close]].reshape(-1, 2) for key in ("reference", "upsampled")]
    )
    near_low, near_high = near.min(axis=0), near.max(axis=0)
    near_pad = 0.03 * (near_high - near_low).max()
    near_extent = (
        near_low[0] - near_pad,
        near_high[0] + near_pad,
        near_low[1] - near_pad,
        near_high[1] + near_pad,
    )

    ratio = (extent[3] - extent[2]) / (extent[1] - extent[0])
    near_ratio = (near_extent[3] - near_extent[2]) / (near_extent[1] - near_extent[0])
    figure, grid = pyplot.subplots(
        2,
        3,
        figsize=(10.2, 3.05 * (ratio + near_ratio) + 2.3),
        height_ratios=(3.05 * ratio + 0.9, 3.05 * near_ratio + 0.6),
        layout="constrained",
    )
    draw_whole(
        figure,
        grid[0],
        whole,
        (
            f"fine reference ({sheet['reference_law']})",
            f"up-sampled ({sheet['method']})",
            "error per vertex",
        ),
    )

    draw_close_up(figure, grid[1], cell, sheet, close, near_extent)
    for axes in grid[0]:
        axes.add_patch(
            Rectangle(
                (CM * near_low[0], CM * near_low[1]),
                *(CM * (near_high - near_low)),
                fill=False,
                edgecolor=style.BLACK,
                lw=1.0,
            )
        )
    for line in grid:
        for axes in line:
            axes.set_xlabel("axis 1 [cm]")
        line[0].set_ylabel("axis 2 [cm]")
    return figure, {
        "error_mean": float(whole.error.mean()),
        "error_max": float(whole.error.max()),
        "affine_mean": float(whole.beyond["reference"].mean()),
    }


def hole_edges(every, some):
    """Edges (k,2) of some triangles that are an edge of the whole sheet: its outline and holes."""
    whole = {tuple(edge) for edge in numpy.sort(boundary(every), axis=1)}
    edges = numpy.sort(boundary(some), axis=1)
    return numpy.array([e for e in edges if tuple(e) in whole], dtype=int).reshape(-1, 2)


def draw_close_up(figure, line, cell, sheet, close, extent):
    """A few cells coloured by phase, and the outlines of phases and coarse triangles of both."""
    triangles = sheet["triangles"][close]
    legend = phase_legend(cell, sheet["material"])
    colour = {number: value for number, value, _ in legend}
    faces = [colour[int(k)] for k in sheet["material"][close]]
    edges = phase_edges(SimpleNamespace(triangles=triangles, material=sheet["material"][close]))
    edges = numpy.vstack([edges, hole_edges(sheet["triangles"], triangles)])
    for axes, key, title in zip(
        line, ("reference", "upsampled"), ("close-up: reference", "close-up: up-sampled")
    ):
        axes.add_collection(
            PolyCollection(
                CM * sheet[key][triangles],
                facecolors=faces,
                edgecolors="face",
                linewidths=0.5,
                rasterized=True,
            )
        )
        axes.add_collection(
            LineCollection(CM * sheet[key][edges], colors="#444444", linewidths=0.6)
        )
        axes.set_title(title, loc="left")
    line[2].add_collection(
        LineCollection(CM * sheet["reference"][edges], colors=style.BLACK, linewidths=1.8)
    )
    line[2].add_collection(
        LineCollection(CM * sheet["upsampled"][edges], colors=style.ORANGE, linewidths=0.9)
    )
    coarse_edges = tri.Triangulation(*sheet["coarse"].T, sheet["coarse_triangles"]).edges
    line[2].add_collection(
        LineCollection(
            CM * sheet["coarse"][coarse_edges],
            colors="#9A9A9A",
            linewidths=0.6,
            linestyles=[(0, (3, 2))],
            zorder=0,
        )
    )
    line[2].set_title("edges of phases and holes, both", loc="left")
    for axes in line:
        axes.set(
            xlim=(CM * extent[0], CM * extent[1]),
            ylim=(CM * extent[2], CM * extent[3]),
            aspect="equal",
        )
        axes.grid(False)
    handles = [
        Patch(facecolor=value, edgecolor="#555555", label=label) for _, value, label in legend
    ]
    handles += [
        Line2D([], [], color=style.BLACK, lw=1.8, label="reference"),
        Line2D([], [], color=style.ORANGE, lw=1.2, label="up-sampled"),
        Line2D([], [], color="#9A9A9A", lw=0.8, ls=(0, (3, 2)), label="coarse mesh"),
    ]
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=len(handles))
