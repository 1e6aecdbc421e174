# SPDX-License-Identifier: MIT
"""A reader of USD's text format, as far as homespun writes it."""
import re


class Usda:
    """What a layer of USD's text format may hold, as far as it is written here: metadata, one prim
    with attributes, whose values are numbers, texts, tuples and arrays."""

    def __init__(self, text):
        head, self.text = text.split("\n", 1)
        assert head == "#usda 1.0", head
        self.tokens = re.findall(r'"[^"\n]*"|[A-Za-z_][\w:]*(?:\[\])?|-?\d[\d.]*(?:e[-+]?\d+)?|\S',
                                 self.text)
        self.at = 0
        self.expect("(")
        self.metadata = self.assignments(")")
        self.expect("def")
        self.kind, self.name = self.take(), self.take()
        self.expect("{")
        self.attributes = self.assignments("}")
        assert self.at == len(self.tokens), self.tokens[self.at:]

    def take(self):
        self.at += 1
        return self.tokens[self.at - 1]

    def expect(self, token):
        found = self.take()
        assert found == token, (found, token)

    def assignments(self, end):
        found = {}
        while self.tokens[self.at] != end:
            words = []
            while self.tokens[self.at] != "=":
                words.append(self.take())
            self.expect("=")
            found[" ".join(words)] = self.value()
        self.expect(end)
        return found

    def value(self):
        token = self.take()
        if token in "([":
            items, end = [], {"(": ")", "[": "]"}[token]
            while self.tokens[self.at] != end:
                items.append(self.value())
                if self.tokens[self.at] == ",":
                    self.take()
                else:
                    break
            self.expect(end)
            return tuple(items) if token == "(" else items
        return token[1:-1] if token[0] == '"' else float(token)
