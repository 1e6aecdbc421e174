# SPDX-License-Identifier: MIT
"""Puts the contents of the report into its page."""
import os

import jinja2
from markupsafe import Markup

from page.scripts import scripts

HERE = os.path.dirname(os.path.abspath(__file__))


def render(contents):
    """The whole page as text: no file, no network address is needed to show it."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE), autoescape=True, undefined=jinja2.StrictUndefined
    )
    with open(os.path.join(HERE, "report.css"), encoding="utf-8") as file:
        css = Markup(file.read())
    return environment.get_template("report.html.j2").render(css=css, scripts=scripts, **contents)
