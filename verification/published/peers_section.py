# SPDX-License-Identifier: MIT
"""The section of docs/results.md on other methods than homespun's, from peers.csv."""
import itertools
from statistics import median

from numbers_of_page import LETTERS, table, three, with_bar

HEADING = "## Other methods\n"
ABOUT = """\
Methods of other people, written again in NumPy ([peers](../python/peers)) and held against the same
references by `homespun judge`: sheets of 10 x 10 cells, errors in 1/1000 of strain x cell side. The
table is written by [compare.py](../python/peers/compare.py).

- *flat*: fine vertices are carried along by their coarse triangle. It is `affine`, written again.
- *smooth*: cubic triangles through the coarse vertices, as of Vlachos, Peters, Boyd and Mitchell
  (2001).
- *learned 8, 32*: a linear operator after Kavan, Gerszewski, Bargteil and Sloan (2011), with 8 or 32
  weights for each component of a fine vertex. It is not theirs in one respect: they draw weights to
  harmonic functions, here they are drawn to zero (ridge regression). It is trained on linear sheets
  whose opposite clamps move as smooth waves drawn by chance: *lr*, 20 frames clamped left and right;
  *all*, these and 20 frames clamped below and above. Training and testing take the same cell and the
  same meshes.
- *POD*: the sum of training frames that is nearest to the reference in the mean square. It is no
  method, because it is found with the reference at hand, and no bound on methods either: learned
  operators weigh coarse vertices near a fine one, and are no sums of whole frames.
- *base*: the coarse cloth of `full` without up-sampling, *a* or *b* as above. Peers start from the
  coarse cloth of *flat*: what base gains over flat is of the coarse cloth, and not of up-sampling.

Tested are the loads of the other tables, and means over ten waves that were not trained on. `strip-1`
and waves *left and right* have the clamps that *lr* was trained on; all others are new to it. No
tested frame, nor a multiple of one, is a training frame. Under `biot` operators are those trained
on linear sheets. `full` and its base have coarse cloths of their own, and none under the waves.

An error bar of `full` and of the paper's method tells how much the error changes as coarse cloth and
reference are solved on finer meshes together. A peer is not solved on finer meshes: its bar is that
of the reference, which is at least as large and leaves more cases open.

Training frames and waves are solved by [training.py](../python/peers/training.py) and not by the
program. Its tests hold it against the program's sheets; errors under the waves have no bars.
"""
TIMES = """\
Run times of a sheet in milliseconds, the coarse cloth's and the method's, medians over the rows
above. They do not compare methods: those of homespun are in C++ and each was measured once, the
others are in NumPy and medians of five, and the machine was busy. Orders of magnitude count, and
one digit is shown.
"""
COLUMNS = (  # title, method, trained on
    ("flat", "flat", ""), ("smooth", "smooth", ""),
    ("learned 8 *lr*", "learned_8", "left and right"),
    ("learned 32 *lr*", "learned_32", "left and right"),
    ("learned 8 *all*", "learned_8", "both pairs"),
    ("learned 32 *all*", "learned_32", "both pairs"),
    ("POD *lr*", "pod", "left and right"), ("POD *all*", "pod", "both pairs"),
    ("paper", "localized", ""), ("base", "base", ""), ("`full`", "full", ""))
PEERS = [one for one in COLUMNS if one[1] in ("flat", "smooth", "learned_8", "learned_32")]


def cases(rows):
    """[(cell, tested, law, {(method, trained on): row})], in the order of the rows. Of the two
    bases, the one with the smaller error is there once more as `base`.
    """
    key = [(row["cell"], row["tested"], row["law"]) for row in rows]
    found = []
    for one in dict.fromkeys(key):
        its = {(row["method"], row["trained_on"]): row for row, of in zip(rows, key) if of == one}
        bases = [its[name, ""] for name in LETTERS if (name, "") in its]
        if bases:
            its["base", ""] = min(bases, key=lambda row: float(row["error"]))
        found.append((*one, its))
    return found


def is_nearer(one, other, by_bars=True):
    """Whether a row has the smaller error, by more than the bars of both: undecided without them."""
    bars = [row["error_bar"] for row in (one, other)]
    least = 0.0 if not by_bars else sum(map(float, bars)) if all(bars) else float("inf")
    return float(other["error"]) - float(one["error"]) > least


def outcomes(rows, method):
    """What each case says of a method of homespun: {outcome: [(cell, tested, law, {name of a peer:
    its row}, row of the method)]}.

    peer: peers, those named, are nearer by more than both bars; method: it is so to every peer;
    open: neither, peers that are nearer are named; barless: there are no bars, the same
    """
    found = {"peer": [], "method": [], "open": [], "barless": []}
    for cell, tested, law, its in cases(rows):
        own = its.get((method, ""))
        if not own:
            continue
        peers = {title: its[peer, on] for title, peer, on in PEERS if (peer, on) in its}
        decided = {title: row for title, row in peers.items() if is_nearer(row, own)}
        nearer = {title: row for title, row in peers.items() if is_nearer(row, own, False)}
        outcome = ("barless" if not own["error_bar"] else "peer" if decided else
                   "method" if all(is_nearer(own, row) for row in peers.values()) else "open")
        found[outcome].append((cell, tested, law, decided or nearer, own))
    return found


def winners(rows):
    """Who is nearer, peers or a method of homespun: counts, and every case of a peer."""
    def listed(some):
        return "".join(f"- `{cell}`, {tested}, {law}: "
                       + ", ".join(f"{title} {with_bar(row, 'error')}" for title, row in nearer.items())
                       + f"; against {with_bar(own, 'error')}.\n"
                       for cell, tested, law, nearer, own in some if nearer) or "- none.\n"

    for title, method in (("`full`", "full"), ("the paper's method", "localized")):
        found = outcomes(rows, method)
        n = sum(len(found[outcome]) for outcome in ("peer", "method", "open"))
        yield (f"Against {title}, {n} cases have error bars. A peer is nearer by more than the sum of"
               f" both bars in {len(found['peer'])} of them; {title} is nearer than every peer, by"
               f" more than both bars, in {len(found['method'])}; {len(found['open'])} are open. A"
               " peer is nearer, decided:\n")
        yield listed(found["peer"])
        yield "A peer is nearer by less than both bars, which decides nothing:\n"
        yield listed(found["open"])
        if found["barless"]:
            yield "A peer is nearer under the waves, which have no bars:\n"
            yield listed(found["barless"])


def section(rows):
    """The section as parts of a page."""
    def shown(row):
        letter = f" *{LETTERS[row['method']]}*" if row["method"] in LETTERS else ""
        return three(row["error"]) + letter

    lines = [[f"`{cell}`", tested, law, *(shown(its[method, on]) if (method, on) in its else "–"
                                          for _, method, on in COLUMNS)]
             for cell, tested, law, its in cases(rows)]
    times, timed = [], [one for one in COLUMNS if one[1] not in ("pod", "base")]
    for cell, some in itertools.groupby(rows, key=lambda row: row["cell"]):
        some = list(some)
        seconds = [[float(row["seconds"]) for row in some if row["seconds"]
                    and (row["method"], row["trained_on"]) == (method, on)]
                   for _, method, on in timed]
        times.append([f"`{cell}`", *(f"{float(f'{1e3 * median(one):.1g}'):g}" if one else "–"
                                     for one in seconds)])
    return [HEADING, ABOUT,
            table(["cell", "tested", "law", *(title for title, *_ in COLUMNS)], lines, 3),
            *winners(rows), TIMES, table(["cell", *(title for title, *_ in timed)], times, 1)]
