// SPDX-License-Identifier: MIT
// auxetic: a re-entrant honeycomb of stiff ribs on a stretch ground. Its cells are bow ties: upright
// ribs, and slanted ribs that lean into the cell. Pulled along either axis the slanted ribs open and the
// cloth becomes wider: Poisson's ratio is negative, C12 < 0.
//
//     |    .  |  .    |
//     |  /    |    \  |     ribs, of one width; bow ties of two
//      /      |      \      neighbouring columns are shifted by half
//      \     / \     /      a row, so that they interlock
//     |  \ /     \ /  |
//     |   |       |   |
//
// Bow ties that interlock cannot be holes inside a straight outline; the ground fills them. Two mirrors:
// C16 = C26 = 0.
// gmsh -2 -format msh41 auxetic.geo -o auxetic.msh

DefineConstant[
  angle   = { 30, Min 10, Max 40, Name "Parameters/angle by which the slanted ribs lean inwards [deg]" }
  upright = { 2, Min 1.8, Max 3, Name "Parameters/length of an upright rib, slanted rib = 1" }
  rib     = { 0.2, Min 0.05, Max 0.25, Name "Parameters/width of a rib" }
  h       = { 0.068, Min 0.01, Max 0.2, Name "Parameters/mesh size of the ribs; 2784 triangles as shipped" }
];

Mesh.Algorithm = 6;      // Frontal-Delaunay: near-equilateral triangles
Mesh.Smoothing = 5;
Mesh.MeshSizeExtendFromBoundary = 1;
h_rib = h;
h_mid = 1.4 * h;

// Rectangle of two bow ties: one whole in the middle, quarters of another in the corners. Lengths are
// those of the ribs' middle lines.
lean  = angle * Pi / 180;
width = 2 * Cos(lean);
rise  = upright - Sin(lean);      // distance of two rows of bow ties; the cell holds two
d     = rib / 2 / Cos(lean);      // half a slanted rib, measured upright
// Heights above the middle of a bow tie: its dent, and the inner corner beside an upright rib.
dent  = upright / 2 - Sin(lean) - d;
peak  = upright / 2 - Tan(lean) * rib / 2 - d;

// Points 1 to 16: the outline and the four quarters, from the lower left corner on.
Point(1)  = {0, 0, 0, h_mid};
Point(2)  = {width / 2 - rib / 2, 0, 0, h_rib};
Point(3)  = {width / 2 + rib / 2, 0, 0, h_rib};
Point(4)  = {width, 0, 0, h_mid};
Point(5)  = {width, dent, 0, h_rib};
Point(6)  = {width, 2 * rise - dent, 0, h_rib};
Point(7)  = {width, 2 * rise, 0, h_mid};
Point(8)  = {width / 2 + rib / 2, 2 * rise, 0, h_rib};
Point(9)  = {width / 2 - rib / 2, 2 * rise, 0, h_rib};
Point(10) = {0, 2 * rise, 0, h_mid};
Point(11) = {0, 2 * rise - dent, 0, h_rib};
Point(12) = {0, dent, 0, h_rib};
Point(13) = {width / 2 - rib / 2, peak, 0, h_rib};
Point(14) = {width / 2 + rib / 2, peak, 0, h_rib};
Point(15) = {width / 2 + rib / 2, 2 * rise - peak, 0, h_rib};
Point(16) = {width / 2 - rib / 2, 2 * rise - peak, 0, h_rib};
// Points 17 to 22: the bow tie in the middle.
Point(17) = {rib / 2, rise - peak, 0, h_rib};
Point(18) = {width / 2, rise - dent, 0, h_rib};
Point(19) = {width - rib / 2, rise - peak, 0, h_rib};
Point(20) = {width - rib / 2, rise + peak, 0, h_rib};
Point(21) = {width / 2, rise + dent, 0, h_rib};
Point(22) = {rib / 2, rise + peak, 0, h_rib};

For k In {1 : 12}
  Line(k) = {k, k % 12 + 1};
EndFor
Line(13) = {2, 13};  Line(14) = {13, 12};
Line(15) = {3, 14};  Line(16) = {14, 5};
Line(17) = {8, 15};  Line(18) = {15, 6};
Line(19) = {9, 16};  Line(20) = {16, 11};
For k In {21 : 26}
  Line(k) = {k - 4, (k - 20) % 6 + 17};
EndFor

// Opposite sides have the same vertices.
Periodic Curve{4, 5, 6} = {-12, -11, -10} Translate{width, 0, 0};
Periodic Curve{9, 8, 7} = {-1, -2, -3} Translate{0, 2 * rise, 0};

Curve Loop(1) = {1, 13, 14, 12};
Curve Loop(2) = {3, 4, -16, -15};
Curve Loop(3) = {6, 7, 17, 18};
Curve Loop(4) = {9, 10, -20, -19};
Curve Loop(5) = {21 : 26};
Curve Loop(6) = {2, 15, 16, 5, -18, -17, 8, 19, 20, 11, -14, -13};
For k In {1 : 5}
  Plane Surface(k) = {k};
EndFor
Plane Surface(6) = {6, 5};

// Materials: the names are the keys of the .prm file. No physical curves: sides are found by matching.
Physical Surface("ground", 1) = {1 : 5};
Physical Surface("rib", 2) = {6};
