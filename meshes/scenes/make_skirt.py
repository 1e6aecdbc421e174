#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""skirt.obj: a flared skirt of gores, each flat at rest, sewn into a cone.

usage: make_skirt.py [--gores 4] [--columns 10] [--rows 10] > skirt.obj

A cone that is cut along a generator unrolls into a sector of a circle: a ring at the radius r of the cone lies at
the distance r / s from the apex, and the angle phi around the axis becomes s phi, with s = (hem - waist) / length
the sine of the half opening angle. Every gore is one piece of that sector, with its own place in the plane (vt, in
metres, u to the right and v up when the gore hangs). Along the seams two gores share their vertices in space
(v, in metres, z up, axis through the origin, hem at z = 0); the last seam closes the ring.

In space the coarse skirt is a polyhedron. Its corners lie a little outside the round cone (the factor is
sin(s h) / (s sin h), h half the angle of a column; 0.08 % for 40 columns), which makes every trapezoid between two
rings and two generators congruent to its flat one: the skirt begins without any strain, to the digits of the file.
"""
import argparse

import numpy as np


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--gores", type=int, default=4, help="panels around the skirt")
    parser.add_argument("--columns", type=int, default=10, help="columns of quadrilaterals in a gore")
    parser.add_argument("--rows", type=int, default=10, help="rows of quadrilaterals from hem to waist")
    parser.add_argument("--waist", type=float, default=0.06, help="radius [m]")
    parser.add_argument("--hem", type=float, default=0.12, help="radius [m]")
    parser.add_argument("--length", type=float, default=0.14, help="along a generator [m]")
    args = parser.parse_args()
    if args.gores < 2 or args.columns < 1 or args.rows < 1 or args.gores * args.columns < 3:
        parser.error("expected two gores or more, three columns or more around the skirt, and one row or more")
    if not 0.0 < args.waist < args.hem < args.waist + args.length:
        parser.error("expected 0 < waist < hem < waist + length")

    n_around = args.gores * args.columns
    sine = (args.hem - args.waist) / args.length
    distance = np.linspace(args.hem, args.waist, args.rows + 1) / sine  # from the apex, hem first
    half = np.pi / n_around
    radius = distance * np.sin(sine * half) / np.sin(half)
    # The generators are edges, as long in space as at rest: distance^2 = radius^2 + height^2.
    height = np.sqrt(distance**2 - radius**2)

    print(f"# A skirt of {args.gores} gores: waist {args.waist} m, hem {args.hem} m in radius, {args.length} m long.")
    print(f"# make_skirt.py --gores {args.gores} --columns {args.columns} --rows {args.rows}")
    print("# v: in space [m], z up; vt: the gores at rest [m]")
    for ring in range(args.rows + 1):
        for k in range(n_around):
            phi = 2.0 * half * k
            print(f"v {radius[ring] * np.cos(phi):.12f} {radius[ring] * np.sin(phi):.12f} "
                  f"{height[0] - height[ring]:.12f}")
    opening = 2.0 * half * args.columns * sine
    spacing = 2.0 * distance[0] * np.sin(min(opening, np.pi) / 2.0) + 0.01
    for gore in range(args.gores):
        for ring in range(args.rows + 1):
            for k in range(args.columns + 1):
                angle = opening * (k / args.columns - 0.5)
                print(f"vt {gore * spacing + distance[ring] * np.sin(angle):.12f} "
                      f"{distance[0] - distance[ring] * np.cos(angle):.12f}")
    for gore in range(args.gores):
        print(f"g gore-{gore}")
        for ring in range(args.rows):
            for k in range(args.columns):
                def corner(i, j):
                    v = (ring + j) * n_around + (gore * args.columns + k + i) % n_around
                    vt = (gore * (args.rows + 1) + ring + j) * (args.columns + 1) + k + i
                    return f"{v + 1}/{vt + 1}"
                a, b, c, d = corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)
                # Diagonals alternate, so that the mesh prefers no direction.
                quad = [(a, b, c), (a, c, d)] if (ring + k) % 2 == 0 else [(a, b, d), (b, c, d)]
                for triangle in quad:
                    print("f", *triangle)


if __name__ == "__main__":
    main()
