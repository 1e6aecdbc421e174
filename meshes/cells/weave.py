#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Moduli of the yarns of a woven cotton cell, from count, sett and cover of its yarns.

    weave.py NAME                      the materials of meshes/cells/NAME.prm, as they are shipped
    weave.py NAME --cover C            of yarns of another width, in pitches (`yarn_width`)
    weave.py NAME --seed N             of a variant whose count, sett and cover are drawn by chance

NAME is plain-weave, twill or satin. A yarn that dives from one face to the other straightens before
it stretches. Between two crossings, a pitch p apart, it is a straight beam of length l = p / cos a,
held without turning at each crossing and inclined by tan a = t / p; both sets of yarns are alike.
Pulled along its own direction, with the sides of the cloth free, the cloth then has the modulus

    K = 12 B / (l^3 sin^2 a) * (1 + 1) [N/m],      the last term that of the yarns across,
                                                   which bend with it (crimp interchange)

(G. A. V. Leaf, K. H. Kandil, The initial load-extension behaviour of plain-woven fabrics, Journal of
the Textile Institute 71, 1 to 7, 1980). The fibres of a yarn bend each by itself, as if nothing held
them together,

    B = n B_f,   n = T / T_f,   B_f = eta E_f T_f^2 / (4 pi rho_f) [N m^2]

(W. E. Morton, J. W. S. Hearle, Physical Properties of Textile Fibres, on the flexural rigidity of
fibres), which is the least that a yarn can have: friction between fibres makes it stiffer.
"""
import argparse
import math
import random

FIBRE_COUNT = 0.17e-6     # T_f, cotton [kg/m], 0.17 tex
FIBRE_MODULUS = 5e6       # E_f over density [N m/kg], 5 N/tex
FIBRE_DENSITY = 1520.     # rho_f [kg/m^3]
SHAPE_FACTOR = 0.7        # eta, of a cross-section that is no disk
YARN_DENSITY = 711.       # with the air between its fibres [kg/m^3]
SHARE_OF_MODULUS = 0.4    # of that of the fibres, left in a spun yarn
ACROSS = 1e7              # modulus across a yarn [Pa]; chosen
SHEAR = 90.               # G times thickness, friction alone [N/m]; chosen

SHIPPED = {"tex": 40., "per_cm": 20., "cover": 0.75}
DIVES = {"plain-weave": 1., "twill": 0.5, "satin": 0.4}  # of the pieces between two crossings


def drawn(name, seed):
    """Count [tex], yarns per centimetre and cover of a cotton cloth that can be woven, by chance."""
    chance = random.Random(f"{name} {seed}")
    while True:
        parameters = {"tex": round(chance.uniform(10., 60.), 1),
                      "per_cm": round(chance.uniform(10., 40.), 1),
                      "cover": round(chance.uniform(0.4, 0.9), 2)}
        width, thickness, pitch = cross_section(**parameters)
        if thickness <= width and thickness <= 0.5 * pitch and width >= 1e-4:
            return parameters


def cross_section(tex, per_cm, cover):
    """Width and thickness of a yarn, and the pitch [m]."""
    pitch = 0.01 / per_cm
    width = cover * pitch
    return width, tex * 1e-6 / (YARN_DENSITY * width), pitch


def crimp_modulus(tex, per_cm, cover):
    """K of a plain weave [N/m]."""
    _, thickness, pitch = cross_section(tex, per_cm, cover)
    angle = math.atan(thickness / pitch)
    length = pitch / math.cos(angle)
    fibre = SHAPE_FACTOR * FIBRE_MODULUS * FIBRE_COUNT ** 2 / (4 * math.pi * FIBRE_DENSITY)
    return 24. * tex * 1e-6 / FIBRE_COUNT * fibre / (length ** 3 * math.sin(angle) ** 2)


def dive_modulus(tex, per_cm, cover):
    """E1 of the piece between two crossings [Pa], into which all that straightens is put:
    (p - w) / (E1 w t) = 1 / K + (p - w) / (E w t)."""
    width, thickness, pitch = cross_section(tex, per_cm, cover)
    area = width * thickness
    yarn = SHARE_OF_MODULUS * FIBRE_MODULUS * YARN_DENSITY
    gap = pitch - width
    return gap / (area * (1. / crimp_modulus(tex, per_cm, cover) + gap / (yarn * area)))


def materials(name, tex, per_cm, cover):
    """The lines of a cell file that say what the yarns are."""
    width, thickness, pitch = cross_section(tex, per_cm, cover)
    yarn = SHARE_OF_MODULUS * FIBRE_MODULUS * YARN_DENSITY
    single = SHEAR / thickness
    pieces = [("", dive_modulus(tex, per_cm, cover))] if name == "plain-weave" else [
        ("-float", yarn), ("-dive", dive_modulus(tex, per_cm, cover))]
    moduli, thicknesses, densities = [], [], []
    for piece, along in pieces:
        for kind, angle in (("warp", 90), ("weft", 0)):
            moduli.append(f"{kind}{piece}: {along:.3g} {ACROSS:.3g} 0.3 {single:.3g} {angle}")
            thicknesses.append(f"{kind}{piece}: {thickness:.4g}")
            densities.append(f"{kind}{piece}: {YARN_DENSITY:g}")
    mean = 0.5 * (yarn + ACROSS)
    for kind, angle in (("warp", 90), ("weft", 0)):
        moduli.append(f"{kind}-over: {mean:.3g} {mean:.3g} 0.05 {0.5 * single:.3g} {angle}")
        thicknesses.append(f"{kind}-over: {2. * thickness:.4g}")
        densities.append(f"{kind}-over: {YARN_DENSITY:g}")
    return [f"set Length unit     = {pitch:.6g}",
            "set Orthotropic     = " + ", ".join(moduli),
            "set Thickness       = " + ", ".join(thicknesses),
            "set Density         = " + ", ".join(densities)]


def main():
    parser = argparse.ArgumentParser(description="Moduli of the yarns of a woven cotton cell")
    parser.add_argument("name", choices=sorted(DIVES))
    parser.add_argument("--seed", type=int, help="draw count, sett and cover by chance")
    parser.add_argument("--cover", type=float, default=SHIPPED["cover"],
                        help="width of a yarn over the pitch")
    arguments = parser.parse_args()
    parameters = ({**SHIPPED, "cover": arguments.cover} if arguments.seed is None else
                  drawn(arguments.name, arguments.seed))
    width, thickness, pitch = cross_section(**parameters)
    modulus = crimp_modulus(**parameters)
    print(f"# {parameters['tex']:g} tex, {parameters['per_cm']:g} yarns per centimetre, "
          f"cover {parameters['cover']:g}: pitch {pitch * 1e3:.3g} mm, "
          f"yarns {width * 1e3:.3g} mm x {thickness * 1e3:.3g} mm")
    print(f"# K = {modulus:.4g} N/m of a plain weave, {modulus / DIVES[arguments.name]:.4g} N/m of "
          f"{arguments.name}")
    print("\n".join(materials(arguments.name, **parameters)))


if __name__ == "__main__":
    main()
