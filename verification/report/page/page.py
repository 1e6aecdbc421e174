# SPDX-License-Identifier: MIT
"""Puts the contents of the report into its page, and into the page itself all JavaScript: our own
files, and the plotting library from Debian's package.
"""
import os
import re

import jinja2
from markupsafe import Markup

HERE = os.path.dirname(os.path.abspath(__file__))
# Chart.js, of Debian's package libjs-chart.js.
CHART = "/usr/share/javascript/chart.js/chart.min.js"
PACKAGE = "libjs-chart.js"
CHART_LICENCE = "/*! Chart.js, https://www.chartjs.org, (c) Chart.js contributors, MIT License */"


# A script, the title, a tag, or code as Markdown has it; pictures in attributes hold brackets.
CODE = re.compile(r"""<(script|style|title)\b.*?</\1>|<(?:[^<>"]|"[^"]*")*>|`([^`<>]+)`""", re.DOTALL)


def own(name):
    with open(os.path.join(HERE, name), encoding="utf-8") as file:
        return file.read()


def without_source_map(text):
    """A browser would look for the map beside the page."""
    return "\n".join(
        line for line in text.splitlines() if not line.startswith("//# sourceMappingURL=")
    )


def scripts(plots, views):
    """Scripts in their order, and the sentence that says what is missing (empty: nothing).

    @param plots whether a figure has an interactive plot
    @param views whether one has a cloth to turn
    """
    texts, missing = [own("page.js")], ""  # the theme comes first
    if plots:
        try:
            with open(CHART, encoding="utf-8") as file:
                texts += [
                    CHART_LICENCE + "\n" + without_source_map(file.read()),
                    own("plot_style.js"),
                    own("plot.js"),
                ]
        except OSError:
            missing = (
                f"Plots are pictures only, because {CHART} could not be read when this page was"
                f" made: `apt-get install {PACKAGE}`, or ./bootstrap, brings it."
            )
    if views:
        texts += [own("view_scene.js"), own("view.js")]
    return [Markup(text.replace("</script", "<\\/script")) for text in texts], missing


def render(contents):
    """The whole page as text: no file, no network address is needed to show it."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(os.path.join(HERE, "templates")), autoescape=True, undefined=jinja2.StrictUndefined
    )
    css = Markup(own("report.css"))
    template = environment.get_template("report.html.j2")
    return with_code(template.render(css=css, scripts=scripts, **contents))


def with_code(html):
    """Sentences have code between backticks, as a terminal shows it; a page has its own letters."""
    return CODE.sub(lambda m: f"<code>{m.group(2)}</code>" if m.group(2) else m.group(0), html)
