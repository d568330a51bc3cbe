// Two blocks of 2 m x 1 m, one on the other.
h = 0.2;

Point(1) = {0, 0, 0, h};
Point(2) = {2, 0, 0, h};
Point(3) = {2, 1, 0, h};
Point(4) = {2, 2, 0, h};
Point(5) = {0, 2, 0, h};
Point(6) = {0, 1, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {6, 3};
Curve Loop(1) = {1, 2, -7, 6};
Plane Surface(1) = {1};
Curve Loop(2) = {3, 4, 5, 7};
Plane Surface(2) = {2};

Physical Curve("joint")  = {7};
Physical Curve("bottom") = {1};
Physical Curve("top")    = {4};
Physical Surface("below") = {1};
Physical Surface("above") = {2};
