# SPDX-License-Identifier: MIT
"""The section of docs/results.md on other methods than homespun's, from peers.csv."""
import itertools

HEADING = "## Other methods\n"
ABOUT = """\
Methods of other people, written again in NumPy ([peers](../python/peers)) and held against the same
references by `homespun judge`: sheets of 10 x 10 cells, errors in 1/1000 of strain x cell side. The
table is written by [compare.py](../python/peers/compare.py).

- *flat*: fine vertices are carried along by their coarse triangle. It is `affine`, written again.
- *smooth*: cubic triangles through the coarse vertices, as of Vlachos, Peters, Boyd and Mitchell
  (2001).
- *learned 8, 32*: a linear operator after Kavan, Gerszewski, Bargteil and Sloan (2011), with 8 or 32
  weights for each component of a fine vertex. It is trained on linear sheets whose opposite clamps
  move as smooth waves drawn by chance: *lr*, 20 frames clamped left and right; *all*, these and 20
  frames clamped below and above. Training and testing take the same cell and the same meshes.
- *POD*: the best that any sum of the training frames comes to. It is a bound and no method: it is
  found with the reference at hand.

Tested are the loads of the other tables, and means over ten waves that were not trained on. `strip-1`
and waves *left and right* have the clamps that *lr* was trained on; all others are new to it. No
tested frame, nor a multiple of one, is a training frame. Under `biot` operators are those trained
on linear sheets. `full` has coarse cloths of its own, and none under the waves.
"""
TIMES = """\
Run times of a sheet in milliseconds, the coarse cloth's and the method's, medians over the rows
above: methods of homespun in C++, one call; others in NumPy, medians of five. The machine was busy:
orders of magnitude count.
"""
COLUMNS = (  # title, method, trained on
    ("flat", "flat", ""), ("smooth", "smooth", ""),
    ("learned 8 *lr*", "learned_8", "left and right"),
    ("learned 32 *lr*", "learned_32", "left and right"),
    ("learned 8 *all*", "learned_8", "both pairs"),
    ("learned 32 *all*", "learned_32", "both pairs"),
    ("POD *lr*", "pod_bound", "left and right"), ("POD *all*", "pod_bound", "both pairs"),
    ("paper", "localized", ""), ("`full`", "full", ""))
PEERS = [one for one in COLUMNS if one[1] not in ("localized", "full", "pod_bound")]


def cases(rows):
    """[(cell, tested, law, {(method, trained on): row})], in the order of the rows."""
    key = [(row["cell"], row["tested"], row["law"]) for row in rows]
    return [(*one, {(row["method"], row["trained_on"]): row
                    for row, its in zip(rows, key) if its == one}) for one in dict.fromkeys(key)]


def error_of(its, method, trained_on=""):
    row = its.get((method, trained_on))
    return float(row["error"]) if row else None


def winners(rows):
    """Lines of the list of cases in which a peer is nearer than homespun's method."""
    for title, method in (("`full`", "full"), ("the paper's method", "localized")):
        found = []
        for cell, tested, law, its in cases(rows):
            own = error_of(its, method)
            nearer = [f"{name} {error_of(its, peer, on):.3g}" for name, peer, on in PEERS
                      if own is not None and (error_of(its, peer, on) or own) < own]
            if nearer:
                found.append(f"- `{cell}`, {tested}, {law}: {', '.join(nearer)}; against {own:.3g}.")
        n = sum(error_of(its, method) is not None for *_, its in cases(rows))
        yield (f"A peer is nearer than {title} in {len(found)} of {n} cases"
               f"{':' if found else '.'}\n")
        if found:
            yield "\n".join(found) + "\n"


def section(rows, table, three, median):
    """The section as parts of a page; table, three digits and median as the page has them."""
    lines = [[f"`{cell}`", tested, law,
              *(three(its[key]["error"]) if (key := (method, on)) in its else "–"
                for _, method, on in COLUMNS)] for cell, tested, law, its in cases(rows)]
    times = []
    for cell, some in itertools.groupby(rows, key=lambda row: row["cell"]):
        some = list(some)
        seconds = [[float(row["seconds"]) for row in some if row["seconds"]
                    and (row["method"], row["trained_on"]) == (method, on)]
                   for _, method, on in COLUMNS]
        times.append([f"`{cell}`", *(f"{float(f'{1e3 * median(one):.2g}'):g}" if one else "–"
                                     for one in seconds)])
    titles = [title for title, *_ in COLUMNS]
    return [HEADING, ABOUT, table(["cell", "tested", "law", *titles], lines, 3), *winners(rows),
            TIMES, table(["cell", *titles], times, 1)]
