// Two blocks of 1 m x 0.5 m, one on the other, whose nodes do not match.
h = 0.25;

Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};
Point(3) = {1, 0.5, 0, h};
Point(4) = {0, 0.5, 0, h};
Point(5) = {0, 0.5, 0, h};
Point(6) = {1, 0.5, 0, h};
Point(7) = {1, 1, 0, h};
Point(8) = {0, 1, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 5};
Transfinite Curve{3} = 5;
Transfinite Curve{5} = 4;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(2) = {2};

Physical Curve("bottom") = {1};
Physical Curve("top") = {7};
Physical Surface("rock") = {1};
Physical Surface("lid") = {2};
