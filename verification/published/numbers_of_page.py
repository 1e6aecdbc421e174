# SPDX-License-Identifier: MIT
"""Numbers and tables as docs/results.md has them."""

LETTERS = {"full-micro": "a", "affine+p2": "b"}  # of bases
UNBROKEN = "\u00a0"  # a space at which no line ends


def three(text):
    """A number with three digits; a dash where there is none."""
    if not text:
        return "–"
    value = float(text)
    digits = f"{value:#.3g}"
    return f"{value:.0f}" if "e+" in digits else digits.rstrip(".")


def with_bar(row, method):
    """An error and its bar, which has two digits at most and no more decimals than the error."""
    if not row[method]:
        return "–"
    error, bar = three(row[method]), row[method + "_bar"]
    if not bar:
        return error
    decimals = len(error.partition(".")[2])
    short = f"{float(f'{float(bar):.2g}'):.{decimals if float(bar) < 9.95 else 0}f}"
    return f"{error} ± {short if float(short) else f'{float(bar):.1g}'}".replace(" ", UNBROKEN)


def table(header, rows, texts=2):
    """A table in Markdown, its numbers to the right.

    @param texts how many columns have none
    """
    lines = [header, ["---"] * texts + ["---:"] * (len(header) - texts), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"
