# SPDX-License-Identifier: MIT
"""Pictures of the unit cell: its phases, and its three characteristic displacements."""
import numpy
from matplotlib import pyplot
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Patch

from figures import style

CM = 100.0  # lengths are drawn in centimetres
LOADS = ("11", "22", "12")


def phase_stiffness(phase):
    """What orders phases from soft to stiff: trace of c [N/m], or modulus times thickness."""
    try:
        return float(numpy.trace(numpy.array(phase["C"], dtype=float)))
    except (KeyError, TypeError, ValueError):
        try:
            return float(phase["E1"]) * float(phase.get("thickness", 1.0))
        except (KeyError, TypeError, ValueError):
            return 0.0


def phase_legend(cell, material=None):
    """(material number, colour, label) of each phase, softest first.

    The phases of cell.json stand in the order of the material numbers; where their count differs
    from what the mesh holds, the numbers are all that is known.
    """
    numbers = [int(k) for k in numpy.unique(cell.material if material is None else material)]
    phases = cell.phases or []
    if len(phases) != len(numbers):
        colours = style.phase_colours(numbers)
        return [(number, colour, f"material {number}") for number, colour in zip(numbers, colours)]
    colours = style.phase_colours([phase_stiffness(phase) for phase in phases])
    entries = []
    for number, phase, colour in zip(numbers, phases, colours):
        entries.append((phase_stiffness(phase), number, colour, str(phase.get("name", number))))
    return [entry[1:] for entry in sorted(entries, key=lambda entry: entry[0])]


def cell_axes(axes, points):
    """Centimetres on both axes, equal scales, a frame close to the points."""
    low, high = CM * points.min(axis=0), CM * points.max(axis=0)
    pad = 0.06 * (high - low).max()
    axes.set(
        xlim=(low[0] - pad, high[0] + pad),
        ylim=(low[1] - pad, high[1] + pad),
        aspect="equal",
        xlabel="axis 1 [cm]",
        ylabel="axis 2 [cm]",
    )
    axes.grid(False)


def phase_figure(cell):
    """The cell with its mesh, coloured by phase, and its lattice vectors as arrows."""
    figure, axes = pyplot.subplots(figsize=(5.6, 4.1), layout="constrained")
    legend = phase_legend(cell)
    colour = {number: value for number, value, _ in legend}
    axes.add_collection(
        PolyCollection(
            CM * cell.vertices[cell.triangles],
            facecolors=[colour[int(k)] for k in cell.material],
            edgecolors="#55555599",
            linewidths=0.25,
        )
    )
    cell_axes(axes, cell.vertices)
    corner = cell.vertices[numpy.argmin(cell.vertices.sum(axis=1))]
    for name, vector in zip(("$a_1$", "$a_2$"), cell.lattice):
        axes.annotate(
            "",
            CM * (corner + vector),
            CM * corner,
            annotation_clip=False,
            zorder=6,
            arrowprops={
                "arrowstyle": "-|>",
                "color": style.BLACK,
                "lw": 1.1,
                "shrinkA": 0,
                "shrinkB": 0,
            },
        )
        axes.annotate(
            name,
            CM * (corner + 1.02 * vector),
            annotation_clip=False,
            fontsize=10,
            zorder=7,
            xytext=(5, 4),
            textcoords="offset points",
        )
    figure.legend(
        handles=[
            Patch(facecolor=value, edgecolor="#555555", label=label) for _, value, label in legend
        ],
        loc="upper left",
        bbox_to_anchor=(1.0, 0.95),
    )
    return figure


def characteristic_figure(cell):
    """chi_11, chi_22, chi_12: the cell displaced by chi, exaggerated, coloured by |chi|.

    Each panel has its own exaggeration, chosen so that the largest displacement is a tenth of the
    cell; the outline of the resting cell is drawn behind.
    """
    figure, grid = pyplot.subplots(1, 3, figsize=(9.6, 3.7), layout="constrained")
    size = cell.side
    outline = boundary(cell.triangles)
    for axes, a in zip(grid, range(3)):
        chi = cell.chi[:, :, a]
        length = numpy.linalg.norm(chi, axis=1)
        largest = length.max()
        vanishes = largest < style.ROUND_OFF * size
        factor = 1.0 if vanishes else 0.1 * size / largest
        moved = cell.vertices + factor * chi
        face = length[cell.triangles].mean(axis=1)
        for points, line in ((cell.vertices, (0, (3, 2))), (moved, "-")):
            axes.add_collection(
                LineCollection(
                    CM * points[outline], colors="#777777", linewidths=0.8, linestyles=[line]
                )
            )
        mesh = PolyCollection(
            CM * moved[cell.triangles],
            array=CM * face,
            cmap="viridis",
            edgecolors="#FFFFFF60",
            linewidths=0.3,
            rasterized=True,
        )
        mesh.set_clim(0.0, CM * largest if not vanishes else 1.0)
        axes.add_collection(mesh)
        axes.add_collection(
            LineCollection(CM * moved[phase_edges(cell)], colors="white", linewidths=0.9)
        )
        cell_axes(axes, numpy.vstack([cell.vertices, moved]))
        axes.set_title(
            f"$\\chi_{{{LOADS[a]}}}$"
            + (": zero" if vanishes else f", drawn {style.three(float(factor))} times"),
            loc="left",
        )
        if axes is not grid[0]:
            axes.set_ylabel("")
        figure.colorbar(
            mesh, ax=axes, location="bottom", shrink=0.9, pad=0.02, label="|χ| [cm per unit strain]"
        )
    return figure


def edge_list(triangles):
    """Edges (3m,2) with their triangles (3m), lower vertex first, sorted."""
    edges = numpy.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    owner = numpy.repeat(numpy.arange(len(triangles)), 3)
    order = numpy.lexsort(edges.T[::-1])
    return edges[order], owner[order]


def boundary(triangles):
    """Edges (k,2) that belong to one triangle."""
    edges, _ = edge_list(triangles)
    unique, count = numpy.unique(edges, axis=0, return_counts=True)
    return unique[count == 1]


def phase_edges(mesh):
    """Edges (k,2) between two materials of anything with `triangles` and `material`."""
    edges, owner = edge_list(mesh.triangles)
    twin = numpy.flatnonzero((edges[1:] == edges[:-1]).all(axis=1))
    differ = mesh.material[owner[twin]] != mesh.material[owner[twin + 1]]
    return edges[twin[differ]]
