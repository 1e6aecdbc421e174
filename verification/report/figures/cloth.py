# SPDX-License-Identifier: MIT
"""Cloth in motion: coarse, up-sampled, reference and error side by side at some times and close up.
"""
import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field

import numpy
from matplotlib import colormaps, pyplot
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch, Rectangle
from matplotlib.patheffects import withStroke

from figures import style
from figures.rendering import best_axes, bounds, camera_around, close_up, coloured, visible
from figures.sheet import unit_of
from read.drape_results import reference_member
from read.vtu import read_vtu

KINDS = ("coarse", "fine", "reference")
FRAMES = 4  # in the figure
PIXELS = 560  # width of a panel in the saved files
COARSE_COLOUR = (0.80, 0.84, 0.88)
FINE_COLOUR = (0.86, 0.80, 0.72)  # where no material is known
ERROR_MAP = "magma_r"  # as for sheets: light to dark for any colour vision and in print
ERROR_CONTRAST = 0.35  # little shading, so that a colour is found in its bar again
MOVING_FRAMES = 32  # of the animation, which one camera sees with the figure
CELLS_ACROSS = 5.0  # in the close-up
# Part of white in the colour of a phase, so that shading is seen on dark phases too.
PALER = 0.3
HALO = [withStroke(linewidth=2.5, foreground="white")]  # so that it is read on cloth too


@dataclass
class Film:
    """The frames of one variant and of one reference, matched in time."""

    variant: str
    reference: str = None  # None: no reference has frames
    # {"time", "coarse", "fine", "reference"}: paths, or None.
    shots: list = field(default_factory=list)


def film_of(cell, variants, references, duration):
    """The frames to show: of the first variant and the first reference that have any; None without.

    Frames belong together where their times agree to a thousandth of the duration.
    """
    variant = next(
        (v for v in variants if (v, "fine") in cell.frames or (v, "coarse") in cell.frames), None
    )
    if variant is None:
        return None
    reference = next((r for r in references if (reference_member(r), "fine") in cell.frames), None)
    lists = {
        "coarse": cell.frames.get((variant, "coarse"), []),
        "fine": cell.frames.get((variant, "fine"), []),
        "reference": cell.frames.get((reference_member(reference), "fine"), []) if reference else [],
    }
    times = [time for time, _ in lists["fine"] or lists["coarse"]]
    tolerance = 1e-3 * (duration or (times[-1] - times[0]))
    film = Film(variant, reference)
    for time in times:
        shot = {"time": time}
        for kind, frames in lists.items():
            near = min(frames, key=lambda frame, time=time: abs(frame[0] - time), default=None)
            shot[kind] = near[1] if near and abs(near[0] - time) <= tolerance else None
        film.shots.append(shot)
    return film


def spread(items, number):
    """At most so many items, at the ends of equal parts, the last one among them."""
    number = max(1, min(number, len(items)))
    return [items[round((i + 1) * len(items) / number) - 1] for i in range(number)]


def error_of(surface, reference):
    """Distance to the reference at each vertex (n) [m]; where the triangles differ, what its frame
    says; or None.
    """
    if reference is None:
        return None
    if numpy.array_equal(reference.triangles, surface.triangles):
        return numpy.linalg.norm(surface.points - reference.points, axis=1)
    stored = reference.point_data.get("error")
    return (
        None
        if stored is None or len(stored) != len(surface.points)
        else stored.reshape(-1).astype(float)
    )


def phase_colour_map(surfaces, names, stiffnesses=None):
    """Material number -> (colour, label), light is soft; empty without materials.

    @param names of the phases in the order of the numbers, or None
    @param stiffnesses of the phases in that order, or None: darker with the number
    """
    numbers = sorted(
        {int(n) for s in surfaces if s.material() is not None for n in numpy.unique(s.material())}
    )
    return {
        n: (
            numpy.array(to_rgb(colour)) * (1.0 - PALER) + PALER,
            names[n] if names and n < len(names) else f"material {n}",
        )
        for n, colour in style.colours_of_materials(numbers, stiffnesses).items()
    }


