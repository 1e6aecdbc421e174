# SPDX-License-Identifier: MIT
"""Where a pressed sheet begins to wrinkle, resolved on one cell and by D^H: wrinkles.csv."""
import math

from figures.style import number_with_bar, three
from page.tables import length, length_with_bar

UNSEEN = 1e-3  # part of a value that three digits do not show
QUANTITIES = (("compression", "N_per_m", "smaller", "larger"), ("wavelength", "m", "shorter", "longer"))


def change(row, name, unit):
    """(by which part the resolved sheet differs from that of D^H, its bar)"""
    other = row[f"homogenized_{name}_{unit}"]
    return row[f"{name}_{unit}"] / other - 1.0, row[f"{name}_bar_{unit}"] / other


def change_text(row, name, unit):
    value, bar = (100.0 * one for one in change(row, name, unit))
    return f"{number_with_bar(value, seen(value, bar))} %"


def seen(value, bar):
    """A bar, or zero where it is below three digits of its value."""
    return bar if bar > UNSEEN * abs(value) else 0.0


def wrinkle_sentences(rows):
    """Per axis, at the shortest waves of the table, what D^H misses."""
    sentences = []
    for axis in sorted({row["axis"] for row in rows}):
        row = min((r for r in rows if r["axis"] == axis), key=lambda r: r["cells_per_wave"])
        where = (
            f"Pressed along axis {int(axis)}, where Dᴴ has waves of {int(row['cells_per_wave'])} cells,"
        )
        if not math.isfinite(row["compression_N_per_m"]):
            sentences.append(f"{where} no wave of the resolved sheet was found near that of Dᴴ.")
            continue
        parts = []
        for name, unit, less, more in QUANTITIES:
            value, bar = change(row, name, unit)
            if not math.isfinite(bar):
                parts.append(f"its {name} has no error bar")
            elif abs(value) <= bar:
                parts.append(f"its {name} is that of Dᴴ within the error bar")
            else:
                size = change_text(row, name, unit).lstrip("−")
                parts.append(f"its {name} is {size} {less if value < 0 else more} than by Dᴴ")
        sentences.append(f"{where} a sheet begins to wrinkle: {' and '.join(parts)}.")
    return sentences


def wrinkle_rows(rows):
    """Axis, cells per wave, and of wavelength and compression D^H, resolved, difference."""
    table = []
    for row in rows:
        compression, wavelength = row["compression_N_per_m"], row["wavelength_m"]
        found = math.isfinite(compression)
        table.append([
            int(row["axis"]), int(row["cells_per_wave"]),
            length(row["homogenized_wavelength_m"]),
            length_with_bar(wavelength, seen(wavelength, row["wavelength_bar_m"])) if found else "–",
            change_text(row, "wavelength", "m") if found else "–",
            three(row["homogenized_compression_N_per_m"]),
            number_with_bar(compression, seen(compression, row["compression_bar_N_per_m"]))
            if found else "–",
            change_text(row, "compression", "N_per_m") if found else "–",
        ])
    return table
