// SPDX-License-Identifier: MIT
// layered: soft and hard stripes stacked along y (axis 2), the cell of the paper's Figures 4 and 6.
//
//   1 +-----------+
//     |   hard    |
//  s  +-----------+   s: share of the soft stripe
//     |   soft    |
//   0 +-----------+
//     0           1
//
// Structured: n1 x n2 rectangles, each cut into two triangles, with the interface on a row of
// vertices. Extrusion puts opposite sides on the same vertices, shifted by a lattice vector, exact to
// round-off (a transfinite mesh of Gmsh is exact to 1e-12 only).
// gmsh -2 -format msh41 layered.geo -o layered.msh

DefineConstant[
  share = { 0.5, Min 0.05, Max 0.95, Name "Parameters/share of the soft stripe" }
  n1    = { 18, Min 1, Max 1000, Step 1, Name "Parameters/rectangles along axis 1" }
  n2    = { 20, Min 2, Max 1000, Step 1, Name "Parameters/rectangles along axis 2" }
];

// Rows of the soft stripe: at least one row is left for each stripe.
soft_rows = Floor(share * n2 + 0.5);
If (soft_rows < 1)
  soft_rows = 1;
EndIf
If (soft_rows > n2 - 1)
  soft_rows = n2 - 1;
EndIf

Point(1) = {0, 0, 0};
bottom[] = Extrude {1, 0, 0} { Point{1}; Layers{n1}; };
soft[]   = Extrude {0, share, 0} { Curve{bottom[1]}; Layers{soft_rows}; };
hard[]   = Extrude {0, 1 - share, 0} { Curve{soft[0]}; Layers{n2 - soft_rows}; };

// Materials: the names are the keys of the .prm file. No physical curves: sides are found by matching.
Physical Surface("soft", 1) = {soft[1]};
Physical Surface("hard", 2) = {hard[1]};
