#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws mutants from the product's C++.

draw.py [SEED [COUNT [FOLDER]]] writes FOLDER/NN-OPERATOR.patch, by default 24 by the seed 17 into
drawn/ beside this file. The same seed and the same sources give the same patches.
"""
import pathlib
import random
import re
import sys

import patches

# What no mutant touches: the command line, and lines that tell, refuse or assert.
LEFT_OUT = re.compile(r"verification/(program|command|verify)/|.*_command\.(h|cc)$")
SPEAKS = re.compile(r'"|^\s*#|\\$|\bthrow\b|\b(static_)?assert\b|\bAssert\w*\(|\btemplate\b'
                    r"|\btext\b|\bwhat\b|\bremedy\b|\bmessage\b|\bprintf\b")
# In these " + " may join texts or step through a container.
NO_NUMBERS = re.compile(r"string|name|text|folder|path|file|output|what|line|begin\(\)|end\(\)"
                        r"|operator")


def replaced(pattern, by):
    """All ways to do one replacement in a line."""
    def ways(line):
        for found in re.finditer(pattern, line):
            yield line[:found.start()] + by(found) + line[found.end():]
    return ways


def other_sign(line):
    if not NO_NUMBERS.search(line):
        yield from replaced(r"(?<=[\w)\].]) [+-](?= |$)",
                            lambda found: " -" if found[0] == " +" else " +")(line)


def other_factor(line):
    def factor(found):
        return "2." if found[0] == "0.5" else f"{1.1 * float(found[0]):.6g}"
    for changed in replaced(r"(?<![\w.])\d+\.\d+(e-?\d+)?(?![\w.])|(?<![\w.])\d+e-?\d+(?![\w.])",
                            factor)(line):
        if changed != line:
            yield changed


def other_index(line):
    yield from replaced(r"(?<=[\w])\([01]\)", lambda found: "(1)" if "0" in found[0] else "(0)")(
        line)


def other_comparison(line):
    yield from replaced(r"(?<= )[<>]=?(?= |$)", lambda found:
                        found[0][0] if "=" in found[0] else found[0] + "=")(line)


def other_logic(line):
    yield from replaced(r"(?<= )(&&|\|\|)(?= |$)",
                        lambda found: "||" if found[0] == "&&" else "&&")(line)


def other_extremum(line):
    yield from replaced(r"\bstd::(min|max)(?=[(<])", lambda found:
                        "std::max" if found[1] == "min" else "std::min")(line)


def dropped_term(line):
    if re.fullmatch(r"\s*[\w.\[\]()>-]+ \+= [^{}]*;", line):
        yield None


def dropped_not(line):
    yield from replaced(r"(?<=[\s(])!(?=[\w(])", lambda found: "")(line)


OPERATORS = {"sign": other_sign, "factor": other_factor, "index": other_index,
             "comparison": other_comparison, "logic": other_logic, "extremum": other_extremum,
             "term": dropped_term, "not": dropped_not}


def code_lines(text):
    """(number from 0, line) of the lines that compute: no comments, texts, refusals, assertions."""
    statement = []
    for number, line in enumerate(text.split("\n")):
        code = re.sub(r"\s*//.*", "", line) if '"' not in line else line
        if not code.strip():
            continue
        statement.append((number, code))
        if re.search(r"[;{}]$", code):
            if not any(SPEAKS.search(one) for _, one in statement):
                yield from statement
            statement = []


def sites(text, operator):
    """(number of the line, what it becomes or None) for all places where an operator applies."""
    lines = text.split("\n")
    for number, code in code_lines(text):
        if operator is dropped_term and not re.search(r"[;{}]$", lines[number - 1]):
            continue  # the body of a loop, or the end of a longer statement
        for changed in operator(code):
            yield number, None if changed is None else changed + lines[number][len(code):]


def sources(root):
    """{folder: {path: text}} of what is drawn from."""
    found = {}
    for folder in patches.PRODUCT:
        texts = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
                 for path in sorted((root / folder).rglob("*.cc"))}
        found[folder] = {path: text for path, text in texts.items()
                         if not LEFT_OUT.match(path)}
    return found


def drawn(seed, count, root=patches.ROOT):
    """[(name of the patch, its text)]: folders and operators take turns, two of a file at most."""
    chance = random.Random(seed)
    texts = sources(root)
    names = list(OPERATORS)
    n_of_file, result, seen = {}, [], set()
    turn = 0
    while len(result) < count:
        folder = patches.PRODUCT[turn % len(patches.PRODUCT)]
        operator = names[turn % len(names)]
        turn += 1
        if turn > 100 * count:
            raise SystemExit(f"no more than {len(result)} mutants can be drawn")
        paths = [path for path in texts[folder] if n_of_file.get(path, 0) < 2
                 and any(True for _ in sites(texts[folder][path], OPERATORS[operator]))]
        if not paths:
            continue
        path = paths[chance.randrange(len(paths))]
        lines = texts[folder][path].split("\n")
        all_sites = list(sites(texts[folder][path], OPERATORS[operator]))
        number, changed = all_sites[chance.randrange(len(all_sites))]
        if (path, number) in seen:
            continue
        seen.add((path, number))
        n_of_file[path] = n_of_file.get(path, 0) + 1
        lines[number:number + 1] = [] if changed is None else [changed]
        name = f"{len(result) + 1:02d}-{operator}"
        result.append((name, patches.patch_of(path, texts[folder][path], "\n".join(lines),
                                              f"{operator}: {path}:{number + 1}")))
    return result


def write(folder, seed=17, count=24, root=patches.ROOT):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.patch"):
        old.unlink()
    for name, text in drawn(seed, count, root):
        (folder / f"{name}.patch").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    given = sys.argv[1:]
    write(given[2] if len(given) > 2 else patches.HERE / "drawn",
          *[int(number) for number in given[:2]])
