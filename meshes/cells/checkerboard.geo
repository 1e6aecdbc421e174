// SPDX-License-Identifier: MIT
// checkerboard: two times two squares of two materials, a patchwork. Four squares meet in each corner,
// where stresses are singular: a hard cell for brackets, and one with an exact result. Where both
// materials have the same E / (1 - nu), Young's modulus of the board along the axes times that along
// the diagonals is E_soft E_hard (duality of plane elasticity; Berdichevskii 1985 for the incompressible
// case, shifted by the theorem of Cherkaev, Lurie and Milton 1992).
//
//   1 +-----+-----+
//     |hard |soft |
//     +-----+-----+
//     |soft |hard |
//   0 +-----+-----+
//     0    split  1
//
// Structured, with diagonals that alternate: the mirrors of the board are mirrors of the mesh. Squares
// (split = 0.5): C11 = C22. For any split C16 = C26 = 0.
// gmsh -2 -format msh41 checkerboard.geo -o checkerboard.msh

DefineConstant[
  split = { 0.5, Min 0.2, Max 0.8, Name "Parameters/side of the first square, cell = 1" }
  n     = { 20, Min 8, Max 400, Step 1, Name "Parameters/rectangles along a side; 2 n^2 triangles" }
];

// Rectangles along both parts of a side: even numbers, for the mirrors.
first  = Max(2, 2 * Floor(split * n / 2 + 0.5));
second = Max(2, 2 * Floor((1 - split) * n / 2 + 0.5));
at[]   = {0, split, 1};
cuts[] = {first, second};

For l In {0 : 2}
  For k In {0 : 2}
    Point(1 + k + 3 * l) = {at[k], at[l], 0};
  EndFor
EndFor
// Lines along axis 1 have numbers from 1, along axis 2 from 11.
For l In {0 : 2}
  For k In {0 : 1}
    Line(1 + k + 2 * l)  = {1 + k + 3 * l, 2 + k + 3 * l};
    Line(11 + k + 2 * l) = {1 + 3 * k + l, 4 + 3 * k + l};
    Transfinite Curve{1 + k + 2 * l, 11 + k + 2 * l} = cuts[k] + 1;
  EndFor
EndFor
For l In {0 : 1}
  For k In {0 : 1}
    s = 1 + k + 2 * l;
    Curve Loop(s)    = {1 + k + 2 * l, 11 + l + 2 * (k + 1), -(1 + k + 2 * (l + 1)), -(11 + l + 2 * k)};
    Plane Surface(s) = {s};
    Transfinite Surface{s} Alternate;
  EndFor
EndFor

// Materials: the names are the keys of the .prm file. No physical curves: sides are found by matching.
Physical Surface("soft", 1) = {1, 4};
Physical Surface("hard", 2) = {2, 3};
