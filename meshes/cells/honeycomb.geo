// SPDX-License-Identifier: MIT
// honeycomb: a sheet with hexagonal holes, walls of one width between them. The cell is a rhombus with
// lattice vectors (1, 0) and (1/2, sqrt(3)/2), the hole in its middle:
//
//         +-----------------+
//        /       / \       /
//       /       |   |     /     walls upright and at 30 degrees to axis 1
//      /         \ /     /
//     +-----------------+
//
// Straight sides that do not cut the holes ask for stout walls: 0.34 of the distance of holes, at least.
// Six-fold symmetry makes C^H isotropic in the plane: C11 = C22, C66 = (C11 - C12) / 2, C16 = C26 = 0.
// gmsh -2 -format msh41 honeycomb.geo -o honeycomb.msh

DefineConstant[
  wall = { 0.36, Min 0.34, Max 0.8, Name "Parameters/width of a wall, distance of holes = 1" }
  h    = { 0.035, Min 0.005, Max 0.06, Name "Parameters/mesh size; 1018 triangles as shipped" }
];

Mesh.Algorithm = 6;      // Frontal-Delaunay: near-equilateral triangles
Mesh.Smoothing = 5;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.MeshSizeExtendFromBoundary = 0;

// Sides made by extrusion have vertices exact to round-off, and opposite sides the same ones.
height = Sqrt(3) / 2;
n_side = Ceil(1 / h);
Point(1) = {0, 0, 0};
bottom[] = Extrude {1, 0, 0} { Point{1}; Layers{n_side}; };
left[]   = Extrude {0.5, height, 0} { Point{1}; Layers{n_side}; };
right[]  = Extrude {0.5, height, 0} { Point{bottom[0]}; Layers{n_side}; };
top[]    = Extrude {1, 0, 0} { Point{left[0]}; Layers{n_side}; };
Curve Loop(1) = {bottom[1], right[1], -top[1], -left[1]};

// The hole: a regular hexagon with upright edges, its corners at this distance from the middle.
corner = (1 - wall) / Sqrt(3);
For k In {0 : 5}
  Point(101 + k) = {0.75 + corner * Cos(Pi / 6 + k * Pi / 3),
                    height / 2 + corner * Sin(Pi / 6 + k * Pi / 3), 0};
EndFor
For k In {0 : 5}
  Line(101 + k) = {101 + k, 101 + (k + 1) % 6};
EndFor
Curve Loop(2) = {101 : 106};

Plane Surface(1) = {1, 2}; // the hole itself is not meshed

// Materials: the names are the keys of the .prm file. No physical curves: sides are found by matching.
Physical Surface("wall", 1) = {1};
