# SPDX-License-Identifier: MIT
"""Which law for which cloth: up to which strain each membrane law is elliptic, against E/G.

A law that is not elliptic at a state has no minimum there: what is found depends on the mesh. For a
cloth of axes with moduli E (the stiffer) and G (shear), pulled or pressed along the axis of E with
its sides free and no lateral contraction, stretch l, the first loss is at

    biot, and the corotational coarse cloth    T = 4 G l pulled,  T (l + 2) = -4 G pressed
    green                                      never pulled,      S = -G pressed
    yarn                                       never pulled,      T = -G / l pressed

with T = E (l - 1) the Biot stress and S = E (l^2 - 1) / 2. Checked in the program against the least
wave of each law for five materials (tests/verification/laws).
"""
import numpy
from matplotlib import pyplot

from figures import style
from figures.fabrics import STRETCH
from figures.plot_data import name_unseen
from figures.stiffness import directional_modulus
from read.stiffness import homogenized

LARGEST = 1e3  # of E/G that is drawn, unless a cell lies beyond
STRAINS = (0.1, 50.0)  # percent


def loss_pulled(ratio):
    """Strain at which biot is lost along the axis of E; infinite where it never is.

    E (l - 1) = 4 G l gives l - 1 = 4 / (E/G - 4).
    """
    ratio = numpy.asarray(ratio, dtype=float)
    return numpy.where(ratio > 4.0, 4.0 / numpy.where(ratio > 4.0, ratio - 4.0, 1.0), numpy.inf)


def loss_pressed(law, ratio):
    """Strain, positive, by which the axis of E is shorter when a law is lost; one where it never
    is before the cloth has no length.

    biot  E (l - 1)(l + 2) = -4 G;  green  E (l^2 - 1) / 2 = -G;  yarn  E (l - 1) l = -G
    """
    ratio = numpy.asarray(ratio, dtype=float)
    root = {
        "biot": lambda r: (-1.0 + numpy.sqrt(9.0 - 16.0 / r)) / 2.0,
        "green": lambda r: numpy.sqrt(1.0 - 2.0 / r),
        "yarn": lambda r: (1.0 + numpy.sqrt(1.0 - 4.0 / r)) / 2.0,
    }[law]
    least = {"biot": 2.0, "green": 2.0, "yarn": 4.0}[law]
    return numpy.where(ratio >= least, 1.0 - root(numpy.maximum(ratio, least)), 1.0)


def anisotropy(stiffness):
    """E/G in the axes of the largest modulus, E = 1/S11 and G = C66 there.

    @param stiffness (3,3) [N/m], positive definite
    """
    angles = numpy.linspace(0.0, numpy.pi, 1801)
    moduli = directional_modulus(stiffness, angles)
    angle = angles[int(numpy.argmax(moduli))]
    c, s = numpy.cos(angle), numpy.sin(angle)
    shear = numpy.array([-c * s, c * s, c * c - s * s])  # of gamma12 = 1 there
    return float(moduli.max() / (shear @ stiffness @ shear))


def marks_of(cell):
    """(name, E/G) of the cell's C^H and of its phases that have axes; what is not positive definite
    has none.
    """
    matrices = [("$C^H$", homogenized(cell))] + [
        (str(phase.get("name", number)), numpy.array(phase["C"], dtype=float))
        for number, phase in enumerate(cell.phases or [])
        if phase.get("C") is not None and phase.get("E1") != phase.get("E2")
    ]
    return [
        (name, anisotropy(matrix))
        for name, matrix in matrices
        if matrix is not None and numpy.linalg.eigvalsh((matrix + matrix.T) / 2).min() > 0.0
    ]


