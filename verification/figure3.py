# SPDX-License-Identifier: MIT
"""Figure 3 of the paper for the build's target figure3: FOLDER HOMESPUN CELL.prm...

A study of each cell in FOLDER/CELL, as many at once as there are processors, each on one rank, which
is faster than one study on several; then their run times, one after the other and nothing beside;
then FOLDER/report.html of all. What is there of the same revision is taken up.

Ends with 0 where all claims hold or are open (statuses 0 and 4), and where the only claims that
failed are on the method (status 1): a cell for which up-sampling loses is a result. Those claims
are printed last.
"""
import json
import os
import pathlib
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ENDED = (0, 1, 4)


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


def study(homespun, cell, output, *options):
    """Status of a study of one cell."""
    command = [homespun, "strain", cell, "--no-report", *options, "--output", output]
    return subprocess.run(command, check=False).returncode


def judge(folder, status):
    """Prints what failed of the method, and the status that is left."""
    of_method, others = failed_claims(folder)
    for verdict in of_method:
        print(
            f"The method does not hold here: {verdict['claim']}:"
            f" {verdict['value']} ({verdict['limit']})"
        )
    return 1 if status == 1 and (others or not of_method) else 0


def main(folder, homespun, *cells):
    outputs = [pathlib.Path(folder) / pathlib.Path(cell).stem for cell in cells]
    with ThreadPoolExecutor(min(len(cells), os.cpu_count() or 1)) as several:
        statuses = list(several.map(
            lambda cell, output: study(homespun, cell, output, "--no-runtime"), cells, outputs))
    for k, status in enumerate(statuses):
        if status in ENDED:
            statuses[k] = study(homespun, cells[k], outputs[k])
    ill = [status for status in statuses if status not in ENDED]
    if ill:
        return ill[0]
    status = subprocess.run([homespun, "report", *outputs, "--output", folder],
                            check=False).returncode
    return max([status, *(judge(*one) for one in zip(outputs, statuses))])


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
