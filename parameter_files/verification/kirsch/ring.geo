// A hole of radius 1 m in a square of 5 m, in eight structured sectors.
n = 16; // edges of a sector along the wall
m = 26; // and from the wall to the square
For i In {0:7}
  t = i * Pi / 4;
  Point(10 + i) = {Cos(t), Sin(t), 0};
  r = 2.5 / Cos((i % 2) * Pi / 4);
  Point(20 + i) = {r * Cos(t), r * Sin(t), 0};
EndFor
Point(1) = {0, 0, 0};
For i In {0:7}
  j = (i + 1) % 8;
  Circle(10 + i) = {10 + i, 1, 10 + j};
  Line(20 + i) = {10 + i, 20 + i};
  Line(30 + i) = {20 + i, 20 + j};
  Transfinite Curve{10 + i, 30 + i} = n + 1;
  Transfinite Curve{20 + i} = m + 1 Using Progression 1.05;
EndFor
For i In {0:7}
  j = (i + 1) % 8;
  Curve Loop(i + 1) = {20 + i, 30 + i, -(20 + j), -(10 + i)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Surface{i + 1} = {10 + i, 20 + i, 20 + j, 10 + j} Alternate;
EndFor
Physical Curve("wall") = {10:17};
Physical Curve("right") = {30, 37};
Physical Curve("top") = {31, 32};
Physical Curve("left") = {33, 34};
Physical Curve("bottom") = {35, 36};
Physical Surface("rock") = {1:8};
