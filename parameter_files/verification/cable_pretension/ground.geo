// Rock 6 m wide and 12 m deep.
h = 1;

Point(1) = {0, 0, 0, h};
Point(2) = {6, 0, 0, h};
Point(3) = {6, 12, 0, h};
Point(4) = {0, 12, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Physical Curve("base") = {1};
Physical Curve("top") = {3};
Physical Surface("rock") = {1};
