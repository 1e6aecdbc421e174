# SPDX-License-Identifier: MIT
"""Bending stiffness along each direction among measured fabrics, and the deflections of a cell."""
import numpy
from matplotlib import pyplot
from matplotlib.collections import LineCollection

from figures import fabrics, style
from figures.cell import CM, LOADS, cell_axes, phase_edges
from figures.stiffness import directional_modulus, polar_frame

MICRO = 1e6  # bending stiffness is drawn in 1e-6 N m


def bending_polar_figure(homogenize):
    """Stiffness of narrow strips cut along each direction, 1/(m:S:m) with S = D^-1, between the
    sides of its bracket, and the measured fabrics as a band.
    """
    angles = numpy.linspace(0.0, 2.0 * numpy.pi, 721)
    figure, axes = pyplot.subplots(
        figsize=(5.2, 4.4), subplot_kw={"projection": "polar"}, layout="constrained"
    )
    softest, stiffest = fabrics.band()
    axes.fill_between(
        angles,
        MICRO * softest,
        MICRO * stiffest,
        color="#BDBDBD",
        alpha=0.45,
        lw=0,
        label=f"{len(fabrics.BENDING)} measured fabrics",
    )
    for key, label, colour, line, width in (
        ("D_upper", "upper side", style.VERMILLION, "--", 1.3),
        ("D", "$D^H$", style.BLUE, "-", 2.2),
        ("D_lower", "lower side", style.GREEN, "-.", 1.3),
    ):
        if homogenize.get(key) is None:
            continue
        matrix = numpy.array(homogenize[key], dtype=float)
        if numpy.linalg.eigvalsh((matrix + matrix.T) / 2).min() <= 0:
            continue
        axes.plot(
            angles,
            MICRO * directional_modulus(matrix, angles),
            line,
            color=colour,
            lw=width,
            label=label,
        )
    # Cells may be softer and stiffer than all fabrics by orders of magnitude.
    largest = MICRO * float(directional_modulus(numpy.array(homogenize["D"], dtype=float), angles).max())
    polar_frame(axes, "bending stiffness of a strip [10⁻⁶ N m]")
    axes.set_rlim(0.0, 1.05 * max(largest, MICRO * softest))
    figure.legend(loc="upper left", bbox_to_anchor=(1.0, 0.95))
    return figure


def roll_figure(rolled):
    """The least radius of a roll along each direction, `rolled` of homogenize.json."""
    angles = numpy.radians(rolled["degrees_from_x"])
    radius = CM * numpy.array(rolled["least_radius_m"], dtype=float)
    figure, axes = pyplot.subplots(
        figsize=(5.2, 4.4), subplot_kw={"projection": "polar"}, layout="constrained"
    )
    axes.plot(
        numpy.concatenate([angles, angles + numpy.pi, angles[:1]]),
        numpy.concatenate([radius, radius, radius[:1]]),
        color=style.BLUE,
        lw=2.2,
    )
    polar_frame(axes, "least radius [cm]")
    axes.set_rlim(0.0, 1.05 * float(radius.max()) or 1.0)
    return figure


def deflection_figure(cell):
    """w_11, w_22, w_12: how far the cell leaves the parabola of its macro curvature, per unit
    curvature, by colour.
    """
    figure, grid = pyplot.subplots(1, 3, figsize=(9.6, 3.7), layout="constrained")
    for axes, a in zip(grid, range(3)):
        w = cell.deflection[:, a]
        largest = float(numpy.abs(w).max())
        vanishes = largest < style.ROUND_OFF * cell.side**2
        shade = axes.tripcolor(
            CM * cell.vertices[:, 0],
            CM * cell.vertices[:, 1],
            cell.triangles,
            CM * CM * (0.0 * w if vanishes else w),
            shading="gouraud",
            cmap="RdBu_r",
            rasterized=True,
        )
        shade.set_clim(*((-1.0, 1.0) if vanishes else CM * CM * largest * numpy.array([-1, 1])))
        axes.add_collection(
            LineCollection(CM * cell.vertices[phase_edges(cell)], colors="#222222", linewidths=0.7)
        )
        cell_axes(axes, cell.vertices)
        axes.set_title(f"$w_{{{LOADS[a]}}}$" + (": zero" if vanishes else ""), loc="left")
        if axes is not grid[0]:
            axes.set_ylabel("")
        figure.colorbar(
            shade,
            ax=axes,
            location="bottom",
            shrink=0.9,
            pad=0.02,
            label="w [cm² = cm per unit curvature 1/cm]",
        )
    return figure
