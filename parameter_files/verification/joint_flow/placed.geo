// A square of 1 m in two halves, "above" on "below", their joint "bed" between
// them.
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 0.5, 0};
Point(4) = {1, 1, 0};
Point(5) = {0, 1, 0};
Point(6) = {0, 0.5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {6, 3};
Curve Loop(1) = {1, 2, -7, 6};
Curve Loop(2) = {3, 4, 5, 7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve{1, 4, 7} = 5;
Transfinite Curve{2, 3, 5, 6} = 3;
Transfinite Surface{1, 2};
Physical Curve("bed") = {7};
Physical Curve("left") = {5, 6};
Physical Curve("right") = {2, 3};
Physical Surface("below") = {1};
Physical Surface("above") = {2};
