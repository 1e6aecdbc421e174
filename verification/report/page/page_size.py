# SPDX-License-Identifier: MIT
"""Keeps the page below the size that mail and browsers take gladly: its largest pictures go beside
it.
"""
import re

LIMIT_BYTES = 7.9e6  # of the page; readers are promised 8 MB
PICTURE = re.compile(r'(<figure id="([^"]*)">\s*<img src=")(data:image/([a-z+]+)[;,][^"]*)(")')
PLACE = "<!-- pictures beside the page -->"  # where the page says what is not in it


def fitted(page, moving=()):
    """The page, with as many of its largest pictures as needed read from figures/, which it says at
    PLACE.

    @param moving names of animations, whose file is a WebP; of all others it is the SVG
    """
    found = sorted(
        ((len(match.group(3)), match.group(2)) for match in PICTURE.finditer(page)), reverse=True
    )
    size, beside = len(page.encode()), {}
    for length, name in found:
        if size <= LIMIT_BYTES:
            break
        beside[name] = f"figures/{name}.{'webp' if name in moving else 'svg'}"
        size -= length
    if not beside:
        return page.replace(PLACE, "")
    page = PICTURE.sub(lambda m: m.group(1) + beside.get(m.group(2), m.group(3)) + m.group(5), page)
    return page.replace(
        PLACE,
        (
            f'<p class="left-out">{len(beside)} pictures lie beside the page in figures/, because'
            f' with them it would exceed 8 MB: {", ".join(sorted(beside))}.</p>'
        ),
    )
