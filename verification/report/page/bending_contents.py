# SPDX-License-Identifier: MIT
"""What the page shows of the bending of a cell, and of what the inputs of a cell are worth."""
import numpy

from figures import fabrics
from figures.bending import bending_polar_figure, deflection_figure, roll_figure
from figures.style import three
from figures.vertex_tables import deflection_table
from page.entries import ENTRIES, MICRO, entry_texts
from read.stiffness import best_run, centre_and_bars

SOFTEST, STIFFEST = 1e-7, 1e-3  # of cloth [N m]; outside a unit is wrong, or a thickness


def bending_contents(cell, gallery):
    """Figures and tables; of a cell without D nothing but the reason."""
    contents = dict.fromkeys(("bending", "bending_polar", "rolled", "deflection", "worth"))
    contents["worth"] = worth_of_inputs(best_run(cell, "D") or cell.homogenize or {})
    known = best_run(cell, "D")
    if known is None:
        return contents
    D = centre_and_bars(known, "D")[0]
    contents["bending"] = bending_table(cell, D)
    if numpy.linalg.eigvalsh(D).min() > 0.0:
        contents["bending_polar"] = gallery.add(
            bending_polar_figure(known),
            f"{cell.name}-bending-stiffness",
            f"{cell.name}: bending stiffness of narrow strips cut along each direction. Grey: from"
            " the softest to the stiffest of ten measured fabrics (Wang et al. 2011).",
        )
    if (known.get("rolled") or {}).get("least_radius_m"):
        contents["rolled"] = gallery.add(
            roll_figure(known["rolled"]),
            f"{cell.name}-least-radius",
            f"{cell.name}: the radius from which on a sheet rolled along each direction is at most"
            f" {three(100.0 * known['rolled']['tolerance'])} % stiffer than Dᴴ, guaranteed for the cell as it is meshed. Zero: at any radius.",
        )
    if cell.deflection is not None:
        contents["deflection"] = gallery.add(
            deflection_figure(cell),
            f"{cell.name}-deflections",
            f"{cell.name}: deflections per unit of the macro curvatures κ11, κ22 and 2 κ12, beside"
            " the parabola of the curvature itself. Black lines: edges of the phases.",
            as_image=True,
            table=deflection_table(cell),
        )
    return contents


def bending_table(cell, D):
    """D^H with its bars, in N m and in what instruments print."""
    value = best_run(cell, "D")
    bracket = value.get("bending_bracket") or {}
    texts = entry_texts(cell, "D", MICRO)
    rows = [
        # What is zero to its bar is zero in every unit.
        [
            f"D{name}",
            *texts[name],
            "0" if texts[name][0] == "0" else three(D[i, j] / fabrics.KAWABATA),
        ]
        for name, i, j in ENTRIES
    ]
    strips = numpy.linalg.inv(D)
    density = value.get("areal_density")
    lengths = [
        (
            f"axis {k + 1}",
            three(MICRO / strips[k, k]),
            three(1.0 / strips[k, k] / fabrics.KAWABATA),
            three(1e3 * fabrics.bending_length(1.0 / strips[k, k], density)) if density else "–",
        )
        for k in range(2)
    ]
    outside = [
        f"D{k + 1}{k + 1} = {three(D[k, k])} N m"
        for k in range(2)
        if not SOFTEST <= D[k, k] <= STIFFEST
    ]
    width = bracket.get("width")
    return {
        "rows": rows,
        "strips": lengths,
        "width": three(width) if isinstance(width, (int, float)) else None,
        "of": bracket.get("of", "mesh"),
        "remark": bracket.get("remark"),
        "outside": " and ".join(outside),
        "rolled": (value.get("rolled") or {}).get("says", "").replace("D^H", "Dᴴ").splitlines(),
    }


def worth_of_inputs(value):
    """How entries change with the constants of the phases, in percent per percent, and the bars of
    uncertain inputs.
    """
    rows = [row for row in value.get("sensitivity") or [] if isinstance(row, dict)]
    matrices = {key: value.get(key) for key in ("C", "D")}
    table = []
    for row in rows:
        for key in ("C", "D"):
            if row.get(key) is None or matrices[key] is None:
                continue
            texts = []
            for _, i, j in ENTRIES[:4]:
                # Of the angle per degree; of the others per percent.
                step = 1.0 if row["unit"] == "deg" else 0.01 * row["value"]
                entry = matrices[key][i][j]
                texts.append(three(100.0 * step * row[key][i][j] / entry) if entry else "–")
            table.append(
                [
                    f"{row['phase']}.{row['constant']}",
                    "1°" if row["unit"] == "deg" else "1 %",
                    key,
                    *texts,
                ]
            )
    bars = value.get("input_bars") or {}
    uncertain = []
    for key in ("C", "D"):
        if bars.get(key) is None or matrices[key] is None:
            continue
        guaranteed = (
            (value.get("bracket") if key == "C" else value.get("bending_bracket")) or {}
        ).get("entry_bars")
        for name, i, j in ENTRIES:
            uncertain.append(
                [
                    f"{key}{name} [{'N/m' if key == 'C' else 'N m'}]",
                    three(matrices[key][i][j]),
                    three(guaranteed[i][j]) if guaranteed else "–",
                    three(bars[key][i][j]),
                ]
            )
    inputs = ", ".join(
        f"{one['phase']}.{one['constant']} ± {three(one['range'])} {one['unit']}"
        for one in bars.get("inputs") or []
    )
    return {"rows": table, "uncertain": uncertain, "inputs": inputs} if table else None
