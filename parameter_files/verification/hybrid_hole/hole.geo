// A hole of 1 m in a square of 6 m with four joints from its wall to the
// square's sides.
h = 0.15;
Point(1) = {0, 0, 0, h};
For i In {0:3}
  c = Cos(i * Pi / 2);
  s = Sin(i * Pi / 2);
  Point(10 + i) = {c, s, 0, h};
  Point(20 + i) = {3 * c, 3 * s, 0, h};
  Point(30 + i) = {3 * (c - s), 3 * (s + c), 0, h};
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Circle(10 + i) = {10 + i, 1, 10 + j};
  Line(20 + i) = {10 + i, 20 + i};
  Line(30 + i) = {20 + i, 30 + i};
  Line(40 + i) = {30 + i, 20 + j};
  Transfinite Curve{10 + i} = 13;
  Transfinite Curve{20 + i} = 15;
  Transfinite Curve{30 + i, 40 + i} = 21;
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Curve Loop(i + 1) = {20 + i, 30 + i, 40 + i, -(20 + j), -(10 + i)};
  Plane Surface(i + 1) = {i + 1};
EndFor
Physical Curve("wall") = {10:13};
Physical Curve("joints") = {20:23};
Physical Surface("rock") = {1:4};
