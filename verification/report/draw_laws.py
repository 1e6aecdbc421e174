#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws which law serves which cloth, with cells marked on it: the picture of guides/findings.md.

    draw_laws.py FOLDER... > docs/pictures/which-law.svg

FOLDER: of `homespun homogenize`, one per cell
"""
import io
import json
import os
import sys

import numpy

from figures import style

style.use()  # before anything draws

# pylint: disable=wrong-import-position
from figures.laws import anisotropy, law_figure  # noqa: E402
from page.gallery import short_svg  # noqa: E402


def main():
    marked = []
    for folder in sys.argv[1:]:
        with open(os.path.join(folder, "homogenize.json"), encoding="utf-8") as file:
            found = json.load(file)
        marked.append((found["cell"], anisotropy(numpy.array(found["C"]))))
    if not marked:
        raise SystemExit(__doc__)
    figure = law_figure(sorted(marked, key=lambda one: one[1]))
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    print(short_svg(text.getvalue()))


if __name__ == "__main__":
    main()
