# SPDX-License-Identifier: MIT
"""Which runs a page shows, and what of them it does not."""
from figures.style import seconds
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


def whole_sentence(results):
    """Of a page of one `verify`, which run it is and of what parts; else empty."""
    runs = [study.run for study in results.studies]
    if len(runs) < 2 or len({run.place for run in runs}) > 1:
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
