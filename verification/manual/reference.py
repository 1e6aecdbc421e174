# SPDX-License-Identifier: MIT
"""Writes docs/reference: commands.md and keys.md from --help, tables.md from schema.json and the
headers of the tables, claims.md from the claims in schema.json.

    reference.py PROGRAM SCHEMA FOLDER
"""
import json
import pathlib
import re
import sys

from help_text import read
from man_page import is_literal
from table_words import table_words

SOURCES = pathlib.Path(__file__).resolve().parents[1]
NOTICE = "<!-- Generated: `cmake --build --preset release --target docs` writes this page. -->\n"
KEYS_BEGIN = re.compile(r"^Keys of (a \w+ file):\n+", re.MULTILINE)
VALUES = {"TEXT": "text", "FLOAT": "number", "INT": "integer", "UINT": "integer", "ENUM": "word"}
UNITS = (  # by the ending of a column's name
    ("_N_per_m3", "N/m^3"), ("_N_per_m", "N/m"), ("_per_m", "1/m"), ("_N", "N"), ("_J", "J"),
    ("_m", "m"), ("_s", "s"), ("_deg", "degrees"), ("_rad", "rad"),
)
LAWS = {
    "linear": "linear elasticity at small strain: ½ e:C:e",
    "biot": "½ (U − I):C:(U − I), also the law of the coarse cloth",
    "green": "St. Venant-Kirchhoff: ½ E:C:E",
    "yarn": "stretches and angle of two families of yarns; the coarse cloth then has it too",
}
COMMON = {  # columns of many tables
    "cell": "name of the cell file, without its ending",
    "scene": "name of the scene file, without its ending",
    "load": "one of the loads below",
    "law": "one of the laws below",
    "strain": "of the load, as a fraction",
    "reference": "law of the resolved cloth, one of the laws below",
    "method": "how the fine positions were found, see `homespun strain --help`",
    "seconds": "what it took",
    "note": "in words",
    "fault": "why there is no value",
}
DOMAINS = {
    "positive": "positive", "not negative": "0 or more", "needed not negative": "0 or more",
    "real": "number", "name": "name", "text": "text", "flag": "true or false",
    "outcome": "PASS, FAIL or INCONCLUSIVE",
}


def cell_text(text):
    """Text that may stand in a cell of a table."""
    return text.replace("|", "\\|").replace("\n", " ").strip()


