# SPDX-License-Identifier: MIT
"""Mutants as they are stored: a patch of one product file, below one line that says what is wrong.

read(ROOT) gives all of them; Mutant.applied(TEXT) is the text of the file with the fault.
"""
import dataclasses
import difflib
import pathlib
import re

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PRODUCT = ("homogenization", "localization", "meshes", "shell", "verification")


@dataclasses.dataclass
class Hunk:
    first: int  # line of the old file, from 0
    old: list
    new: list

    def changed(self):
        """Which of the old lines go, or stand before those that come."""
        places = []
        for part, a, b, _, _ in difflib.SequenceMatcher(a=self.old, b=self.new,
                                                        autojunk=False).get_opcodes():
            if part != "equal":
                places += list(range(a, max(b, a + 1)))
        return places


@dataclasses.dataclass
class Mutant:
    name: str
    kind: str  # chosen or drawn
    sentence: str
    files: list
    hunks: list

    @property
    def file(self):
        return self.files[0]

    def changed_lines(self):
        """The larger of the lines that go and those that come."""
        going = coming = 0
        for hunk in self.hunks:
            for part, a, b, c, d in difflib.SequenceMatcher(a=hunk.old, b=hunk.new,
                                                            autojunk=False).get_opcodes():
                if part != "equal":
                    going += b - a
                    coming += d - c
        return max(going, coming)

    def applied(self, text):
        """The text with the fault. Raises ValueError where the old lines do not stand there once.

        Lines may have moved: the place is where the old lines are, not where the patch says."""
        lines = text.split("\n")
        for hunk in self.hunks:
            n = len(hunk.old)
            places = [k for k in range(len(lines) - n + 1) if lines[k:k + n] == hunk.old]
            if len(places) != 1:
                raise ValueError(f"{self.name}: line {hunk.first + 1} and those around it stand "
                                 f"{len(places)} times in {self.file}; expected once")
            lines[places[0]:places[0] + n] = hunk.new
        return "\n".join(lines)


def parsed(text, name, kind):
    """A mutant from the text of its patch."""
    lines = text.rstrip("\n").split("\n")
    sentence = lines[0][2:] if lines[0].startswith("# ") else ""
    files, hunks = [], []
    for line in lines[1:]:
        start = re.match(r"@@ -(\d+)(?:,\d+)? \+\d+(?:,\d+)? @@", line)
        if start:
            hunks.append(Hunk(int(start[1]) - 1, [], []))
        elif line.startswith("--- a/"):
            files.append(line[len("--- a/"):].split("\t")[0])
        elif hunks and line[:1] in (" ", "-", "+", ""):
            if line[:1] != "+":
                hunks[-1].old.append(line[1:])
            if line[:1] != "-":
                hunks[-1].new.append(line[1:])
    return Mutant(name, kind, sentence, files, hunks)


def patch_of(path, old, new, sentence):
    """The text of a patch as it is stored."""
    diff = difflib.unified_diff(old.splitlines(True), new.splitlines(True),
                                f"a/{path}", f"b/{path}")
    return f"# {sentence}\ndiff --git a/{path} b/{path}\n" + "".join(diff)


def read(folder=HERE):
    """All mutants: the chosen ones, then the drawn ones, by name."""
    return [parsed(path.read_text(encoding="utf-8"), path.stem, kind)
            for kind in ("chosen", "drawn")
            for path in sorted((pathlib.Path(folder) / kind).glob("*.patch"))]
