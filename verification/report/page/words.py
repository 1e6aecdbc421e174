# SPDX-License-Identifier: MIT
"""Words that several sentences of the page share: a list, a share, a change in percent."""
import math

from figures import style


def listed(words):
    """a, b and c."""
    words = list(words)
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def capital(text):
    return text[:1].upper() + text[1:]


def change_of(gain):
    """−74 % of a gain of 0.74, +58 % of a gain of −0.58."""
    if math.isinf(gain):
        return "new"
    sign = "−" if gain > 0.0 else "+"
    return f"{sign}{share(abs(gain))} %"


def share(value):
    """A share in percent: whole numbers, and one digit where that would say 0 or 100."""
    whole = f"{100.0 * value:.0f}"
    if whole in ("0", "100"):
        return f"{100.0 * value:.2g}" if value < 0.5 else f"{100.0 * value:.4g}"
    return whole


def judged_sentence(own):
    """Which curves are of judged methods, after a space; empty without any.

    @param own names of all judged methods
    """
    if not own:
        return ""
    names = listed(f"`{name}` ({style.colour_name(name, own)})" for name in own)
    return f" No method of homespun, but judged: {names}."
