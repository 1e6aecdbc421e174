# SPDX-License-Identifier: MIT
"""Which runs a page shows, what of them it does not, and their claims by what they speak of."""
from collections import Counter

from figures.style import seconds
from page import tables
from read.verdicts import KINDS, MARKS, ORDER, WORDS, words_of
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
    elif len(runs) > 1:
        whole = next(run.whole for run in runs if run.whole)
        sentences.append(
            f"One run of `homespun verify` (revision {whole.revision}, run {whole.fingerprint})"
            f" with its parts {', '.join(run.name for run in runs if run.whole)}."
        )
    sentences += [
        f"The run in {run.folder} did not come to its end: the tables it wrote so far are shown."
        " Begun again, it goes on."
        for run in runs
        if not run.finished
    ]
    return sentences


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


def verdict_contents(verdict, commands, study):
    """One row; its command only where it is not among those at the head of the page.

    @param study name of its folder, where there are several
    """
    value = verdict.get("value")
    return {
        "claim": f"{study}: {verdict['claim']}" if study else verdict["claim"],
        "kind": verdict["kind"],
        "verdict": verdict["verdict"],
        "mark": MARKS[verdict["verdict"]],
        "word": WORDS[verdict["verdict"]],
        "value": "–" if value is None else tables.shown(value),
        "limit": tables.shown(verdict.get("limit", "")),
        "derivation": verdict["derivation"],
        "command": "" if verdict.get("command") in commands else verdict.get("command", ""),
    }


def verdict_groups(verdicts):
    """[{"kind", "heading", "sentence", "verdicts"}]; in each group what failed comes first, then
    what is open.
    """
    groups = []
    for kind, heading in KINDS.items():
        some = sorted((v for v in verdicts if v["kind"] == kind), key=lambda v: ORDER[v["verdict"]])
        if some:
            groups.append(
                {"kind": kind, "heading": heading, "sentence": counted(some), "verdicts": some}
            )
    return groups


def counted(verdicts):
    """12 of 15 claims hold, 2 fail, 1 is open."""
    return words_of(Counter(v["verdict"] for v in verdicts), "claim")


def verdict_sentence(verdicts):
    """Counts of all claims, then of each kind."""
    groups = verdict_groups(verdicts)
    return (
        counted(verdicts) + ": " + "; ".join(f"{g['kind']}: {g['sentence']}" for g in groups) + "."
    )
