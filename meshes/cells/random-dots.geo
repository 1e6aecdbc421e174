// SPDX-License-Identifier: MIT
// random-dots: round dots of several sizes at random places, as scattered hot-melt powder makes them on
// interlinings. Dots are dropped one after the other (random sequential adsorption, on the torus): one
// that comes too near to another is dropped anew. The seed decides; the same seed gives the same cell.
// Dots that cross a side come back on the other. No symmetry: C16 and C26 are not zero.
//
//     +-----------+
//     |) o   O   (|
//     |   O    o  |
//     |o     O    |
//     |) O  o    (|
//     +-----------+
//
// gmsh -2 -format msh41 random-dots.geo -o random-dots.msh

DefineConstant[
  seed   = { 1, Min 1, Max 1000000, Step 1, Name "Parameters/seed of the random numbers" }
  dots   = { 12, Min 1, Max 60, Step 1, Name "Parameters/number of dots" }
  radius = { 0.085, Min 0.03, Max 0.15, Name "Parameters/mean radius of a dot, cell = 1; 0.7 to 1.3 of it occur" }
  h      = { 0.0375, Min 0.005, Max 0.06, Name "Parameters/mesh size; 1952 triangles as shipped" }
];

SetFactory("OpenCASCADE");
Mesh.Algorithm = 6;      // Frontal-Delaunay: near-equilateral triangles
Mesh.ElementOrder = 2;   // six nodes: the sides of arcs are curved, and brackets those of the drawing
Mesh.Smoothing = 5;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;

// Between two dots, and between an edge of a dot and a side that it nearly touches, stay this much.
margin = 0.75 * h;

// ---- the dots: centres x, y and radii r ----
// Lehmer's generator (Park and Miller 1988): whole numbers below 2^31, their products below 2^53.
state = seed;
For k In {1 : 20} // neighbouring seeds begin alike
  state = Fmod(16807 * state, 2147483647);
EndFor
x[] = {};
y[] = {};
r[] = {};
For attempt In {1 : 200 * dots}
  If (#x[] < dots)
    state = Fmod(16807 * state, 2147483647);
    a     = state / 2147483647;
    state = Fmod(16807 * state, 2147483647);
    b     = state / 2147483647;
    // The sizes go from large to small: small ones still find a place.
    s = dots > 1 ? radius * (1.3 - 0.6 * #x[] / (dots - 1)) : radius;
    // Distances to the nearest side of either kind, and to the nearest corner.
    da   = Min(a, 1 - a);
    db   = Min(b, 1 - b);
    dc   = Sqrt(da * da + db * db);
    fits = Fabs(da - s) > margin && Fabs(db - s) > margin && Fabs(dc - s) > margin ? 1 : 0;
    // A circle begins with a vertex beside its centre, at the same height.
    If (db < margin)
      fits = 0;
    EndIf
    For k In {0 : #x[] - 1}
      da = Fabs(a - x[k]);
      da = Min(da, 1 - da);
      db = Fabs(b - y[k]);
      db = Min(db, 1 - db);
      If (Sqrt(da * da + db * db) < s + r[k] + margin)
        fits = 0;
      EndIf
    EndFor
    If (fits == 1)
      x[] += {a};
      y[] += {b};
      r[] += {s};
    EndIf
  EndIf
EndFor
If (#x[] < dots)
  Error("random-dots: only %g of %g dots found a place: take fewer or smaller ones, or a smaller h", #x[], dots);
EndIf

// ---- the dots and their images, as far as they lie in the cell ----
Rectangle(1) = {0, 0, 0, 1, 1};
next     = 10;
pieces[] = {};
For k In {0 : #x[] - 1}
  For i In {-1 : 1}
    For j In {-1 : 1}
      a  = x[k] + i;
      b  = y[k] + j;
      da = Max(0, Max(-a, a - 1));
      db = Max(0, Max(-b, b - 1));
      If (Sqrt(da * da + db * db) < r[k])
        Disk(next) = {a, b, 0, r[k]};
        If (a - r[k] < 0 || a + r[k] > 1 || b - r[k] < 0 || b + r[k] > 1)
          BooleanIntersection(next + 1) = { Surface{next}; Delete; }{ Surface{1}; };
          pieces[] += {next + 1};
        Else
          pieces[] += {next};
        EndIf
        next += 2;
      EndIf
    EndFor
  EndFor
EndFor
ground[] = BooleanDifference{ Surface{1}; Delete; }{ Surface{pieces[]}; };
// Nothing overlaps any more: this joins the edges and keeps the numbers of the surfaces.
BooleanFragments{ Surface{ground[]}; Surface{pieces[]}; Delete; }{}

// Every piece of the left and lower side has its partner on the other one.
e = 1e-4;
For side In {0 : 1}
  i = 1 - side;
  pieces_of_side[] = Curve In BoundingBox{-e, -e, -e, side + e, i + e, e};
  For k In {0 : #pieces_of_side[] - 1}
    c   = pieces_of_side[k];
    o[] = BoundingBox Curve{c};
    partner[] = Curve In BoundingBox{o[0] + i - e, o[1] + side - e, -e, o[3] + i + e, o[4] + side + e, e};
    Periodic Curve{partner[0]} = {c} Translate{i, side, 0};
  EndFor
EndFor

// Materials: the names are the keys of the .prm file. No physical curves: sides are found by matching.
Physical Surface("ground", 1) = {ground[]};
Physical Surface("dot", 2) = {pieces[]};
