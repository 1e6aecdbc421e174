# SPDX-License-Identifier: MIT
"""Which runs a page shows, and what of them it does not."""
import os

from figures.style import seconds
from read.runs import LIST
from read.stored import read_json
from read.versions import tags


def run_sentences(results):
    """What a reader must know before any figure: of which runs the page is made, and which did not
    end.
    """
    runs = [study.run for study in results.studies]
    sentences = []
    places = list(dict.fromkeys(run.place for run in runs))
    if len(places) > 1:
        heads = [next(run for run in runs if run.place == place) for place in places]
        names = tags(places)
        sentences.append(
            f"This page sets {len(heads)} runs side by side: "
            + "; ".join(
                f"{names[run.place]} ({run.command}, revision {run.revision}, run"
                f" {run.fingerprint})"
                for run in heads
            )
            + "."
        )
        if len({run.revision for run in heads}) > 1:
            sentences.append(
                "They were made by different revisions of homespun, so that a difference between"
                " them may come from the program."
            )
    sentences += [
        f"The run in {run.folder} did not come to its end: the tables it wrote so far are shown."
        " Begun again, it goes on."
        for run in runs
        if not run.finished
    ]
    return sentences


def self_tests(results, output):
    """Where the self-tests of the program are: {"link", "sentence"} of those that `homespun verify`
    made without a cell beside these results, of the same revision; a sentence alone where there are
    none.

    @param output folder of the page, for the link
    """
    revisions = {study.run.revision for study in results.studies}
    for place in dict.fromkeys(study.run.place for study in results.studies):
        for folder in ("verify", "verify-quick"):
            found = os.path.normpath(os.path.join(place, "..", "..", folder))
            value = read_json(os.path.join(found, LIST), []) if found != place else None
            if (
                value
                and value.get("command") == "verify"
                and value.get("finished") is True
                and {value.get("revision")} == revisions
                and not any(key.startswith("cell ") for key in value.get("inputs") or {})
                and os.path.isfile(os.path.join(found, "report.html"))
            ):
                link = os.path.relpath(os.path.join(found, "report.html"), output)
                return {"link": link, "sentence": "Self-tests of this revision of the program"}
    return {
        "link": "",
        "sentence": "Self-tests of the program (stress cases) are made once"
        " by `homespun verify` without a cell; none of this revision lies beside these results.",
    }


def whole_sentence(results):
    """Of a page of one `verify`, which run it is and of what parts; else empty."""
    runs = [study.run for study in results.studies]
    if len(runs) < 2 or len({run.place for run in runs}) > 1 or not any(run.whole for run in runs):
        return ""
    whole = next(run.whole for run in runs if run.whole)
    return (
        f"One run of `homespun verify` (revision {whole.revision}, run {whole.fingerprint})"
        f" with its parts {', '.join(run.name for run in runs if run.whole)}."
    )


def run_rows(results):
    """Folder, command, revision, fingerprint, whether it ended, and time of each run, as text."""
    return [
        [
            run.folder,
            run.command,
            run.revision,
            run.fingerprint,
            "yes" if run.finished else "no",
            seconds(run.seconds),
        ]
        for run in (study.run for study in results.studies)
    ]
