# SPDX-License-Identifier: MIT
"""The files of one run, as the published tables are made from them."""
from read.stored import BadResults, check_verdicts, read_csv, read_json


class Results:
    """The files of one run, each read once; what it cannot give is a fault."""

    def __init__(self, run):
        self.run = run

    def path(self, name):
        path, why = self.run.take(name)
        if path is None:
            raise BadResults([why])
        return path

    def table(self, name):
        faults, missing = [], []
        rows = read_csv(self.path(name), faults, missing)
        if faults:
            raise BadResults(faults)
        return rows

    def json(self, name):
        faults = []
        value = read_json(self.path(name), faults)
        if faults:
            raise BadResults(faults)
        return value

    def verdicts(self):
        faults = []
        verdicts = check_verdicts(self.json("verdicts.json"), self.path("verdicts.json"), faults)
        if faults:
            raise BadResults(faults)
        return verdicts
