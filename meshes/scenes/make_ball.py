#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""ball.obj: a closed sphere of triangles, an obstacle for cloth.

usage: make_ball.py [--radius 0.05] [--times 3] > ball.obj

An icosahedron, each triangle cut into four `times` times, vertices moved onto the sphere; outside counter-clockwise.
"""
import argparse
import itertools

import numpy as np


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--radius", type=float, default=0.05, help="[m]")
    parser.add_argument("--times", type=int, default=3, help="refinements of the icosahedron")
    args = parser.parse_args()

    golden = (1.0 + 5.0**0.5) / 2.0
    corners = [np.roll([0.0, i, j * golden], shift)
               for shift in range(3) for i in (-1.0, 1.0) for j in (-1.0, 1.0)]
    vertices = [corner / np.linalg.norm(corner) for corner in corners]
    triangles = []
    for t in itertools.combinations(range(12), 3):
        a, b, c = (vertices[k] for k in t)
        if max(np.linalg.norm(a - b), np.linalg.norm(b - c), np.linalg.norm(c - a)) < 1.1:
            triangles.append(t if np.dot(np.cross(b - a, c - a), a) > 0.0 else (t[0], t[2], t[1]))
    for _ in range(args.times):
        middle = {}

        def between(i, j):
            key = (min(i, j), max(i, j))
            if key not in middle:
                point = vertices[i] + vertices[j]
                middle[key] = len(vertices)
                vertices.append(point / np.linalg.norm(point))
            return middle[key]

        finer = []
        for a, b, c in triangles:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer

    print(f"# A ball of radius {args.radius} m around the origin: make_ball.py --radius {args.radius} --times {args.times}")
    for vertex in vertices:
        print("v {:.12f} {:.12f} {:.12f}".format(*(args.radius * vertex)))
    for t in triangles:
        print("f", *(k + 1 for k in t))


if __name__ == "__main__":
    main()
