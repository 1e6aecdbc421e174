# SPDX-License-Identifier: MIT
"""Runs `homespun strain` for the build's target figure3: FOLDER COMMAND...

Ends with 0 where all claims hold or are open (statuses 0 and 4), and where the only claims that
failed are on the method (status 1): a cell for which up-sampling loses is a result. Those claims
are printed last.
"""
import json
import pathlib
import subprocess
import sys


def failed_claims(folder):
    """(claims on the method, other claims) that failed, from verdicts.json."""
    with open(pathlib.Path(folder) / "verdicts.json", encoding="utf-8") as file:
        failed = [
            verdict for verdict in json.load(file)["verdicts"] if verdict["verdict"] == "FAIL"
        ]
    return (
        [verdict for verdict in failed if verdict["kind"] == "method"],
        [verdict for verdict in failed if verdict["kind"] != "method"],
    )


def main(folder, command):
    status = subprocess.run(command, check=False).returncode
    if status not in (0, 1, 4):
        return status
    of_method, others = failed_claims(folder)
    for verdict in of_method:
        print(
            f"The method does not hold here: {verdict['claim']}:"
            f" {verdict['value']} ({verdict['limit']})"
        )
    if status == 1 and (others or not of_method):
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
