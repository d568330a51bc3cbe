// A block of 2 m x 0.5 m on a base.
Point(1) = {0, -1, 0, 0.5};
Point(2) = {2, -1, 0, 0.5};
Point(3) = {2, 0, 0, 0.5};
Point(4) = {0, 0, 0, 0.5};
Point(5) = {2, 0.5, 0, 0.5};
Point(6) = {0, 0.5, 0, 0.5};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7};
Plane Surface(2) = {2};

Physical Curve("bed") = {3};
Physical Curve("side") = {7};
Physical Surface("base") = {1};
Physical Surface("block") = {2};
