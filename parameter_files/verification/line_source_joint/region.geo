// A plane joint, y = 0, above a cavity of 0.1 m radius at (0, -1).
h = 0.05;
a = 0.1;
Point(1) = {-3, -2, 0, h};
Point(2) = {4, -2, 0, h};
Point(3) = {4, 0, 0, h};
Point(4) = {4, 1, 0, h};
Point(5) = {-3, 1, 0, h};
Point(6) = {-3, 0, 0, h};
For i In {0:3}
  Point(10 + i) = {a * Cos(i * Pi / 2), -1 + a * Sin(i * Pi / 2), 0, h};
EndFor
Point(20) = {0, -1, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {6, 3};
Transfinite Curve{1, 4, 7} = 7 / h + 1;
Transfinite Curve{2, 6} = 2 / h + 1;
Transfinite Curve{3, 5} = 1 / h + 1;
For i In {0:3}
  Circle(10 + i) = {10 + i, 20, 10 + (i + 1) % 4};
  Transfinite Curve{10 + i} = 11;
EndFor
Curve Loop(1) = {1, 2, -7, 6};
Curve Loop(2) = {7, 3, 4, 5};
Curve Loop(3) = {10:13};
Plane Surface(1) = {1, 3};
Plane Surface(2) = {2};
Physical Curve("outside") = {1, 2, 3, 4, 5, 6};
Physical Curve("joint") = {7};
Physical Curve("wall") = {10:13};
Physical Surface("rock") = {1, 2};
