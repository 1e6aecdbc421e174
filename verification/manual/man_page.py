# SPDX-License-Identifier: MIT
"""The manual page homespun(1) in roff, from the texts of --help."""
import re

SPECIAL = {"\\": r"\e", "-": r"\-", "^": r"\(ha", "~": r"\(ti", "`": r"\(ga", "'": r"\(aq"}


def escaped(text):
    """Text as roff prints it unchanged; a dot or quote at the start of a line would be a request.
    """
    text = "".join(SPECIAL.get(letter, letter) for letter in text)
    return re.sub(r"^\.", r"\&.", text, flags=re.MULTILINE)


def is_literal(line):
    """Lines whose breaks matter: indented examples, and keys with their comments."""
    return line.startswith((" ", "#", "set "))


def prose(text):
    """A footer: sentences are filled, `Word: ...` begins a paragraph, examples and keys stay as
    they are.
    """
    out, literal = [], False
    for line in text.split("\n"):
        if is_literal(line) != literal and line:
            literal = not literal
            out += [".PP", ".nf"] if literal else [".fi"]
        if not line:
            out.append("" if literal else ".PP")
        elif literal:
            out.append(escaped(line))
        else:
            if re.match(r"[A-Z][A-Za-z ]*:", line):
                out.append(".PP")
            out.append(escaped(line))
    # An empty line in filled text is a warning of groff; twice .PP too.
    page = "\n".join(out + [".fi"] * literal)
    return re.sub(r"(\.PP\n)+", ".PP\n", page)


def entry(name, text):
    """An option or positional: its spellings bold, what it takes plain, breakable after commas."""
    spellings, _, value = re.sub(r":[A-Z]+ in ", " in ", name).partition(" ")
    value = escaped(value).replace(",", r",\:")
    return f".TP\n\\fB{escaped(spellings)}\\fR {value}".rstrip() + f"\n{escaped(text)}"


def section(command, inherited):
    """One command: how it is called, what it does, its options, its examples."""
    out = [f'.SS "{escaped(command.usage)}"', escaped(command.summary) + "."]
    out += [
        entry(*pair)
        for heading in ("Positionals:", "Options:")
        for pair in command.entries[heading]
        if pair[0] != "-h,--help"
    ]
    if command.footer not in ("", inherited):
        out += [".PP", prose(command.footer)]
    return "\n".join(out)


def man_page(program, version):
    """The whole page. Without a date, so that equal programs have equal pages."""
    title, _, story = program.summary.partition("\n")
    name = re.sub(r"^homespun ", "", title).rstrip(".")
    out = [
        f'.TH HOMESPUN 1 "" "homespun {version}" "User Commands"',
        ".nh",
        ".ad l",  # options are copied from here: no hyphens of the formatter's own
        ".SH NAME",
        f"homespun \\- {escaped(name)}",
        ".SH SYNOPSIS",
        ".B homespun",
        escaped(program.usage.partition(" ")[2]),
        ".SH DESCRIPTION",
        escaped(story),
        ".PP",
        prose(program.footer),
        ".SH OPTIONS",
        *(entry(*pair) for pair in program.entries["Options:"]),
        ".SH COMMANDS",
        *(section(command, program.footer) for command in list(program.walk())[1:]),
        ".SH SEE ALSO",
        ".BR gmsh (1),",
        ".BR mpirun (1)",
    ]
    return re.sub(r"\.PP\n(?=\.PP\n|\.S[HS] )", "", "\n".join(out) + "\n")
