# SPDX-License-Identifier: MIT
"""The functions of a C++ file as a reader of its braces finds them: their lines and parameters."""
import re


def blanked(text):
    """The text without comments and preprocessor, its literals of equal length without content."""
    def blank(match):
        found = match[0]
        if found.startswith('R"'):
            return re.sub(r"[^\n]", "x", found)
        if found[0] == "/":
            return re.sub(r"[^\n]", " ", found)
        return found[0] + "x" * (len(found) - 2) + found[-1]

    text = re.sub(r'R"(\w*)\((?:.|\n)*?\)\1"|//[^\n]*|/\*(?:.|\n)*?\*/|'
                  r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', blank, text)
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", lambda m: re.sub(r"[^\n]", " ", m[0]), text,
                  flags=re.M)


def parts_of(text):
    """What commas outside of all brackets part."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "(<[{") - (letter in ")>]}")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip()]


def name_and_parameters(head):
    """Of the head of a function; None where it is none."""
    for begin in re.finditer(r"\(", head):
        name = re.search(r"([~\w:]+|operator\s*\S+)$", head[:begin.start()].rstrip())
        if not name or name[1] in ("operator", "decltype", "noexcept", "alignas"):
            continue
        depth = 0
        for end in range(begin.start(), len(head)):
            depth += (head[end] == "(") - (head[end] == ")")
            if depth == 0:
                return name[1], parts_of(head[begin.start() + 1:end])
    return None


def functions(text):
    """(name, line, number of lines, parameters) of each function; 0 lines where it is declared."""
    text = blanked(text)
    scopes, begin = [], 0  # of each brace that is open: kind, name, line, parameters
    for place in re.finditer(r"[{;}]", text):
        head, line = text[begin:place.start()], text.count("\n", 0, place.start()) + 1
        kind = scopes[-1][0] if scopes else "outside"
        found = None
        if kind == "outside" and not re.search(r"\benum\b", head):
            if "=" not in head.split("(")[0] or "operator" in head:
                found = name_and_parameters(head)
        if place[0] == ";":
            if found:
                yield found[0], line, 0, found[1]
        elif place[0] == "}":
            if scopes:
                kind, name, first, parameters = scopes.pop()
                if kind == "function":
                    yield name, first, line - first + 1, parameters
        elif re.search(r"\bnamespace\b|(^|\s|>)(class|struct|union)\b[^()]*$", head.strip()) \
                and kind == "outside":
            scopes.append(("outside", "", line, []))
        else:
            scopes.append(("function", found[0], line, found[1]) if found
                          else ("inside", "", line, []))
        begin = place.end()
