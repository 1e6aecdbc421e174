// Two stripes of a unit square whose areas tell the groups apart: soft 3/8, hard 5/8.
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 0.375, 0}; Point(4) = {0, 0.375, 0};
Point(5) = {1, 1, 0}; Point(6) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7}; Plane Surface(2) = {2};
Physical Surface("soft", 7) = {1}; Physical Surface("hard", 3) = {2};
Transfinite Curve{1, 2, 3, 4, 5, 6, 7} = 3; Transfinite Surface{1, 2};
