// Block of 1 m x 0.5 m about the origin.
h = 0.125;

Point(1) = {-0.5, -0.25, 0, h};
Point(2) = {0.5, -0.25, 0, h};
Point(3) = {0.5, 0.25, 0, h};
Point(4) = {-0.5, 0.25, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = 1 / h + 1;
Transfinite Curve{2, 4} = 0.5 / h + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1};

Physical Surface("block") = {1};
