// SPDX-License-Identifier: MIT
// chevron: zigzag bands, printed on a stretch ground: the herringbone of taped and printed sportswear.
//
//   1 +-----------+
//     |  ground   |
//     |    .^.    |
//     |  .^ b ^.  |     b: the band, of one width along axis 2; it climbs by `climb` to the middle
//     |.^ .^ ^. ^.|        and falls again
//     |.^  gr.  ^.|
//   0 +-----------+
//     0           1
//
// The band stays off the lower and upper side, and crosses the other two at one height. One mirror:
// C16 = C26 = 0.
// gmsh -2 -format msh41 chevron.geo -o chevron.msh

DefineConstant[
  climb = { 0.4, Min 0.1, Max 0.45, Name "Parameters/height of the zigzag, cell = 1" }
  band  = { 0.4, Min 0.15, Max 0.45, Name "Parameters/width of the band along axis 2" }
  h     = { 0.0505, Min 0.005, Max 0.06, Name "Parameters/mesh size; 974 triangles as shipped" }
];

Mesh.Algorithm = 6;      // Frontal-Delaunay: near-equilateral triangles
Mesh.Smoothing = 5;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.MeshSizeExtendFromBoundary = 0;

// Sides made by extrusion have vertices exact to round-off, and opposite sides the same ones.
below  = (1 - climb - band) / 2; // where the band begins on the left and right side
above  = 1 - below - band;
n_long = Ceil(1 / h);
Point(1) = {0, 0, 0};
bottom[]  = Extrude {1, 0, 0} { Point{1}; Layers{n_long}; };
left_l[]  = Extrude {0, below, 0} { Point{1}; Layers{Ceil(below / h)}; };
right_l[] = Extrude {0, below, 0} { Point{bottom[0]}; Layers{Ceil(below / h)}; };
left_b[]  = Extrude {0, band, 0} { Point{left_l[0]}; Layers{Ceil(band / h)}; };
right_b[] = Extrude {0, band, 0} { Point{right_l[0]}; Layers{Ceil(band / h)}; };
left_u[]  = Extrude {0, above, 0} { Point{left_b[0]}; Layers{Ceil(above / h)}; };
right_u[] = Extrude {0, above, 0} { Point{right_b[0]}; Layers{Ceil(above / h)}; };
top[]     = Extrude {1, 0, 0} { Point{left_u[0]}; Layers{n_long}; };

// The zigzags below and above the band.
Point(101) = {0.5, below + climb, 0};
Point(102) = {0.5, below + climb + band, 0};
Line(101) = {left_l[0], 101};
Line(102) = {101, right_l[0]};
Line(103) = {left_b[0], 102};
Line(104) = {102, right_b[0]};

Curve Loop(1) = {bottom[1], right_l[1], -102, -101, -left_l[1]};
Curve Loop(2) = {101, 102, right_b[1], -104, -103, -left_b[1]};
Curve Loop(3) = {103, 104, right_u[1], -top[1], -left_u[1]};
For k In {1 : 3}
  Plane Surface(k) = {k};
EndFor

// Materials: the names are the keys of the .prm file. No physical curves: sides are found by matching.
Physical Surface("ground", 1) = {1, 3};
Physical Surface("band", 2) = {2};
