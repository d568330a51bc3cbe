// Wall of 2 m x 6 m.
h = 0.5;

Point(1) = {0, 0, 0, h};
Point(2) = {2, 0, 0, h};
Point(3) = {2, 6, 0, h};
Point(4) = {0, 6, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Physical Curve("base") = {1};
Physical Curve("air") = {2};
Physical Curve("water") = {4};
Physical Surface("concrete") = {1};
