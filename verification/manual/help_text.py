# SPDX-License-Identifier: MIT
"""What the program says of itself: the texts of --help, read into commands with options."""
import dataclasses
import subprocess

HEADINGS = ("Positionals:", "Options:", "Subcommands:")
COLUMN = 30  # where CLI11 begins the text of an entry


@dataclasses.dataclass
class Command:
    """One command, or the program itself; entries are pairs of name and text as printed."""

    words: tuple  # ("homespun", "check")
    summary: str
    usage: str
    entries: dict  # heading: [(name, text)]
    footer: str
    commands: list  # those below it

    def options(self):
        """All spellings of all options: -h, --help, ..."""
        return [
            spelling
            for name, _ in self.entries["Options:"]
            for spelling in name.split()[0].split(",")
        ]

    def walk(self):
        """This command and all below it."""
        yield self
        for command in self.commands:
            yield from command.walk()


def entries_of(lines):
    """Pairs of name and text. A long name stands on a line of its own, its text on the next."""
    pairs = []
    for number, line in enumerate(lines):
        following = lines[number + 1] if number + 1 < len(lines) else ""
        if line.startswith(" " * COLUMN):
            pairs[-1][1] = (pairs[-1][1] + " " + line.strip()).strip()
        elif line[COLUMN - 2 : COLUMN] == "  " or (
            line[COLUMN - 1 : COLUMN] == " " and not following.startswith(" " * COLUMN)
        ):
            pairs.append([line[:COLUMN].strip(), line[COLUMN:].strip()])
        else:
            pairs.append([line.strip(), ""])
    # CLI11 marks flags that switch something off by {false}.
    return [(name.replace("{false}", ""), text) for name, text in pairs]


def parse(words, text):
    """Reads the help of one command, without those below it."""
    summary, _, rest = text.partition("Usage: ")
    usage, _, rest = rest.partition("\n")
    entries = {heading: [] for heading in HEADINGS}
    footer = []
    heading = None
    for block in rest.strip("\n").split("\n\n"):
        heading, *lines = block.split("\n")
        if heading in HEADINGS and not footer:
            entries[heading] = entries_of(lines)
        else:
            footer.append(block)
    if not entries["Options:"]:
        raise ValueError(
            f"`{' '.join(words)} --help` lists no options; expected the form of CLI11:\n{text}"
        )
    return Command(
        words, summary.strip(), usage.strip(), entries, "\n\n".join(footer).strip("\n"), []
    )


def read(program, words=("homespun",)):
    """Asks the program, command by command."""
    result = subprocess.run(
        [program, *words[1:], "--help"], capture_output=True, text=True, timeout=300, check=True
    )
    command = parse(words, result.stdout)
    command.commands = [
        read(program, (*words, name)) for name, _ in command.entries["Subcommands:"]
    ]
    return command
