# SPDX-License-Identifier: MIT
"""Curves of an infinite cloth under given stresses and strains."""
import numpy
from matplotlib import pyplot

from figures import style
from read.load_results import COMPONENTS

METHOD_LINES = {"resolved": ("-", "o"), "coarse": ("--", None)}
MEASURED_MARKERS = ("D", "s", "^", "v")
ROUND_OFF = 1e-9  # of the largest stress or strain of a run: what is smaller is not drawn as physics


def known(paths, key):
    """Components of which some value is larger than its bar and than round-off."""
    sizes = {
        c: max((abs(v) for path in paths for v in path.column(key.format(c))), default=0.0)
        for c in COMPONENTS
    }
    bars = {
        c: max((b for path in paths for b in path.column(bar_key(key.format(c))) if b > 0), default=0.0)
        for c in COMPONENTS
    }
    least = ROUND_OFF * max(sizes.values())
    return {c: sizes[c] for c in COMPONENTS if sizes[c] > max(least, bars[c])}


def panels(paths):
    """(x key, x label, y key, y label) of each: stress of a component against its own strain, or
    against the strain that drives the path where its own is held; the strain of a component that
    is free of stress. What lies within its bar around zero has no panel.
    """
    strained, stressed = known(paths, "strain_{}"), known(paths, "stress_{}_N_per_m")
    driver = max(
        strained.keys() & stressed.keys() or strained or COMPONENTS[:1],
        key=lambda c: stressed.get(c, 0.0) * strained.get(c, 0.0),
    )
    result = []
    for c in COMPONENTS:
        x = c if c in strained and c in stressed else driver
        if c in stressed:
            result.append(
                (f"strain_{x}", f"strain {x} [%]", f"stress_{c}_N_per_m", f"stress {c} [N/m]")
            )
        elif c in strained:
            result.append((f"strain_{x}", f"strain {x} [%]", f"strain_{c}", f"strain {c} [%]"))
    return result


def bar_key(key):
    """The column of the bar of a column."""
    return key.replace("_N_per_m", "_bar_N_per_m") if "_N_per_m" in key else f"{key}_bar"


def scaled(rows, key, factor=1.0):
    return factor * numpy.array([row[key] for row in rows], dtype=float)


def shade(axes, rows, across, up, colour):
    """The bar of what is not prescribed: up and down, or to both sides."""
    (x, x_key), (y, y_key) = across, up
    of_x = scaled(rows, bar_key(x_key), 100.0)
    of_y = scaled(rows, bar_key(y_key), 100.0 if y_key.startswith("strain") else 1.0)
    look = {"color": colour, "alpha": 0.2, "linewidth": 0}
    if numpy.isfinite(of_y).all() and of_y.any():
        axes.fill_between(x, y - of_y, y + of_y, **look)
    elif numpy.isfinite(of_x).all() and of_x.any():
        axes.fill_betweenx(y, x - of_x, x + of_x, **look)


def load_figure(load, cell):
    """All paths of a cell, with bars, and the measured curves on the axes that they have."""
    paths = load.of(cell)
    chosen = panels(paths)
    figure, grid = pyplot.subplots(
        1,
        len(chosen),
        squeeze=False,
        layout="constrained",
        figsize=(0.6 + 3.4 * len(chosen), 3.3),
    )
    for axes, (x, xlabel, y, ylabel) in zip(grid[0], chosen):
        of_y = 100.0 if y.startswith("strain") else 1.0
        for path in paths:
            line, marker = METHOD_LINES.get(path.method, (":", None))
            rows = [{key: 0.0 for key in (x, y, bar_key(x), bar_key(y))}] + path.rows
            colour = style.law_style(path.law)[2]
            across, values = scaled(rows, x, 100.0), scaled(rows, y, of_y)
            axes.plot(
                across,
                values,
                line if path.law != "linear" else ":",
                color=colour,
                marker=marker if path.law != "linear" else None,
                markersize=3,
                markerfacecolor="white",
                label=f"{path.law}, {path.method}",
            )
            if path.method == "resolved" and path.law != "linear":
                shade(axes, rows, (across, x), (values, y), colour)
        for marker, (curve, rows) in zip(MEASURED_MARKERS * len(load.measured), load.measured.items()):
            points = numpy.array([[row[x], row[y]] for row in rows], dtype=float)
            points = points[numpy.isfinite(points).all(axis=1)]
            if len(points):
                axes.plot(
                    100.0 * points[:, 0],
                    of_y * points[:, 1],
                    marker,
                    color=style.GREEN,
                    markersize=5,
                    label=f"measured: {curve}",
                )
        axes.set(xlabel=xlabel, ylabel=ylabel)
        axes.axhline(0.0, color="#7F7F7F", linewidth=0.8, zorder=0)
    handles = {}
    for axes in grid[0]:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    figure.legend(
        handles.values(),
        handles,
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncol=min(2 * len(chosen), max(1, len(handles))),
    )
    return figure
