# SPDX-License-Identifier: MIT
"""A reader of USD's text format, as far as homespun writes it."""
import re

TOKEN = re.compile(r'"[^"\n]*"|<[^>\n]*>|[A-Za-z_][\w:.]*(?:\[\])?|-?\d[\d.]*(?:e[-+]?\d+)?|\n|\S')


class Prim:
    """Kind, name, metadata, attributes (relations and declarations too) and children."""

    def __init__(self, kind, name, metadata):
        self.kind, self.name, self.metadata = kind, name, metadata
        self.attributes, self.children = {}, {}


class Usda:
    """A layer: metadata and one prim. Values are numbers, texts, tuples, arrays and, of samples
    over time, dictionaries."""

    def __init__(self, text):
        head, text = text.split("\n", 1)
        assert head == "#usda 1.0", head
        self.tokens = TOKEN.findall(text)
        self.at = 0
        self.expect("(")
        self.metadata = self.assignments(")")
        self.expect("def")
        self.prim = self.read_prim()
        while self.at < len(self.tokens):
            self.expect("\n")

    def skip_lines(self):
        while self.at < len(self.tokens) and self.tokens[self.at] == "\n":
            self.at += 1

    def peek(self):
        self.skip_lines()
        return self.tokens[self.at]

    def take(self):
        token = self.peek()
        self.at += 1
        return token

    def expect(self, token):
        if token == "\n":
            self.at += 1
            return
        found = self.take()
        assert found == token, (found, token)

    def read_prim(self):
        kind, name, metadata = self.take(), self.take().strip('"'), {}
        if self.peek() == "(":
            self.expect("(")
            metadata = self.assignments(")")
        prim = Prim(kind, name, metadata)
        self.expect("{")
        while self.peek() != "}":
            if self.peek() == "def":
                self.expect("def")
                child = self.read_prim()
                assert child.name not in prim.children, child.name
                prim.children[child.name] = child
            else:
                self.assignment(prim.attributes)
        self.expect("}")
        return prim

    def assignment(self, found):
        words = [self.take()]
        while self.tokens[self.at] not in ("=", "\n"):
            words.append(self.take())
        if self.tokens[self.at] == "\n":  # a declaration
            found[" ".join(words)] = None
            return
        self.expect("=")
        found[" ".join(words)] = self.value()
        if self.tokens[self.at] == "(":
            self.expect("(")
            found[" ".join(words) + " metadata"] = self.assignments(")")

    def assignments(self, end):
        found = {}
        while self.peek() != end:
            self.assignment(found)
        self.expect(end)
        return found

    def value(self):
        token = self.take()
        if token == "{":
            samples = {}
            while self.peek() != "}":
                time = float(self.take())
                self.expect(":")
                samples[time] = self.value()
                self.expect(",")
            self.expect("}")
            return samples
        if token in "([":
            items, end = [], {"(": ")", "[": "]"}[token]
            while self.peek() != end:
                items.append(self.value())
                if self.peek() == ",":
                    self.expect(",")
            self.expect(end)
            return tuple(items) if token == "(" else items
        return token[1:-1] if token[0] in '"<' else float(token)