def law_sentence(marked):
    """What the figure says of what is marked, in words."""
    name, ratio = marked[0]
    strain = float(loss_pulled(ratio))
    if not numpy.isfinite(strain):
        said = "is elliptic pulled along its stiff axis at any strain"
    else:
        said = f"is lost at {style.three(100.0 * strain)} % pulled along its stiff axis"
    yarn = "; `yarn` is not" if numpy.isfinite(strain) else ""
    plain = name.replace("$C^H$", "C^H")
    return f"With {plain} (E/G = {style.three(ratio)}) the law `biot` {said}{yarn}."


def law_figure(marked=()):
    """Two panels, pulled and pressed, with the measured fabrics.

    @param marked (name, E/G) of what a page is about
    """
    largest = max([LARGEST] + [1.5 * ratio for _, ratio in marked])
    ratios = numpy.geomspace(0.2, largest, 1200)
    figure, (pulled, pressed) = pyplot.subplots(
        2, 1, figsize=(8.2, 6.0), sharex=True, layout="constrained", height_ratios=(1.25, 1.0)
    )
    low, high = STRAINS
    lost = 100.0 * loss_pulled(ratios)
    pulled.fill_between(ratios, numpy.minimum(lost, high), high, color=style.VERMILLION, alpha=0.16, lw=0)
    pulled.fill_between(
        ratios, low, numpy.minimum(lost, high), where=ratios >= 1.0, color=style.BLUE, alpha=0.12, lw=0
    )
    pulled.plot(
        ratios,
        numpy.where(lost <= high, lost, numpy.nan),
        color=style.VERMILLION,
        label="biot and the corotational\ncloth are lost",
    )
    for axes in (pulled, pressed):
        axes.axvspan(ratios[0], 1.0, color="#9E9E9E", alpha=0.25, lw=0)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_ylim(low, high)
        axes.yaxis.set_major_formatter("{x:g}")
    pulled.text(3.0, 0.3, "biot, green, yarn,\ncorotational cloth", ha="left", va="center")
    pulled.text(0.5 * largest, 10.0, "green, yarn", ha="right", va="center")
    pulled.text(
        0.45, 2.0, "yarn not:\nstiff at 45°", ha="center", va="center", fontsize=7.5, color="#333333"
    )
    measured = {name: anisotropy(C) for name, C in STRETCH.items()}
    for k, (name, ratio) in enumerate(sorted(measured.items(), key=lambda one: one[1])):
        strain = 100.0 * float(loss_pulled(ratio))
        y = min(strain, high)
        pulled.plot(
            [ratio],
            [y],
            "o" if y < high else "^",
            color=style.BLACK,
            ms=4.5,
            clip_on=False,
            zorder=4,
            label=f"{len(measured)} measured fabrics" if k == 0 else "_nolegend_",
        )
    shapes = ("D", "s", "P", "X", "v", "<", ">", "h")
    for k, (name, ratio) in enumerate(marked):
        y = min(100.0 * float(loss_pulled(ratio)), high)
        pulled.plot(
            [max(ratio, ratios[0])],
            [max(y, low)],
            shapes[k % len(shapes)],
            color=style.BLUE,
            mec=style.BLACK,
            ms=7.5,
            clip_on=False,
            zorder=5,
            label=f"{name}: E/G = {style.three(ratio)}",
        )
    pulled.set_ylabel("strain, pulled along the stiff axis [%]")
    name_unseen(pulled.xaxis, "E/G [-]")
    for law, colour, line in (
        ("green", style.GREEN, "--"),
        ("biot", style.VERMILLION, "-"),
        ("yarn", style.BLUE, "-."),
    ):
        curve = 100.0 * loss_pressed(law, ratios)
        pressed.plot(
            ratios, numpy.where(curve <= high, curve, numpy.nan), line, color=colour, label=f"{law} is lost"
        )
    pressed.invert_yaxis()
    pressed.set_ylabel("strain, pressed along it [%]")
    pressed.set_xlabel("E/G, stiffer modulus over shear modulus [-]")
    pulled.set_xlim(ratios[0], largest)
    pulled.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    pressed.text(8.0, 0.5, "all of them", ha="left", va="center")
    pressed.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    return figure
