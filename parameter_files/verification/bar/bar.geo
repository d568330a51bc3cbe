// Bar of 10 m x 0.2 m.
h = 0.05;

Point(1) = {0, 0, 0, h};
Point(2) = {10, 0, 0, h};
Point(3) = {10, 0.2, 0, h};
Point(4) = {0, 0.2, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = 10 / h + 1;
Transfinite Curve{2, 4} = 0.2 / h + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;

Physical Curve("left") = {4};
Physical Curve("right") = {2};
Physical Surface("rock") = {1};
