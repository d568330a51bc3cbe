// Three blocks of 1 m x 0.3 m on each other.
h = 0.5;
For i In {0:3}
  Point(2 * i + 1) = {0, 0.3 * i, 0, h};
  Point(2 * i + 2) = {1, 0.3 * i, 0, h};
  Line(10 + i) = {2 * i + 1, 2 * i + 2};
EndFor
For i In {0:2}
  Line(20 + i) = {2 * i + 1, 2 * i + 3};
  Line(30 + i) = {2 * i + 2, 2 * i + 4};
  Curve Loop(i + 1) = {10 + i, 30 + i, -(11 + i), -(20 + i)};
  Plane Surface(i + 1) = {i + 1};
EndFor
Physical Curve("crack") = {11};
Physical Curve("spring") = {12};
Physical Surface("base") = {1};
Physical Surface("middle") = {2};
Physical Surface("upper") = {3};
