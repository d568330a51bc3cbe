// Beam of 4 m x 0.4 m on two piers, 0.2 m wide, with an overhang for an axle.
h = 0.2;
x() = {-2, -1.1, -0.9, 0.9, 1.1, 2};
For i In {0 : 5}
  Point(1 + i) = {x(i), 0, 0, h};
EndFor
Point(7) = {2, 0.4, 0, h};
Point(8) = {1.9, 0.4, 0, h};
Point(9) = {1.7, 0.4, 0, h};
Point(10) = {-2, 0.4, 0, h};
For i In {1 : 9}
  Line(i) = {i, i + 1};
EndFor
Line(10) = {10, 1};
Curve Loop(1) = {1 : 10};
Plane Surface(1) = {1};
For i In {0 : 1}
  Point(11 + 2 * i) = {x(1 + 2 * i), -0.2, 0, h};
  Point(12 + 2 * i) = {x(2 + 2 * i), -0.2, 0, h};
  Line(11 + 3 * i) = {11 + 2 * i, 12 + 2 * i};
  Line(12 + 3 * i) = {12 + 2 * i, 3 + 2 * i};
  Line(13 + 3 * i) = {2 + 2 * i, 11 + 2 * i};
  Curve Loop(2 + i) = {11 + 3 * i, 12 + 3 * i, -(2 + 2 * i), 13 + 3 * i};
  Plane Surface(2 + i) = {2 + i};
EndFor

Physical Curve("bed") = {2, 4};
Physical Curve("axle") = {8};
Physical Surface("beam") = {1};
Physical Surface("base") = {2, 3};
