# SPDX-License-Identifier: MIT
"""What claims can be, and how readers read it."""
KINDS = {
    "program": "The program computes what it says",
    "input": "Cell, mesh and scene are fit for the question",
    "method": "The method does what it is for, at this cell, load and strain",
}
MARKS = {"PASS": "✓", "FAIL": "✗", "INCONCLUSIVE": "○"}
WORDS = {"PASS": "PASS", "FAIL": "FAIL", "INCONCLUSIVE": "open"}
ORDER = {"FAIL": 0, "INCONCLUSIVE": 1, "PASS": 2}


def words_of(count, what):
    """12 of 13 cases hold, 1 fails, 2 are open.

    @param count how many there are of each outcome
    """
    total = sum(count.values())
    words = [
        f"{count['PASS']} of"
        f" {total} {what}{'' if total == 1 else 's'} hold{'s' if count['PASS'] == 1 else ''}"
    ]
    if count["FAIL"]:
        words.append(f"{count['FAIL']} fail{'s' if count['FAIL'] == 1 else ''}")
    if count["INCONCLUSIVE"]:
        words.append(
            f"{count['INCONCLUSIVE']} {'is' if count['INCONCLUSIVE'] == 1 else 'are'} open"
        )
    return ", ".join(words)
