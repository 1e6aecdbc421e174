// SPDX-License-Identifier: MIT
// printed-patch: the badge of a team shirt, repeated: a disc of transfer film with a thicker rim and a
// raised star, on a plain knit that stretches more along axis 1 (courses) than along axis 2 (wales).
//
//   1 +-------------+
//     |   .-----.   |
//     | / .  ^  . \ |     rim (between the two circles), film (inside), star (raised print),
//     ||  <star>   ||     knit (around)
//     | \ '  v  ' / |
//     |   '-----'   |
//   0 +-------------+
//     0             1
//
// One mirror, axis 2: C16 = C26 = 0.
// gmsh -2 -format msh41 printed-patch.geo -o printed-patch.msh

DefineConstant[
  radius = { 0.38, Min 0.3, Max 0.45, Name "Parameters/outer radius of the badge, cell = 1" }
  rim    = { 0.06, Min 0.03, Max 0.08, Name "Parameters/width of the rim" }
  star   = { 0.75, Min 0.4, Max 0.85, Name "Parameters/radius of the star's points, inside of the rim = 1" }
  h      = { 0.034, Min 0.005, Max 0.05, Name "Parameters/mesh size; 2150 triangles as shipped" }
];

Mesh.Algorithm = 6;      // Frontal-Delaunay: near-equilateral triangles
Mesh.ElementOrder = 2;   // six nodes: the sides of arcs are curved, and brackets those of the drawing
Mesh.Smoothing = 5;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.MeshSizeExtendFromBoundary = 0;

// Sides made by extrusion have vertices exact to round-off, and opposite sides the same ones.
n_side = Ceil(1 / h);
Point(1) = {0, 0, 0};
bottom[] = Extrude {1, 0, 0} { Point{1}; Layers{n_side}; };
left[]   = Extrude {0, 1, 0} { Point{1}; Layers{n_side}; };
right[]  = Extrude {0, 1, 0} { Point{bottom[0]}; Layers{n_side}; };
top[]    = Extrude {1, 0, 0} { Point{left[0]}; Layers{n_side}; };
Curve Loop(1) = {bottom[1], right[1], -top[1], -left[1]};

// ---- the badge: outer edge, inner edge of the rim ----
Point(100) = {0.5, 0.5, 0};
For edge In {0 : 1}
  p = 110 + 10 * edge;
  q = radius - edge * rim;
  For k In {0 : 3}
    Point(p + k) = {0.5 + q * Cos(k * Pi / 2), 0.5 + q * Sin(k * Pi / 2), 0};
  EndFor
  For k In {0 : 3}
    Circle(p + k) = {p + k, 100, p + (k + 1) % 4};
  EndFor
  Curve Loop(2 + edge) = {p : p + 3};
EndFor

// ---- the star: five points, one of them up ----
// Inner corners at 0.45 of the radius: points of 45 degrees, where a pentagram's 36 would make slivers.
tip = star * (radius - rim);
For k In {0 : 9}
  q = k % 2 == 0 ? tip : 0.45 * tip;
  Point(200 + k) = {0.5 + q * Cos(Pi / 2 + k * Pi / 5), 0.5 + q * Sin(Pi / 2 + k * Pi / 5), 0};
EndFor
For k In {0 : 9}
  Line(200 + k) = {200 + k, 200 + (k + 1) % 10};
EndFor
Curve Loop(4) = {200 : 209};

Plane Surface(1) = {1, 2}; // knit
Plane Surface(2) = {2, 3}; // rim
Plane Surface(3) = {3, 4}; // film
Plane Surface(4) = {4};    // star

// Materials: the names are the keys of the .prm file. No physical curves: sides are found by matching.
Physical Surface("knit", 1) = {1};
Physical Surface("film", 2) = {3};
Physical Surface("rim", 3) = {2};
Physical Surface("star", 4) = {4};
