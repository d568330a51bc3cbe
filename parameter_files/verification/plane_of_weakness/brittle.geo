// A specimen of 1 m x 2 m with a joint at 60 degrees that ends at its sides.
h = 0.2;
rise = Tan(Pi / 3);
Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};
Point(3) = {1, 1 + rise / 2, 0, h};
Point(4) = {1, 2, 0, h};
Point(5) = {0, 2, 0, h};
Point(6) = {0, 1 - rise / 2, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {6, 3};
Curve Loop(1) = {1, 2, -7, 6};
Plane Surface(1) = {1};
Curve Loop(2) = {7, 3, 4, 5};
Plane Surface(2) = {2};

Physical Curve("joint") = {7};
Physical Curve("bottom") = {1};
Physical Curve("top") = {4};
Physical Surface("rock") = {1, 2};
