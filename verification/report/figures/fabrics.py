# SPDX-License-Identifier: MIT
"""Ten measured fabrics: how a stiffness compares with real cloth.

Source: H. Wang, J. F. O'Brien, R. Ramamoorthi, Data-driven elastic models for cloth: modeling and
measurement, SIGGRAPH 2011; bending in the directions 0, 45 and 90 degrees, stretch at zero strain.
Some 250 cantilever tests of X. Feng, W. Huang, W. Xu, H. Wang, Learning-based bending stiffness
parameter estimation by a drape tester, SIGGRAPH Asia 2022, have softer cloth in bending.
"""
import numpy


def orthotropic(c11, c12, c22, c66):
    """Membrane stiffness (3,3) [N/m]."""
    return numpy.array([[c11, c12, 0.0], [c12, c22, 0.0], [0.0, 0.0, c66]])


# [N/m]; that of navy-sparkle-sweat is not positive definite as printed, and left out.
STRETCH = {
    "gray-interlock": orthotropic(16.6, -14.7, 34.5, 36.9),
    "11oz-black-denim": orthotropic(205.0, 10.2, 1014.0, 53.4),
    "camel-ponte-roma": orthotropic(31.1, -12.8, 44.0, 31.9),
    "ivory-rib-knit": orthotropic(42.9, -0.2, 65.2, 83.2),
    "pink-ribbon-brown": orthotropic(152.0, 106.0, 245.0, 30.3),
    "royal-target": orthotropic(2017.0, 9.2, 2035.0, 105.0),
    "white-dots-on-blk": orthotropic(2002.0, 0.3, 2027.0, 19.2),
    "white-swim-solid": orthotropic(48.0, 6.8, 104.6, 60.8),
    "tango-red-jet-set": orthotropic(43.1, 54.4, 171.0, 14.3),
}

# [1e-6 N m] along 0, 45 and 90 degrees
BENDING = {
    "gray-interlock": (23.2, 24.7, 14.3),
    "11oz-black-denim": (64.2, 73.4, 97.0),
    "camel-ponte-roma": (36.3, 33.0, 37.2),
    "ivory-rib-knit": (46.2, 30.0, 32.2),
    "pink-ribbon-brown": (117.0, 87.5, 59.8),
    "royal-target": (125.0, 108.0, 125.0),
    "white-dots-on-blk": (51.7, 40.7, 31.3),
    "navy-sparkle-sweat": (59.5, 40.1, 45.6),
    "white-swim-solid": (60.2, 58.8, 51.0),
    "tango-red-jet-set": (14.3, 22.0, 20.3),
}

# Of the cantilever tests [1e-6 N m], 5 and 95 %, the softer weft and the stiffer warp.
CANTILEVER = (1.0, 106.0)
SOURCES = "Wang et al. 2011, in bending also Feng et al. 2022"

# What instruments print: 1 gf cm^2/cm of Kawabata's bending tester, in N m; and g, for the
# cantilever's bending length.
KAWABATA = 9.80665e-5
GRAVITY = 9.80665


def band():
    """Softest and stiffest fabric [N m]: in any direction, since nobody knows how a cell of ours
    would lie in theirs.
    """
    values = 1e-6 * numpy.array(list(BENDING.values()))
    return float(values.min()), float(values.max())


def bending_length(stiffness, areal_density):
    """Of Peirce's cantilever test, (B / (rho g))^(1/3) [m], of a strip of stiffness B [N m] and
    areal density rho [kg/m^2].
    """
    return (stiffness / (areal_density * GRAVITY)) ** (1.0 / 3.0)


def bending_band():
    """Softest and stiffest cloth of both sources [N m]."""
    softest, stiffest = band()
    return min(softest, 1e-6 * CANTILEVER[0]), max(stiffest, 1e-6 * CANTILEVER[1])


def stretch_band():
    """Smallest and largest stiffness along an axis [N/m]."""
    values = [C[k, k] for C in STRETCH.values() for k in (0, 1)]
    return float(min(values)), float(max(values))


def shear_band():
    """Smallest and largest C66 [N/m]."""
    values = [C[2, 2] for C in STRETCH.values()]
    return float(min(values)), float(max(values))


def bias_band():
    """Smallest and largest bending stiffness at 45 degrees over that along an axis."""
    ratios = [bias / along for one, bias, other in BENDING.values() for along in (one, other)]
    return min(ratios), max(ratios)
