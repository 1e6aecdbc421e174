# SPDX-License-Identifier: MIT
"""Effective stiffness: its modulus along each direction, and its bracket against degrees of
freedom.
"""
import numpy
from matplotlib import pyplot

from figures import style
from figures.plot_data import label_of, name_unseen
from read.stiffness import homogenized


RIM = 2.0  # times the largest modulus of C^H: a bound beyond it would flatten what is shown


def directional_modulus(stiffness, angles):
    """Modulus E(theta) of uniaxial tension along the direction theta.

    1/E = S11 c^4 + (2 S12 + S66) c^2 s^2 + S22 s^4 + 2 S16 c^3 s + 2 S26 c s^3, with the compliance
    S = C^-1 in Voigt order 11, 22, 12 with engineering shear, c = cos theta, s = sin theta.

    @param stiffness (3,3) [N/m]
    @param angles    (k) [rad]
    @return          (k) [N/m]
    """
    compliance = numpy.linalg.inv(stiffness)
    c, s = numpy.cos(angles), numpy.sin(angles)
    return 1.0 / (
        compliance[0, 0] * c**4
        + (2 * compliance[0, 1] + compliance[2, 2]) * c**2 * s**2
        + compliance[1, 1] * s**4
        + 2 * compliance[0, 2] * c**3 * s
        + 2 * compliance[1, 2] * c * s**3
    )


MODULUS = "modulus $E(\\theta)$ [N/m]"


def polar_frame(axes, quantity=MODULUS):
    """Directions and moduli of a polar plot."""
    axes.set_rlim(bottom=0.0)
    axes.set_rlabel_position(67.5)
    axes.yaxis.set_major_locator(pyplot.MaxNLocator(4, prune="lower"))
    axes.tick_params(axis="y", labelsize=7.5, colors="#444444")
    pyplot.setp(axes.get_yticklabels(), bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8})
    axes.set_thetagrids(
        range(0, 360, 45),
        ["0° = axis 1", "45°", "90° = axis 2", "135°", "180°", "225°", "270°", "315°"],
    )
    axes.tick_params(axis="x", pad=4)
    axes.spines["polar"].set_color("#BDBDBD")
    axes.get_xticklabels()[0].set_horizontalalignment("left")
    axes.get_xticklabels()[4].set_horizontalalignment("right")
    name_unseen(axes.xaxis, "direction $\\theta$ [rad]")
    name_unseen(axes.yaxis, quantity)
    low = -0.12 if axes.figure.get_figheight() > 4.0 else -0.26
    axes.text(0.5, low, quantity, transform=axes.transAxes, ha="center")


def draw_moduli(axes, curves, quantity=MODULUS):
    """The moduli of several matrices along each direction.

    @param curves name -> (matrix, colour, line style)
    """
    angles = numpy.linspace(0.0, 2.0 * numpy.pi, 721)
    for name, (matrix, colour, line) in curves.items():
        modulus = directional_modulus(matrix, angles)
        axes.plot(angles, modulus, ls=line, color=colour, label=label_of(name))
    polar_frame(axes, quantity)


def polar_figure(cell):
    """E(theta) of C^H between Voigt and Reuss.

    In the Loewner order Reuss <= C^H <= Voigt, and E(theta) = 1 / (e:S:e) is monotone in it: the
    two curves bound the third in every direction.
    """
    angles = numpy.linspace(0.0, 2.0 * numpy.pi, 721)
    figure, axes = pyplot.subplots(
        figsize=(5.2, 4.4), subplot_kw={"projection": "polar"}, layout="constrained"
    )
    rim = RIM * float(directional_modulus(homogenized(cell), angles).max())
    for key, label, colour, line, width in (
        ("voigt", "Voigt (upper bound)", style.VERMILLION, "--", 1.3),
        ("C", "$C^H$", style.BLUE, "-", 2.2),
        ("reuss", "Reuss (lower bound)", style.GREEN, "-.", 1.3),
    ):
        matrix = homogenized(cell) if key == "C" else cell.stiffness(key)
        if matrix is None or numpy.linalg.eigvalsh((matrix + matrix.T) / 2).min() <= 0:
            continue
        modulus = directional_modulus(matrix, angles)
        if modulus.max() > rim > 0.0:
            label += f"\nbeyond the rim, up to {style.three(float(modulus.max()))} N/m"
            modulus = numpy.where(modulus > rim, numpy.nan, modulus)
        axes.plot(angles, modulus, line, color=colour, lw=width, label=label)
    polar_frame(axes)
    figure.legend(loc="upper left", bbox_to_anchor=(1.0, 0.95))
    return figure


def bracket_history(cell):
    """(degrees of freedom, relative width) of each mesh on the way to the bracket, shape (k,2); k
    may be 0.
    """
    rows = (cell.homogenize or {}).get("history") or []
    return numpy.array([(row["dofs"], row["width"]) for row in rows], dtype=float).reshape(-1, 2)


def observed_slope(history):
    """Exponent p of width ~ dofs^p, fitted to the finer half of the meshes."""
    finer = numpy.log(history[len(history) // 2 :])
    return float(numpy.polyfit(finer[:, 0], finer[:, 1], 1)[0])


def bracket_figure(cell):
    """Relative width of the bracket on C^H against degrees of freedom; None for fewer than three
    meshes.
    """
    history = bracket_history(cell)
    if len(history) < 3:
        return None
    figure, axes = pyplot.subplots(figsize=(5.2, 3.4), layout="constrained")
    axes.loglog(
        history[:, 0],
        history[:, 1],
        "o-",
        color=style.BLUE,
        lw=1.8,
        ms=4,
        label=f"adaptive; slope of the finer half {observed_slope(history):.2f}".replace("-", "−"),
    )
    order = (cell.homogenize or {}).get("order")
    if order in (1, 2):
        axes.loglog(
            history[:, 0],
            history[-1, 1] * (history[:, 0] / history[-1, 0]) ** -order,
            "--",
            color="#777777",
            lw=1.0,
            label=f"P{order} on smooth solutions: slope −{order}",
        )
    axes.set_xlabel("degrees of freedom of the displacements")
    axes.set_ylabel("relative width of the bracket")
    axes.legend()
    return figure
