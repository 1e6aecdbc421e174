# SPDX-License-Identifier: MIT
"""A row of strain.csv, as far as sentences read it."""
BAR = 1e-6  # of an error, cell sides of 1 cm


def row(error, bar=BAR):
    return {
        "error_mean_per_cell": error,
        "error_mean_m": 0.01 * error,
        "error_bar_m": 0.01 * bar,
    }
