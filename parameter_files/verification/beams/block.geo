// A block below the beams, which have nothing to do with it.
Point(1) = {0, -3, 0};
Point(2) = {1, -3, 0};
Point(3) = {1, -2, 0};
Point(4) = {0, -2, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1:4} = 2;
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Surface{1};
Physical Curve("base") = {1};
Physical Surface("block") = {1};
