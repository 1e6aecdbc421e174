# SPDX-License-Identifier: MIT
"""What a table and its columns mean, in the words of the headers that declare them.

A table is a struct with its columns (verification/record/table.h). The comment above the struct
says what the table is, the comment beside a member what a column is. Both are read here, so that
nobody writes them twice.
"""
import pathlib
import re

STRUCT = re.compile(
    r"(?P<comment>(?:^///.*\n)*)^struct \w+\n{\n(?P<body>(?:(?!^};).*\n)*?"
    r'\s*static constexpr const char \*file\s*= "(?P<file>[^"]+)";\n(?:(?!^};).*\n)*)^};',
    re.MULTILINE,
)
COLUMN = re.compile(r'column\("([^"]+)",\s*&\w+::(\w+),')
MEMBER = re.compile(r"\b(\w+)\b(?=\s*(?:=[^,;]*)?[,;])")
HEADER = re.compile(r"\s*\([\w/]+\.h\)")  # a reader of tables has no headers at hand


def paragraphs(comment):
    """The text of a comment: paragraphs, and the items of its lists, which begin with `- `.

    In a comment an item is ` - words` or, as in a small table, `   word  words`.
    """
    out = [""]
    for line in comment.strip().split("\n"):
        text = re.sub(r"^///", "", line)
        if not text.strip():
            out.append("")
        elif item := re.match(r" - (.*)|   +(\S+)  +(.*)", text):
            out.append("- " + (item[1] or f"`{item[2]}`: {item[3]}"))
        elif out[-1].startswith("- ") and not text.startswith("   "):
            out.append(text.strip())
        else:
            out[-1] = f"{out[-1]} {text.strip()}".strip()
    out[0] = re.sub(r"^[\w-]+\.csv: ", "", out[0])
    out[0] = out[0][:1].upper() + out[0][1:]
    return [HEADER.sub("", text) for text in out if text]


def comments_of_members(body):
    """{member: text beside it}. A declaration of several members shares its comment."""
    found, names, ended = {}, [], True
    for line in body.split("\n"):
        code, mark, comment = line.partition("///<")
        if code.strip():
            names = MEMBER.findall(code) if ended else names + MEMBER.findall(code)
            ended = ";" in code
        for name in names if mark else ():
            found[name] = f"{found.get(name, '')} {comment.strip()}".strip()
    return found


def words_of(header):
    """{FILE: (paragraphs of what the table is, {column: what it is})} of one header."""
    words = {}
    for struct in STRUCT.finditer(header):
        comments = comments_of_members(struct["body"].partition("template")[0])
        words[struct["file"]] = (
            paragraphs(struct["comment"]),
            {
                column: HEADER.sub("", comments[member])
                for column, member in COLUMN.findall(struct["body"])
                if member in comments
            },
        )
    return words


def table_words(sources):
    """The words of all tables below a folder of headers."""
    words = {}
    for path in sorted(pathlib.Path(sources).rglob("*.h")):
        words.update(words_of(path.read_text(encoding="utf-8")))
    return words
