// A hole of 1 m in a square of 5 m with a joint on either side of it.
h = 0.25;
Point(1) = {0, 0, 0, h};
For i In {0:3}
  c = Cos(i * Pi / 2);
  s = Sin(i * Pi / 2);
  Point(10 + i) = {c, s, 0, h};
  Point(20 + i) = {2.5 * c, 2.5 * s, 0, h};
  Point(30 + i) = {2.5 * (c - s), 2.5 * (s + c), 0, h};
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Circle(10 + i) = {10 + i, 1, 10 + j};
  Line(30 + i) = {20 + i, 30 + i};
  Line(40 + i) = {30 + i, 20 + j};
  Transfinite Curve{10 + i} = 9;
  Transfinite Curve{30 + i, 40 + i} = 11;
EndFor
Line(20) = {10, 20};
Line(22) = {12, 22};
Transfinite Curve{20, 22} = 8;
Curve Loop(1) = {20, 30, 40, 31, 41, -22, -11, -10};
Curve Loop(2) = {22, 32, 42, 33, 43, -20, -13, -12};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Physical Curve("outside") = {30, 40, 31, 41, 32, 42, 33, 43};
Physical Curve("joints") = {20, 22};
Physical Surface("rock") = {1, 2};
