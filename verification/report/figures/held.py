# SPDX-License-Identifier: MIT
"""What pins and handles exert on a draped cloth, against time."""
import math

from matplotlib import pyplot

from figures.drape import member_handles, plot_members

MOST_PANELS = 6  # of a scene that holds more places the first ones


def held_figure(rows):
    """Size of the force of each held place against time, a panel per place.

    @param rows of motion.csv with a place
    @return (figure, places that are left out), or None without rows
    """
    rows = [
        {**row, "force": math.hypot(*(row[f"force_{axis}_N"] for axis in "xyz"))} for row in rows
    ]
    if not rows:
        return None
    places = list(dict.fromkeys(row["place"] for row in rows))
    shown = places[:MOST_PANELS]
    columns = min(3, len(shown))
    lines = math.ceil(len(shown) / columns)
    figure, grid = pyplot.subplots(
        lines,
        columns,
        squeeze=False,
        sharex=True,
        figsize=(0.9 + max(2.9 * columns, 4.2), 0.5 + 2.3 * lines),
        layout="constrained",
    )
    for axes in grid.flat[len(shown) :]:
        axes.set_visible(False)
    for axes, place in zip(grid.flat, shown):
        plot_members(axes, [row for row in rows if row["place"] == place], "force")
        axes.set_title(place, loc="left", fontweight="bold")
        axes.set(xlabel="time [s]", ylabel="force [N]")
        axes.set_ylim(bottom=0.0)
    figure.legend(
        handles=member_handles(rows), loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4
    )
    return figure, places[MOST_PANELS:]
