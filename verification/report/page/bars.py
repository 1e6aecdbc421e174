# SPDX-License-Identifier: MIT
"""Whether two errors of one level may be compared: their bars, and where the law is lost."""
import math

from figures.style import three

UNCONFIRMED = 3.0  # the factor of safety of an error bar where no convergence is seen


def bar_of(row):
    """The bar of an error [m]; nan where none was measured."""
    return row.get("error_bar_m", math.nan)


def without_bars(one, other):
    """Why the error bars of two errors decide nothing, a clause, as claims have it; else empty."""
    if math.isnan(bar_of(one) + bar_of(other)):
        return "an error bar is not known"
    if max(row.get("error_bar_safety", 0.0) for row in (one, other)) >= UNCONFIRMED:
        return "errors of P1, P2 and refined P2 do not come together"
    return ""


def law_lost(row):
    """A clause where the law has lost ellipticity at the strain of a row, of which claims are open
    then; else empty.

    @param row with `law_lost_at` of its load and law, not a number where it is never lost
    """
    lost = row.get("law_lost_at", math.nan)
    return f"the law is lost at {three(100.0 * lost)} %" if lost <= row.get("strain", 0.0) else ""


def undecided(one, other):
    """Why neither of two errors of one level is known to be the larger one, whatever they are."""
    return law_lost(other) or without_bars(one, other)
