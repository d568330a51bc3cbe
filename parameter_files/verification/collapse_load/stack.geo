// Three blocks of 1 m x 1 m, one on the other, from the origin, on a base.
n = 20;
Point(1) = {-1, -0.2, 0};
Point(2) = {2, -0.2, 0};
Point(3) = {2, 0, 0};
Point(4) = {-1, 0, 0};
For i In {0 : 3}
  Point(10 + i) = {0, i, 0};
  Point(20 + i) = {1, i, 0};
  Line(10 + i) = {10 + i, 20 + i};
EndFor
For i In {0 : 2}
  Line(20 + i) = {20 + i, 21 + i};
  Line(30 + i) = {11 + i, 10 + i};
  Curve Loop(2 + i) = {10 + i, 20 + i, -(11 + i), 30 + i};
  Plane Surface(2 + i) = {2 + i};
EndFor
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 20};
Line(4) = {10, 4};
Line(5) = {4, 1};
Curve Loop(1) = {1, 2, 3, -10, 4, 5};
Plane Surface(1) = {1};
Transfinite Curve{1} = 4;
Transfinite Curve{2, 3, 4, 5} = 2;
Transfinite Curve{10 : 13, 20 : 22, 30 : 32} = n + 1;
Transfinite Surface{2 : 4};

Physical Curve("bed") = {10, 11, 12};
Physical Surface("base") = {1};
Physical Surface("block") = {2, 3, 4};
