# SPDX-License-Identifier: MIT
"""The tables that the program writes, as its build says them in schema.json: columns in their
order, what each may hold, and how many of the first ones name a row.

    {"format_version": 1, "methods": {"affine": [], "localized": ["micro"], "full": ["p2", ...]},
     "laws": [{"name": "linear", "is_of_space": false, ...}, ...],
     "loads": [{"name": "strip-1", "label": "Sheet pulled along axis 1", "is_infinite": false}, ...],
     "claims": {"strain": {"norms": {"kind": "program", "claim": ..., ...}, ...}, ...},
     FILE: {"keys": 5, "columns": [{"name": "strain", "domain": "positive"}, ...]}, ...}

`format_version` is that of all files that this version of the program writes; `methods` are the
presets of methods with their terms, of which a name like `localized+p2` has more and `full-micro`
less; `laws` are those of references and `loads` those of studies, in their order, with what the
program knows of each; `claims` are verification/record/claims.json.

The program hands on where the file lies in HOMESPUN_SCHEMA; an installed report has it beside
report.py.
"""
import functools
import json
import math
import os
import re
from dataclasses import dataclass

OUTCOMES = ("PASS", "FAIL", "INCONCLUSIVE")
TEXTS = {"name", "text", "outcome"}

# What a number of each domain must be: in words, whether the field may be empty, and a test.
NUMBERS = {
    "real": ("a number, or nothing", True, lambda value: True),
    "not negative": ("a number, zero or above, or nothing", True, lambda value: value >= 0.0),
    "positive": ("a number above zero", False, lambda value: value > 0.0),
    "needed not negative": ("a number, zero or above", False, lambda value: value >= 0.0),
}


class NoSchema(Exception):
    """schema.json is missing, or is none."""


@dataclass(frozen=True)
class Column:
    name: str
    domain: str

    def read(self, field):
        """@return (value, "") of a field, or (what stands for it, what was expected)"""
        if self.domain in NUMBERS:
            return number_of(field, *NUMBERS[self.domain])
        if self.domain == "flag":
            return field == "true", "" if field in ("true", "false") else "true or false"
        if self.domain == "name" and not field:
            return field, "a name"
        if self.domain == "outcome" and field and field not in OUTCOMES:
            return "", f"nothing or one of {', '.join(OUTCOMES)}"
        return field, ""


def number_of(field, words, may_be_empty, is_right):
    """(number, ""), or (nan, what was expected)"""
    if not field:
        return math.nan, "" if may_be_empty else words
    try:
        value = float(field)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or not is_right(value):
        return math.nan, words
    return value, ""


@dataclass(frozen=True)
class Table:
    """One kind of file: its columns, of which the first `keys` name a row."""

    columns: tuple
    keys: int

    @property
    def names(self):
        return [column.name for column in self.columns]

    @property
    def key_names(self):
        return self.names[: self.keys]


def place():
    """Where schema.json is looked for."""
    program = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    return os.environ.get("HOMESPUN_SCHEMA") or os.path.join(program, "schema.json")


def tables():
    """{FILE: Table}

    @throws NoSchema
    """
    return read(place())[1]


def format_version():
    """The newest format that this report reads.

    @throws NoSchema
    """
    return read(place())[0]


def terms(method):
    """Names of the terms of a method; none of what is no method.

    @throws NoSchema
    """
    preset, *changes = re.split("(?=[+-])", method)
    found = set(read(place())[2].get(preset, ()))
    for change in changes:
        (found.add if change[0] == "+" else found.discard)(change[1:])
    return found


def is_of_homespun(method):
    """Whether a method is the program's, and not one of somebody's own that was judged.

    @throws NoSchema
    """
    return re.split("[+-]", method)[0] in read(place())[2]


def main_method(methods):
    """The method that a page speaks of among those of a load against a law: the one with most
    terms, of several the one whose terms come last; `localized` where none has micro.

    @throws NoSchema
    """
    order = read(place())[2]["full"]  # which has all terms
    ranked = {name: sorted(map(order.index, terms(name))) for name in methods}
    last = order.index("micro")
    return max(
        (name for name in ranked if last in ranked[name]),
        key=lambda name: (len(ranked[name]), ranked[name]),
        default="localized",
    )


def laws(of=None):
    """Names of the laws, in their order: all, or those that have a property.

    @throws NoSchema
    """
    return [law["name"] for law in read(place())[3] if of is None or law[of]]


def loads():
    """{name: what the program knows of it} of the loads, in their order.

    @throws NoSchema
    """
    return {load["name"]: load for load in read(place())[4]}


def claims():
    """{id: kind, sentence, limit and what it rests on} of the claims of all studies.

    @throws NoSchema
    """
    return read(place())[5]


def main_reference(references):
    """The law that claims, budget and pictures speak of: the first that the coarse cloth has too,
    else the first there is; None where there are none.

    @throws NoSchema
    """
    references = list(references)
    return next((law for law in (*laws("is_of_coarse_cloth"), *references) if law in references), None)


def table(file):
    """@throws NoSchema where the program writes no such file"""
    known = tables()
    if file not in known:
        raise NoSchema(
            f"{place()}: does not know {file}, as one of another version: build homespun, or set"
            " HOMESPUN_SCHEMA"
        )
    return known[file]


@functools.lru_cache(maxsize=None)
def read(path):
    try:
        with open(path, encoding="utf-8") as file:
            value = json.load(file)
        version = int(value.pop("format_version"))
        presets = {str(name): list(its) for name, its in value.pop("methods").items()}
        laws_there, loads_there = (
            [dict(one) for one in value.pop(key)] for key in ("laws", "loads")
        )
        claims_there = value.pop("claims")
        return (
            version,
            {
                name: Table(
                    tuple(
                        Column(column["name"], known(column["domain"]))
                        for column in one["columns"]
                    ),
                    one["keys"],
                )
                for name, one in value.items()
            },
            presets,
            laws_there,
            loads_there,
            {name: one for some in claims_there.values() for name, one in some.items()},
        )
    except OSError as error:
        raise NoSchema(
            f"schema.json is missing ({path}: {error.strerror}): build homespun, or set"
            " HOMESPUN_SCHEMA"
        ) from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise NoSchema(
            f"{path}: is not the schema.json of this version ({error}): build homespun, or set"
            " HOMESPUN_SCHEMA"
        ) from error


def known(domain):
    """@throws ValueError where a column may hold what this report cannot read"""
    if domain in NUMBERS or domain in TEXTS or domain == "flag":
        return domain
    raise ValueError(f"the domain `{domain}` is not known")
