// Half of the ground under a strip footing of the width 4 m, 10 by 5 m.
DefineConstant[ h = 0.25 ]; // edges
Point(1) = {0, -5, 0};
Point(2) = {10, -5, 0};
Point(3) = {10, 0, 0};
Point(4) = {2, 0, 0};
Point(5) = {0, 0, 0};
Point(6) = {2, -5, 0};
Line(1) = {1, 6};
Line(2) = {6, 2};
Line(3) = {2, 3};
Line(4) = {3, 4};
Line(5) = {4, 5};
Line(6) = {5, 1};
Line(7) = {6, 4};
Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve{1, 5} = 2 / h + 1;
Transfinite Curve{2, 4} = 8 / h + 1;
Transfinite Curve{3, 6, 7} = 5 / h + 1;
Transfinite Surface{1};
Transfinite Surface{2};
Physical Curve("bottom") = {1, 2};
Physical Curve("far") = {3};
Physical Curve("footing") = {5};
Physical Curve("axis") = {6};
Physical Surface("clay") = {1, 2};