def fine_colours(surface, phases):
    material = surface.material()
    if material is None or not phases:
        return numpy.tile(FINE_COLOUR, (len(surface.triangles), 1))
    numbers, place = numpy.unique(material, return_inverse=True)
    return numpy.array([phases[int(n)][0] if int(n) in phases else FINE_COLOUR for n in numbers])[
        place
    ]


def panels(surface, kind, camera, pixels, phases, error=None, largest=1.0, bodies=None):
    """The rendered panels of one surface, as bytes (height, width, 4): itself, and coloured by its
    error where that is known.

    @return {kind: picture}
    """
    seen = visible(surface, camera, pixels, bodies)
    if kind == "coarse":
        images = {
            kind: coloured(seen, numpy.tile(COARSE_COLOUR, (len(surface.triangles), 1)), edge=0.9)
        }
    else:
        images = {kind: coloured(seen, fine_colours(surface, phases))}
    if error is not None:
        colours = colormaps[ERROR_MAP](error / (largest or 1.0))[:, :3]
        images["error"] = coloured(seen, colours, per_vertex=True, contrast=ERROR_CONTRAST)
    return {name: numpy.round(255.0 * image).astype(numpy.uint8) for name, image in images.items()}


def bounds_of(path, axes):
    return bounds(read_vtu(path), axes)


def moving_shots(film):
    """The times of the animation: the first, and the ends of equal parts."""
    return (
        film.shots[:1] + spread(film.shots[1:], MOVING_FRAMES)
        if len(film.shots) > 1
        else film.shots
    )


