# SPDX-License-Identifier: MIT
"""Whether a cell is as stiff as measured cloth, and what the model of a cell with crossing yarns
leaves out.
"""
import itertools

import numpy

from figures import fabrics
from figures.stiffness import directional_modulus
from figures.style import three
from page.entries import MICRO
from page.words import listed
from read.stiffness import best_run, centre_and_bars

YARN = 5.0  # largest modulus over the smallest from which a phase is one of yarns
CROSSED = 30.0  # degrees between yarns that cross
LEFT_OUT = (
    "Yarns of this cell cross, and the model glues them at every crossing, in one plane.",
    "It leaves out that yarns slide and turn on each other, lock under shear, and straighten when"
    " pulled, unless the moduli of the phases have the crimp in them: straight yarns are stiffer by"
    " 2.5 to over 100 times.",
    "A glued crossing of two equal yarns bends like eight of them, one that slides like two, so that"
    " D is an upper limit.",
)


def plausible_sentences(cell):
    """What is outside of measured cloth, in one sentence, and of woven cells three on the model."""
    outside, inside = [], []
    for name, value, unit, (low, high) in measures_of(cell):
        shown = f"{name} = {three(value)}{unit}"
        if low <= value <= high:
            inside.append(name)
        elif value > high:
            outside.append(f"{shown}, {three(value / high)} times the largest measured ({three(high)})")
        else:
            outside.append(f"{shown}, below the smallest measured ({three(low)})")
    sentences = []
    if outside:
        within = f"; within: {listed(inside)}" if inside else ""
        sentences.append(f"Outside of measured cloth: {'; '.join(outside)}{within} ({fabrics.SOURCES}).")
    elif inside:
        sentences.append(f"Within measured cloth ({fabrics.SOURCES}): {listed(inside)}.")
    return sentences + (list(LEFT_OUT) if crossing(cell) else [])


def measures_of(cell):
    """(name, value, unit, (smallest, largest measured)) of all that a cell has."""
    found = []
    if value := best_run(cell, "C"):
        C, _ = centre_and_bars(value, "C")
        for k, name in enumerate(("C11", "C22", "C66")):
            low_high = fabrics.stretch_band() if k < 2 else fabrics.shear_band()
            found.append((name, float(C[k, k]), " N/m", low_high))
    if value := best_run(cell, "D"):
        D, _ = centre_and_bars(value, "D")
        band = tuple(MICRO * end for end in fabrics.bending_band())
        for k, name in enumerate(("D11", "D22")):
            found.append((name, MICRO * float(D[k, k]), " × 10⁻⁶ N m", band))
        yarns = crossing(cell)
        if yarns and numpy.linalg.eigvalsh(D).min() > 0.0:
            bias = numpy.radians(sum(yarns) / 2.0 + numpy.array([0.0, 90.0]))
            on_bias = directional_modulus(D, bias).mean()
            for angle, along in zip(yarns, directional_modulus(D, numpy.radians(yarns))):
                name = f"bending on the bias over that along the yarns at {angle:g}°"
                found.append((name, float(on_bias / along), "", fabrics.bias_band()))
    return found


def crossing(cell):
    """Two angles [degrees] of yarns, those that cross nearest to a right angle; None where no yarns
    cross. The bias is the mean of both directions halfway between them.
    """
    angles = sorted({
        float(phase["angle"]) % 180.0
        for phase in cell.phases or []
        if is_number(phase.get("angle")) and is_yarn(phase)
    })
    between, yarns = max(
        ((abs((one - other + 90.0) % 180.0 - 90.0), (one, other))
         for one, other in itertools.combinations(angles, 2)),
        default=(0.0, None),
    )
    return yarns if between >= CROSSED else None


def is_yarn(phase):
    """Whether one modulus is far below another: E across the yarn; or, where a crimped yarn is no
    stiffer along than across or two yarns cross in one phase, E = 2 (1 + nu) G of its shear.
    """
    E1, E2, nu, G = (phase.get(key) for key in ("E1", "E2", "nu12", "G12"))
    if not (is_number(E1) and is_number(E2)):
        return False
    moduli = [E1, E2]
    if is_number(nu) and is_number(G):
        moduli.append(2.0 * (1.0 + nu) * G)
    return max(moduli) > YARN * min(moduli) > 0.0


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)
