// SPDX-License-Identifier: MIT
// three-stiffness: a striped paisley. A boteh (the paisley drop, Persian shawls since the 16th
// century) printed on a soft ground and outlined with a stitched cord; a straight cord of the same
// kind runs along axis 1 below it. Three stiffnesses, curved and straight parts, no symmetry: C^H has
// C16 and C26 that are not zero. The finer geometry of the paper's Figure 1 (d), in our own pattern.
//
// The drop is three arcs of circles with centres at one height, tangent to each other where they
// meet (head to back at the left, head to hollow at the right); back and hollow cross in the tip:
//
//     back, radius R     . - - .
//                     .  motif   .
//                    .     .  - .  . tip
//                    |   .  hollow, radius Q (centre to the right)
//                    (   )
//                     ` ´  head, radius r
//   ==================================== straight cord
//
// The inner edge of the outline has the same centres: the outline has one width all around.
// gmsh -2 -format msh41 three-stiffness.geo -o three-stiffness.msh

DefineConstant[
  band   = { 0.10, Min 0.02, Max 0.2, Name "Parameters/width of the straight cord" }
  w      = { 0.055, Min 0.01, Max 0.1, Name "Parameters/width of the outline" }
  r      = { 0.215, Min 0.15, Max 0.25, Name "Parameters/radius of the head" }
  R      = { 0.475, Min 0.4, Max 0.5, Name "Parameters/radius of the back" }
  Q      = { 0.40, Min 0.35, Max 0.5, Name "Parameters/radius of the hollow" }
  head_x = { 0.325, Min 0.3, Max 0.4, Name "Parameters/centre of the head, axis 1" }
  head_y = { 0.405, Min 0.35, Max 0.45, Name "Parameters/centre of the head, axis 2" }
  h      = { 0.0602, Min 0.005, Max 0.2, Name "Parameters/mesh size; 720 triangles as shipped" }
];

Mesh.Algorithm = 6;      // Frontal-Delaunay: near-equilateral triangles
Mesh.ElementOrder = 2;   // six nodes: the sides of arcs are curved, and brackets those of the drawing
Mesh.Smoothing = 5;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.MeshSizeExtendFromBoundary = 0;

// ---- the frame: the cell's sides, split where the straight cord ends ----
// Sides made by extrusion have vertices exact to round-off, and opposite sides the same ones.
n_long  = Ceil(1 / h);
n_cord  = Ceil(band / h);
n_above = Ceil((1 - band) / h);
Point(1) = {0, 0, 0};
bottom[]  = Extrude {1, 0, 0} { Point{1}; Layers{n_long}; };
left_c[]  = Extrude {0, band, 0} { Point{1}; Layers{n_cord}; };
right_c[] = Extrude {0, band, 0} { Point{bottom[0]}; Layers{n_cord}; };
left_g[]  = Extrude {0, 1 - band, 0} { Point{left_c[0]}; Layers{n_above}; };
right_g[] = Extrude {0, 1 - band, 0} { Point{right_c[0]}; Layers{n_above}; };
top[]     = Extrude {1, 0, 0} { Point{left_g[0]}; Layers{n_long}; };
upper[]   = Extrude {1, 0, 0} { Point{left_c[0]}; Layers{n_long}; }; // upper edge of the cord

// ---- the drop: outer edge (offset 0) and inner edge (offset w) of the outline ----
back_x   = head_x + R - r; // centre of the back
hollow_x = head_x + r + Q; // centre of the hollow
gap      = hollow_x - back_x;
Point(110) = {head_x, head_y, 0};
Point(111) = {back_x, head_y, 0};
Point(112) = {hollow_x, head_y, 0};

For edge In {0 : 1}
  o = edge * w;
  p = 120 + 10 * edge;
  // The tip: where the circles of back (R - o) and hollow (Q + o) cross, upper crossing.
  a = (gap * gap + (R - o) * (R - o) - (Q + o) * (Q + o)) / (2 * gap);
  Point(p)     = {head_x - r + o, head_y, 0}; // left: head meets back
  Point(p + 1) = {head_x, head_y - r + o, 0}; // foot of the head
  Point(p + 2) = {head_x + r - o, head_y, 0}; // right: head meets hollow
  Point(p + 3) = {back_x + a, head_y + Sqrt((R - o) * (R - o) - a * a), 0}; // tip
  Circle(p)     = {p, 110, p + 1};
  Circle(p + 1) = {p + 1, 110, p + 2};
  Circle(p + 2) = {p + 2, 112, p + 3};
  Circle(p + 3) = {p + 3, 111, p};
  Curve Loop(p) = {p, p + 1, p + 2, p + 3};
EndFor

Curve Loop(1) = {bottom[1], right_c[1], -upper[1], -left_c[1]};
Curve Loop(2) = {upper[1], right_g[1], -top[1], -left_g[1]};
Plane Surface(1) = {1};      // straight cord
Plane Surface(2) = {2, 120};  // ground
Plane Surface(3) = {120, 130}; // outline
Plane Surface(4) = {130};     // motif

// Materials: the names are the keys of the .prm file. No physical curves: sides are found by matching.
Physical Surface("ground", 1) = {2};
Physical Surface("motif", 2) = {4};
Physical Surface("cord", 3) = {1, 3};
