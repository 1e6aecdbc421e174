# SPDX-License-Identifier: MIT
"""What must hold of every page: found in its text, without a browser."""
import csv
import json
import os
import re
from html.parser import HTMLParser

LIMIT_BYTES = 8e6
LINKED = {"a"}  # whose href is followed only where the reader asks for it


class Elements(HTMLParser):
    """All elements with their attributes, and the text of each script."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.scripts, self.open = [], [], None
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag == "script":
            self.open = dict(attrs).get("class") or "code"
            self.scripts.append((self.open, ""))

    def handle_endtag(self, tag):
        if tag == "script":
            self.open = None

    def handle_data(self, data):
        if self.open:
            self.scripts[-1] = (self.open, self.scripts[-1][1] + data)


def with_backticks(page):
    """Texts that a reader sees with the backticks of a terminal, and those of pictures."""
    shown = re.sub(r"(?s)<(script|style|title)\b.*?</\1>", "", page)
    told = [attributes.get("alt", "") for _, attributes in Elements(page).elements]
    return [text for text in [*re.findall(r">([^<>]*)<", shown), *told] if "`" in text]


def fetched(page):
    """Addresses that a browser would fetch by itself: none may leave the page."""
    found = [
        value
        for tag, attributes in Elements(page).elements
        for name, value in attributes.items()
        if name in ("src", "srcset", "data", "poster", "action")
        or (name == "href" and tag not in LINKED)
    ]
    styles = "".join(re.findall(r"<style>(.*?)</style>", page, flags=re.S))
    found += re.findall(r"url\(([^)]*)\)", styles) + re.findall(r"@import[^;]*", styles)
    return [value for value in found if not value.startswith("data:")]


def figures_without_downloads(page, folder):
    """Names of figures that lack a link to SVG (an animation: WebP), or whose linked file
    is not there.
    """
    bad = []
    for name, body in re.findall(r'<figure id="([^"]*)">(.*?)</figure>', page, flags=re.S):
        links = dict(
            (os.path.splitext(href)[1], href)
            for href in re.findall(r'href="(figures/[^"]*)"', body)
        )
        wanted = {".webp"} if ".webp" in links else {".svg"}
        if body.find('class="plot-data"') > 0:
            wanted.add(".csv")
        if not wanted <= set(links) or not all(
            os.path.getsize(os.path.join(folder, href)) > 0 for href in links.values()
        ):
            bad.append(name)
    return bad


def nameless_numbers(path):
    """Columns of a CSV file that are blank in all rows, and quantities that are blank in any; not
    what plots may lack.

    All plots share one header: a figure of one panel may have no title, and few curves have notes.
    """
    with open(path, encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    columns = dict(zip(header, zip(*rows)))
    bad = [
        name
        for name, values in columns.items()
        if name not in ("panel", "note") and not any(values)
    ]
    return bad + [
        name
        for name in ("x_quantity", "y_quantity")
        if name not in bad and not all(columns.get(name, ["words"]))
    ]


def data_of(page, kind):
    """The JSON of all scripts of a class; NaN and Infinity are refused as the browser refuses them.
    """

    def refuse(word):
        raise ValueError(f"{word} is no JSON")

    return [
        json.loads(text, parse_constant=refuse)
        for name, text in Elements(page).scripts
        if name == kind
    ]