def cloth_figure(film, up, side, pool, cell=None, bodies=None):
    """Rows are times, columns are coarse, up-sampled, reference and error, all through one camera;
    last a close-up.

    @param side of a cell [m], or None: no close-up
    @param cell what drape.json says of it: `phases`, `phase_stiffness`
    @param bodies that the cloth meets, as a surface, or None
    @return (figure, camera, phases, {"largest" [m], "capped": whether errors exceed the colour bar,
            "close": whether there is a close-up})
    @throws BadFrame
    """
    # The first frame is the start, alike for all.
    shots = spread(film.shots[1:] or film.shots, FRAMES)
    surfaces = [{kind: read_vtu(shot[kind]) for kind in KINDS if shot[kind]} for shot in shots]
    axes = best_axes([s for kinds in surfaces for s in kinds.values()], up)
    paths = {shot[kind] for shot in shots + moving_shots(film) for kind in KINDS if shot[kind]}
    camera = camera_around(axes, list(pool.map(bounds_of, sorted(paths), [axes] * len(paths))))
    fine = [kinds[kind] for kinds in surfaces for kind in ("fine", "reference") if kind in kinds]
    cell = cell or {}
    phases = phase_colour_map(fine, cell.get("phases"), cell.get("phase_stiffness"))
    errors = [
        error_of(kinds["fine"], kinds.get("reference")) if "fine" in kinds else None
        for kinds in surfaces
    ]
    known = [e for e in errors if e is not None]
    largest = max((float(numpy.percentile(e, 99.5)) for e in known), default=0.0)
    capped = any(float(e.max()) > largest for e in known)
    columns = [
        (kind, title)
        for kind, title in (
            ("coarse", "coarse cloth"),
            ("fine", "up-sampled"),
            ("reference", f"reference ({film.reference})"),
        )
        if any(kind in kinds for kinds in surfaces)
    ]
    if known:
        columns.append(("error", "error per vertex"))
    rows = [
        (f"t = {style.three(float(shot['time']))} s", kinds, error, camera)
        for shot, kinds, error in zip(shots, surfaces, errors)
    ]
    near = None
    if side and "fine" in surfaces[-1] and CELLS_ACROSS * side < 0.7 * camera.extent[0]:
        near = close_up(camera, surfaces[-1]["fine"], CELLS_ACROSS * side)
        rows.append(("framed part", surfaces[-1], errors[-1], near))
    jobs = {}
    for row, (_, kinds, error, view) in enumerate(rows):
        for kind in kinds:
            jobs[row, kind] = pool.submit(
                panels,
                kinds[kind],
                kind,
                view,
                PIXELS,
                phases,
                error if kind == "fine" else None,
                largest,
                bodies,
            )
    images = {
        (row, name): image for (row, _), job in jobs.items() for name, image in job.result().items()
    }
    ratio = camera.extent[1] / camera.extent[0]
    width = 10.2 / 4.0
    figure, grid = pyplot.subplots(
        len(rows),
        len(columns),
        squeeze=False,
        layout="constrained",
        figsize=(width * len(columns) + 0.3, (width * ratio + 0.04) * len(rows) + 0.75),
    )
    figure.get_layout_engine().set(w_pad=0.01, h_pad=0.01, wspace=0.0, hspace=0.0)
    for row, (label, _, _, view) in enumerate(rows):
        half = 0.5 * view.extent
        for column, (kind, title) in enumerate(columns):
            axes = grid[row][column]
            axes.set(
                xticks=[],
                yticks=[],
                xlim=(-half[0], half[0]),
                ylim=(-half[1], half[1]),
                aspect="equal",
            )
            axes.grid(False)
            for spine in axes.spines.values():
                spine.set(visible=True, color="#D0D0D0", linewidth=0.6)
            if (row, kind) in images:
                axes.imshow(
                    images[row, kind],
                    extent=(-half[0], half[0], -half[1], half[1]),
                    interpolation="antialiased",
                )
            else:
                axes.text(0.0, 0.0, "no frame", ha="center", va="center", color="#666666")
            if row == 0:
                axes.set_title(title, loc="left", fontweight="bold")
            if near is not None and row == len(rows) - 2:
                axes.add_patch(
                    Rectangle(
                        near.centre - camera.centre - 0.5 * near.extent,
                        *near.extent,
                        fill=False,
                        edgecolor=style.BLACK,
                        lw=1.0,
                    )
                )
        grid[row][0].set_ylabel(label)
        if view is near or row == len(shots) - 1:
            scale_bar(grid[row][0], half)
    if known:
        factor, unit = unit_of(largest)
        scale = pyplot.Normalize(0.0, factor * largest if largest > 0.0 else 1.0)
        figure.colorbar(
            pyplot.cm.ScalarMappable(scale, ERROR_MAP),
            ax=grid[:, -1],
            location="bottom",
            shrink=0.9,
            aspect=22,
            pad=0.01,
            extend="max" if capped else "neither",
            label=f"|x up-sampled − x reference| [{unit}]",
        )
    if len(phases) > 1:
        figure.legend(
            handles=[
                Patch(facecolor=colour, edgecolor="#555555", label=label)
                for colour, label in phases.values()
            ],
            # Beside the colour bar, or below all.
            loc="lower left" if known else "upper left",
            bbox_to_anchor=(0.01, 0.0),
            ncol=len(phases),
        )
    return figure, camera, phases, {"largest": largest, "capped": capped, "close": near is not None}


def scale_bar(axes, half):
    """A bar of 1, 2 or 5 times a power of ten, about a quarter of the panel."""
    power = 10.0 ** numpy.floor(numpy.log10(0.6 * half[0]))
    length = max(f * power for f in (1.0, 2.0, 5.0) if f * power <= 0.6 * half[0] * (1.0 + 1e-9))
    factor, unit = (100.0, "cm") if 0.01 <= length < 1.0 else unit_of(length)
    left, low = -0.93 * half[0], -half[1] + 0.07 * min(half)
    axes.plot(
        [left, left + length],
        [low, low],
        color=style.BLACK,
        lw=2.0,
        solid_capstyle="butt",
        path_effects=HALO,
    )
    axes.annotate(
        f"{factor * length:.3g} {unit}",
        (left + 0.5 * length, low),
        xytext=(0, 2.5),
        textcoords="offset points",
        ha="center",
        fontsize=7.5,
        path_effects=HALO,
    )


def workers():
    """A pool of processes for rendering."""
    return ProcessPoolExecutor(max_workers=os.cpu_count() or 1)
