# SPDX-License-Identifier: MIT
"""The answer of the page as plain text: what a terminal says at the end of a run."""
import textwrap

from markupsafe import Markup, escape

COLUMNS = 96


def answer_text(contents):
    """The sentences of the first screen, cell by cell, each subject with its lines below.

    @param contents of page_contents()
    @return text without a newline at its end; empty where the page has no sentence
    """
    blocks = [
        (
            f"{cell['name']}, at {cell['strain']} strain",
            [cell["headline"]]
            + [
                f"{line['title']} ({line['load']}): {line['sentence']}{line['beside']}"
                for line in cell["shown"] + ([cell["infinite"]] if cell["infinite"] else [])
            ]
            + [cell[key] for key in ("no_cause", "law") if cell[key]],
        )
        for cell in contents["in_short"]
        if cell["lines"]
    ]
    blocks += blocks_of_runs(
        contents, ("drapes", "bends", "loads", "stability", "convergence", "stress")
    )
    lines = []
    for subject, sentences in blocks:
        if sentences:
            lines.append(plain(subject) + ":")
            for sentence in sentences:
                lines += textwrap.wrap(plain(sentence), COLUMNS, initial_indent="  ",
                                       subsequent_indent="    ")
    return "\n".join(lines)


def blocks_of_runs(contents, kinds):
    """(subject, sentences) of runs that are no study of strain: scenes, bent sheets, orders."""
    blocks = []
    for kind, run in ((kind, run) for kind in kinds for run in contents[kind]):
        if run.get("sentence"):
            blocks.append((run["name"], [run["sentence"]]))
        blocks += [
            (f"{run['name']}, {cell['name']}" if run["name"] != cell["name"] else cell["name"],
             # Sentences of scenes are HTML.
             [Markup(one) if kind == "drapes" else one for one in cell["sentences"]])
            for cell in run.get("cells") or []
            if cell["sentences"]
        ]
    return blocks


def plain(sentence):
    """A sentence without the tags and entities of HTML, where it is that; text stays as it is, also
    a name with `<` in it.
    """
    return escape(sentence).striptags()
