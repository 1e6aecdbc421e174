// SPDX-License-Identifier: MIT
// hexagonal-dots: round dots on a hexagonal lattice, as hot melt is printed on fusible interlinings. The
// cell is a rhombus with lattice vectors (1, 0) and (1/2, sqrt(3)/2), one dot in its middle:
//
//         +-----------------+
//        /       .-.       /
//       /       (dot)     /     ground around it
//      /         '-'     /
//     +-----------------+
//
// Six-fold symmetry makes C^H isotropic in the plane: C11 = C22, C66 = (C11 - C12) / 2, C16 = C26 = 0.
// gmsh -2 -format msh41 hexagonal-dots.geo -o hexagonal-dots.msh

DefineConstant[
  radius = { 0.28, Min 0.1, Max 0.37, Name "Parameters/radius of a dot, distance of dots = 1" }
  h      = { 0.0455, Min 0.005, Max 0.06, Name "Parameters/mesh size; 1046 triangles as shipped" }
];

Mesh.Algorithm = 6;      // Frontal-Delaunay: near-equilateral triangles
Mesh.ElementOrder = 2;   // six nodes: the sides of arcs are curved, and brackets those of the drawing
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

// The dot: six arcs around the middle of the rhombus.
Point(100) = {0.75, height / 2, 0};
For k In {0 : 5}
  Point(101 + k) = {0.75 + radius * Cos(k * Pi / 3), height / 2 + radius * Sin(k * Pi / 3), 0};
EndFor
For k In {0 : 5}
  Circle(101 + k) = {101 + k, 100, 101 + (k + 1) % 6};
EndFor
Curve Loop(2) = {101 : 106};

Plane Surface(1) = {1, 2};
Plane Surface(2) = {2};

// Materials: the names are the keys of the .prm file. No physical curves: sides are found by matching.
Physical Surface("ground", 1) = {1};
Physical Surface("dot", 2) = {2};
