// A ring of rock about a hole; boundary elements beyond.
h = 0.3;
Point(1) = {0, 0, 0, h};
For i In {0:3}
  Point(10 + i) = {0.8 * Cos(i * Pi / 2), 0.8 * Sin(i * Pi / 2), 0, h};
  Point(20 + i) = {2 * Cos(i * Pi / 2), 2 * Sin(i * Pi / 2), 0, h};
EndFor
For i In {0:3}
  Circle(10 + i) = {10 + i, 1, 10 + (i + 1) % 4};
  Circle(20 + i) = {20 + i, 1, 20 + (i + 1) % 4};
EndFor
Curve Loop(1) = {20:23};
Curve Loop(2) = {10:13};
Plane Surface(1) = {1, 2};
Physical Curve("wall") = {10, 11};
Physical Curve("interface") = {20:23};
Physical Surface("rock") = {1};
