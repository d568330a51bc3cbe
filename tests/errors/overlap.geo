// Two blocks of 1 m x 0.5 m, the upper one 2 cm too low.
h = 0.25;

Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};
Point(3) = {1, 0.5, 0, h};
Point(4) = {0, 0.5, 0, h};
Point(5) = {0.1, 0.48, 0, h};
Point(6) = {0.9, 0.48, 0, h};
Point(7) = {0.9, 1, 0, h};
Point(8) = {0.1, 1, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 5};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(2) = {2};

Physical Curve("bottom") = {1};
Physical Curve("top") = {7};
Physical Curve("bed") = {3};
Physical Curve("left") = {4, 8};
Physical Curve("right") = {2, 6};
Physical Surface("rock") = {1};
Physical Surface("lid") = {2};
