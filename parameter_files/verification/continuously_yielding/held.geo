// Two blocks of 1 m x 0.5 m, one on the other, with all of their sides.
h = 0.25;

Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};
Point(3) = {1, 0.5, 0, h};
Point(4) = {1, 1, 0, h};
Point(5) = {0, 1, 0, h};
Point(6) = {0, 0.5, 0, h};
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

Physical Curve("joint") = {7};
Physical Curve("bottom") = {1};
Physical Curve("top") = {4};
Physical Curve("right") = {2, 3};
Physical Curve("left") = {5, 6};
Physical Surface("base") = {1};
Physical Surface("slider") = {2};
