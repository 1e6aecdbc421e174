# SPDX-License-Identifier: MIT
"""Abaqus' decks, for convert_mesh.py: CMake puts both into one text, this one in front.

meshio 5 passes over in silence what makes or moves points, the points of all parts but the last
and sets in front of their elements, and knows neither sets of sets nor most flat elements.
"""
import re

LINES = re.compile(r"t2d2|t3d2|b2|b3|mass|spring|dashpot|conn")
FLAT = re.compile(r"(?:cps|cpe|m3d|stri|ds|s|r3d|dc2d)([34])(?!\d)")
GENERATORS = {"system", "ngen", "ncopy", "nfill", "nmap", "elgen", "elcopy", "element generation"}


def sections(text):
    """[keyword, {parameter: value}, data lines as lists of fields] of a deck."""
    found, continued = [], False
    for line in map(str.strip, text.splitlines()):
        if not line or line.startswith("**"):
            continue
        if continued or line.startswith("*"):
            if continued:
                found[-1][0] += line
            else:
                found.append([line, []])
            continued = line.endswith(",")
        elif found:
            found[-1][1].append([field.strip() for field in line.split(",")])
    for head, lines in found:
        keyword, *parameters = head[1:].split(",")
        pairs = (parameter.partition("=") for parameter in parameters if parameter.strip())
        yield (keyword.strip().lower(),
               {key.strip().lower(): value.strip() for key, _, value in pairs}, lines)


def refuse_rules(keyword, parameters, lines):
    """What would make or move points and elements."""
    if keyword == "include" or (keyword in ("node", "element", "elset") and "input" in parameters):
        raise Refusal("found data in another file; expected one whole file: insert the other one")
    if keyword in GENERATORS:
        raise Refusal(f"found *{keyword}, which makes or moves points or elements; expected all of "
                      "them in *NODE and *ELEMENT: let the program that wrote the file write the "
                      "mesh itself")
    if keyword == "instance" and lines:
        raise Refusal("found an *INSTANCE that moves or turns its part; expected a part where it "
                      "was drawn: leave out the lines after *INSTANCE")
    if keyword == "node" and parameters.get("system", "r").lower() != "r":
        raise Refusal("found points in cylindrical or spherical coordinates; expected x, y and z: "
                      "leave out SYSTEM")


class Deck:
    """Points, elements and sets of Abaqus, by their numbers there."""

    def __init__(self, text):
        self.points, self.elements, self.sets = {}, {}, {}
        self.own_set, self.elements_of = {}, {}  # sets of *ELEMENT, either way
        self.spelling = {}  # names that differ in capitals alone are one: the first one is shown
        for keyword, parameters, lines in sections(text):
            refuse_rules(keyword, parameters, lines)
            if keyword == "node":
                for fields in lines:
                    x = [*fields[1:], "0", "0"][:3] if len(fields) == 3 else fields[1:4]
                    self.put_new("point", self.points, int(fields[0]),
                                 [float((c or "0").upper().replace("D", "E")) for c in x])
            elif keyword == "element":
                self.add_elements(parameters, lines)
            elif keyword == "elset":
                members = self.sets.setdefault(self.name(parameters.get("elset", "")), [])
                members += map(generated, lines) if "generate" in parameters else [
                    range(int(field), int(field) + 1) if field.isdigit() else self.name(field)
                    for fields in lines for field in fields if field]

    def name(self, text):
        """Of a set, as it was written first."""
        return text and self.spelling.setdefault(text.lower(), text)

    @staticmethod
    def put_new(what, those, number, value):
        if those.setdefault(number, value) is not value:
            raise Refusal(f"{what} {number} is given twice, as in a deck of several parts; "
                          "expected each number once: merge the parts (Abaqus: Merge/Cut "
                          "Instances, retain intersecting boundaries), or number the nodes anew")

    def add_elements(self, parameters, lines):
        kind = parameters.get("type", "").lower()
        if LINES.match(kind):
            return
        flat = FLAT.match(kind)
        if not flat:
            raise Refusal(f"holds elements of Abaqus' type `{parameters.get('type', '')}`; "
                          f"{STRAIGHT_AND_FLAT}")
        for fields in lines:
            number, *corners = map(int, fields[:int(flat[1]) + 1])
            if len(corners) < int(flat[1]):
                raise Refusal(f"element {number} has {len(corners)} corners; {WHOLE}")
            self.put_new("element", self.elements, number, corners)
            self.own_set[number] = self.name(parameters.get("elset"))
            self.elements_of.setdefault(self.own_set[number], []).append(number)

    def members(self, name, seen):
        """Numbers of the elements of a set and of the sets in it."""
        if name in seen:
            return
        seen.add(name)
        if name not in self.sets and name not in self.elements_of:
            raise Refusal(f"an *ELSET holds `{name}`, which is neither a number nor a set; "
                          "expected elements or sets of them")
        yield from self.elements_of.get(name, ())
        for its in self.sets.get(name, ()):
            if isinstance(its, str):
                yield from self.members(its, seen)
            elif len(its) < len(self.elements):
                yield from (number for number in its if number in self.elements)
            else:
                yield from (number for number in self.elements if number in its)

    def set_of(self):
        """The set of each element, and the sets of all elements where others, which are partial or
        held by one, name each. A set that others hold stands for them alone."""
        held = {its for members in self.sets.values() for its in members if isinstance(its, str)}
        whole = [name for name in self.sets
                 if len(set(self.members(name, set()))) == len(self.elements)]
        named = self.set_among([name for name in self.sets if name not in whole])
        parts = [named.get(number, self.own_set[number] if self.own_set[number] in held else None)
                 for number in self.elements]
        if all(parts):
            return parts, whole
        named = self.set_among(self.sets)
        return [named.get(number, self.own_set[number] or None) for number in self.elements], []

    def set_among(self, names):
        """{element: set} of these sets of *ELSET, those that others of them hold left out."""
        held = {its for name in names for its in self.sets[name] if isinstance(its, str)}
        named = {}
        for name in names:
            for number in self.members(name, set()) if name not in held else ():
                put(named, number, name, f"element {number}")
        return named


def generated(fields):
    """A line `first, last, step` of a set."""
    first, last, step = map(int, [field or "1" for field in [*fields, "1"][:3]])
    if not 1 <= first <= last < 2**31 or step < 1:
        raise Refusal(f"found the range `{first}, {last}` of elements; expected `first, last, "
                      "step`, positive and rising")
    return range(first, last + 1, step)


def of_abaqus(text):
    deck = Deck(text)
    index = {number: k for k, number in enumerate(deck.points)}
    mesh = Mesh(list(deck.points.values()))
    sets, whole = deck.set_of()
    groups, mesh.number_of_name = numbered(sets)
    mesh.number_of_name.update({name: 0 for name in whole})  # which is no group
    for corners in deck.elements.values():
        for number in corners:
            if number not in index:
                raise Refusal(f"an element names point {number}, which the file does not give; "
                              f"expected one of its {len(index)} points: write the file again")
    mesh.add([[index[number] for number in its] for its in deck.elements.values()], groups)
    return mesh