def table(header, rows):
    """A table in Markdown."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def option_row(name, text):
    """(spellings, what it takes, default, what it does) of an option as CLI11 prints it."""
    spellings, _, rest = name.partition(" ")
    excludes = re.search(r"Excludes:((?: --[\w-]+)+)", rest)
    rest = re.sub(r"\s*Excludes:(?: --[\w-]+)+", "", rest)
    default = re.search(r"=(\[.*?\]|\S+)", rest)
    bounds = re.search(r"in \[(\S+) - (\S+)\]", rest)
    kind = VALUES.get(re.match(r"[A-Z]*", rest).group(), "")
    takes = f"{kind} from {bounds[1]} to {bounds[2]}" if bounds else kind
    if "..." in rest:
        takes += ", several"
    if "REQUIRED" in rest:
        takes += ", required"
    if excludes:
        text += f" (not with {', '.join(f'`{word}`' for word in excludes[1].split())})"
    shown = default[1].strip("[]").replace(",", ", ") if default else ""
    return [f"`{spellings.replace(',', '`, `')}`", takes, f"`{shown}`" if shown else "",
            cell_text(text)]


def prose(text):
    """A footer of --help in Markdown: sentences as paragraphs, examples as code."""
    out, literal = [], None
    for line in text.strip("\n").split("\n"):
        if line and literal != is_literal(line):
            if literal is not None:
                out.append("```" if literal else "")
            literal = is_literal(line)
            if literal:
                out += ["", "```sh"]
        if literal is False and re.match(r"[A-Z][A-Za-z ]*:", line):
            out.append("")  # such a word begins a paragraph
        out.append(cell_text(line) if literal is False else line.removeprefix("  "))
    text = "\n".join(out + ["```"] * bool(literal))
    return re.sub(r"\n+(\n```\n)", r"\1", re.sub(r"\n{3,}", "\n\n", text)).strip() + "\n"


def commands_page(program):
    """All commands with their options and examples; the exit statuses first."""
    commands = list(program.walk())[1:]
    out = [
        NOTICE,
        "# Commands\n",
        "What `homespun COMMAND --help` says, on one page.\n",
        table(
            ["command", "what it does"],
            [
                [
                    f"[`{' '.join(command.words)}`](#{'-'.join(command.words)})",
                    cell_text(command.summary),
                ]
                for command in commands
            ],
        ),
        "## Exit statuses\n",
        prose(program.footer),
    ]
    for command in commands:
        out += [
            f"## {' '.join(command.words)}\n",
            f"    {command.usage}\n",
            cell_text(command.summary) + ".\n",
        ]
        entries = [
            option_row(*pair)
            for heading in ("Positionals:", "Options:")
            for pair in command.entries[heading]
            if pair[0] != "-h,--help"
        ]
        if entries:
            out.append(table(["option", "takes", "default", "what it does"], entries))
        footer = KEYS_BEGIN.split(command.footer)[0].strip("\n")
        if footer not in ("", program.footer):
            out.append(prose(footer))
        if KEYS_BEGIN.search(command.footer):
            out.append("The keys of the file: [keys](keys.md).\n")
    return "\n".join(out)


def keys_of(text):
    """[(key, default, what it is)] of a listing of parameters."""
    found, comment = [], []
    for line in text.split("\n"):
        if line.startswith("# ---"):
            comment = []  # above it stands a title
        elif line.startswith("#"):
            comment.append(line.lstrip("# "))
        elif line.startswith("set "):
            key, _, value = line.removeprefix("set ").partition("=")
            found.append((key.strip(), value.strip(), " ".join(comment)))
        if not line.startswith("#"):
            comment = []
    return found


def keys_page(program):
    """The keys of the files that a user writes."""
    out = [
        NOTICE,
        "# Keys of a cell file and of a scene file\n",
        "A file has lines `set Key = value  # comment`. A key without a default must be given, or"
        " belongs to\na feature that is off without it. How to write a cell:"
        " [guide](../../guides/cell.md); a scene:\n[guide](../../guides/scene.md).\n",
    ]
    for command in program.walk():
        _, *parts = KEYS_BEGIN.split(command.footer)
        for what, listing in zip(parts[::2], parts[1::2]):
            rows = [
                [f"`{key}`", f"`{value}`" if value else "", cell_text(text)]
                for key, value, text in keys_of(listing)
            ]
            out += [f"## Keys of {what}\n", table(["key", "default", "meaning"], rows)]
    return "\n".join(out)


def unit_of(name):
    """The unit that the name of a column says."""
    if name.startswith("seconds"):
        return "s"
    return next((unit for ending, unit in UNITS if name.endswith(ending)), "")


def tables_page(schema, words):
    """The tables with their columns, and the names that stand in them."""
    tables = {name: value for name, value in schema.items() if name.endswith(".csv")}
    out = [
        NOTICE,
        "# Tables\n",
        "Every study writes tables as CSV, one row per case, with SI units in the names of"
        " columns and numbers\nthat read back to the last bit. An empty field has no value. The"
        " first columns, in bold, name a row.\n"
        "[Which command writes what](../../guides/files.md).\n",
        " · ".join(f"[{name}](#{name.replace('.', '')})" for name in tables) + "\n",
    ]
    for name, value in tables.items():
        about, meanings = words.get(name, ([], {}))
        rows = []
        for place, column in enumerate(value["columns"]):
            title = column["name"]
            meaning = COMMON.get(title) or meanings.get(title, "")
            meaning = re.sub(r"\s*\[[^\]]*\](?=[;.]|$)", "", meaning).lstrip("; ")
            shown = f"**`{title}`**" if place < value["keys"] else f"`{title}`"
            rows.append([shown, unit_of(title), DOMAINS.get(column["domain"], column["domain"]),
                         cell_text(meaning)])
        text = re.sub(r"(?m)^(- .*\n)\n(?=- )", r"\1", "\n\n".join(about))
        out += [f"## {name}\n", f"{text}\n",
                table(["column", "unit", "values", "meaning"], rows)]
    for name in ("laws", "loads"):
        rows = [
            [f"`{entry['name']}`", cell_text(entry.get("label") or LAWS.get(entry["name"], ""))]
            for entry in schema[name]
        ]
        out += [f"## {name.capitalize()}\n", table(["name", "what it is"], rows)]
    return "\n".join(out)


def in_words(text, shared):
    """The text of a claim as Markdown: what it shares with others in its place, and other names in
    braces in italics.
    """
    while re.search("|".join(map(re.escape, (f"{{{name}}}" for name in shared))), text):
        for name, words in shared.items():
            text = text.replace(f"{{{name}}}", words)
    text = re.sub(r"([<>*_|])", r"\\\1", text)
    text = text.replace("{note}", "")
    return re.sub(r"\{([\w-]+)\}", r"*\1*", text)


def claims_page(claims):
    """The claims of all studies."""
    claims = dict(claims)
    shared = claims.pop("shared")
    out = [
        NOTICE,
        "# Claims\n",
        "What the studies claim, each with its limit and what that rests on, by kind: `program`, it"
        " computes what\nit says; `input`, cell, mesh or scene are fit for the question; `method`,"
        " up-sampling is good enough\nfor this cell, load and strain. Words in italics are filled"
        " in. `id` names a claim in `verdicts.json`;\nwhat stands before a dot is one question, of"
        " which a study answers one or several.\n"
        "[How a claim fails or stays open](../../guides/how-studies-work.md).\n",
    ]
    for study, some in claims.items():
        rows = [
            [f"`{name}`", one["kind"], in_words(one["claim"], shared),
             in_words(one.get("limit", "<= {limit}"), shared),
             in_words(one["derivation"], shared)]
            for name, one in some.items()
        ]
        out += [f"## {study}\n", table(["id", "kind", "claim", "limit", "rests on"], rows)]
    return "\n".join(out)


def main(path, schema, folder):
    """Asks the program at `path` and writes the four pages into `folder`."""
    program = read(path)
    schema = json.loads(pathlib.Path(schema).read_text(encoding="utf-8"))
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (
        ("commands.md", commands_page(program)),
        ("keys.md", keys_page(program)),
        ("tables.md", tables_page(schema, table_words(SOURCES))),
        ("claims.md", claims_page(schema["claims"])),
    ):
        (folder / name).write_text(text.rstrip("\n") + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
