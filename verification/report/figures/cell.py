# SPDX-License-Identifier: MIT
"""Pictures of the unit cell: its phases, and its three characteristic displacements."""
import numpy
from matplotlib import pyplot
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures import style
from figures.plot_data import label_of

CM = 100.0  # lengths are drawn in centimetres
LOADS = ("11", "22", "12")
AXIS_LENGTH = 0.7  # of the axis of a material that is drawn, over the root of the area of its patch
LONGEST_AXIS = 0.25  # of the cell side


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
    return [
        (number, colour, label_of(name))
        for _, number, colour, name in sorted(entries, key=lambda entry: entry[0])
    ]


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


def patches(mesh):
    """A number (m) of each triangle: those of one material that hang together have the same."""
    owner = numpy.arange(len(mesh.triangles))

    def root(k):
        while owner[k] != k:
            owner[k] = owner[owner[k]]
            k = owner[k]
        return k

    edges, of = edge_list(mesh.triangles)
    for i in numpy.flatnonzero((edges[1:] == edges[:-1]).all(axis=1)):
        if mesh.material[of[i]] == mesh.material[of[i + 1]]:
            owner[root(of[i])] = root(of[i + 1])
    return numpy.array([root(k) for k in range(len(owner))])


def axes_of_materials(cell):
    """Segments (k,2,2) [m] along axis 1 of the materials that have axes, one in each patch."""
    numbers = [int(k) for k in numpy.unique(cell.material)]
    if len(numbers) != len(cell.phases or []):
        return numpy.zeros((0, 2, 2))
    angles = {
        number: numpy.radians(float(phase["angle"]))
        for number, phase in zip(numbers, cell.phases)
        if phase.get("E1") != phase.get("E2") and isinstance(phase.get("angle"), (int, float))
    }
    corners = cell.vertices[cell.triangles]
    centres = corners.mean(axis=1)
    sides = corners[:, 1:] - corners[:, :1]
    areas = 0.5 * numpy.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
    patch, segments = patches(cell), []
    for one in numpy.unique(patch):
        inside = numpy.flatnonzero(patch == one)
        angle = angles.get(int(cell.material[inside[0]]))
        if angle is not None:
            middle = numpy.average(centres[inside], axis=0, weights=areas[inside])
            nearest = inside[numpy.argmin(numpy.linalg.norm(centres[inside] - middle, axis=1))]
            along = numpy.array([numpy.cos(angle), numpy.sin(angle)])
            half = min(AXIS_LENGTH * areas[inside].sum() ** 0.5, LONGEST_AXIS * cell.side) / 2.0
            segments.append([centres[nearest] - half * along, centres[nearest] + half * along])
    return numpy.array(segments).reshape(-1, 2, 2)


def draw_axes_of_materials(axes, cell):
    """Short lines along axis 1 of the materials, dark with a light edge: seen on any phase."""
    segments = CM * axes_of_materials(cell)
    for colour, width in (("white", 2.4), (style.BLACK, 0.9)):
        axes.add_collection(LineCollection(segments, colors=colour, linewidths=width, zorder=4))
    return len(segments) > 0


def draw_phases(axes, cell):
    """The cell with its mesh, coloured by phase, lattice vectors as arrows, axes of materials."""
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
    draw_axes_of_materials(axes, cell)
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
            name.replace("$", "").replace("_1", "₁").replace("_2", "₂"),
            CM * (corner + 1.02 * vector),
            annotation_clip=False,
            style="italic",
            zorder=7,
            xytext=(5, 4),
            textcoords="offset points",
        )


def phase_figure(cell):
    """draw_phases() with a legend beside it."""
    figure, axes = pyplot.subplots(figsize=(5.6, 4.1), layout="constrained")
    draw_phases(axes, cell)
    handles = [
        Patch(facecolor=value, edgecolor="#555555", label=label)
        for _, value, label in phase_legend(cell)
    ]
    if len(axes_of_materials(cell)):
        handles.append(Line2D([], [], color=style.BLACK, lw=0.9, label="axis 1 of the material"))
    figure.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 0.95))
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
