// Bar of 40 m x 0.1 m, one element high.
h = 0.05;

Point(1) = {0, 0, 0, h};
Point(2) = {40, 0, 0, h};
Point(3) = {40, 0.1, 0, h};
Point(4) = {0, 0.1, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = 40 / h + 1;
Transfinite Curve{2, 4} = 2;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("rock") = {1};
