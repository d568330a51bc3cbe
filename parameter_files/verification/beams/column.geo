// Column of 1 m x 6 m whose top is lined.
h = 0.1;
Point(1) = {0, -6, 0};
Point(2) = {1, -6, 0};
Point(3) = {1, 0, 0};
Point(4) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = 1 / h + 1;
Transfinite Curve{2, 4} = 6 / h + 1;
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
Physical Curve("base") = {1};
Physical Curve("sides") = {2, 4};
Physical Curve("top") = {3};
Physical Surface("rock") = {1};
