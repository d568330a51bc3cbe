// From the wall of a hole, 1 m, to twice its radius.
n = 24; // edges of a quarter
m = 24; // and from the wall to the interface
Point(1) = {0, 0, 0};
For i In {0:3}
  t = (i - 0.5) * Pi / 2;
  Point(10 + i) = {Cos(t), Sin(t), 0};
  Point(20 + i) = {2 * Cos(t), 2 * Sin(t), 0};
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Circle(10 + i) = {10 + i, 1, 10 + j};
  Circle(30 + i) = {20 + i, 1, 20 + j};
  Line(20 + i) = {10 + i, 20 + i};
  Transfinite Curve{10 + i, 30 + i} = n + 1;
  Transfinite Curve{20 + i} = m + 1;
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Curve Loop(i + 1) = {20 + i, 30 + i, -(20 + j), -(10 + i)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Surface{i + 1} = {10 + i, 20 + i, 20 + j, 10 + j} Alternate;
EndFor
Physical Curve("wall") = {10:13};
Physical Curve("interface") = {30:33};
Physical Surface("rock") = {1:4};
