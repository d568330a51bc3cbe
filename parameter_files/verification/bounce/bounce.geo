// Block of 1 m x 1.5 m, 0.1 m above a base.
h = 0.1;
n = 4;

Point(1) = {0, h, 0};
Point(2) = {1, h, 0};
Point(3) = {1, 1.5 + h, 0};
Point(4) = {0, 1.5 + h, 0};
Point(5) = {-1, -1, 0};
Point(6) = {3, -1, 0};
Point(7) = {3, 0, 0};
Point(8) = {-1, 0, 0};
For b In {0 : 1}
  For i In {1 : 4}
    Line(4 * b + i) = {4 * b + i, 4 * b + i % 4 + 1};
  EndFor
  Curve Loop(b + 1) = {4 * b + 1, 4 * b + 2, 4 * b + 3, 4 * b + 4};
  Plane Surface(b + 1) = {b + 1};
EndFor
Transfinite Curve{1, 2, 3, 4} = n + 1;
Transfinite Curve{5, 6, 7, 8} = 2;
Transfinite Surface{1, 2};

Physical Surface("block") = {1};
Physical Surface("base") = {2};
