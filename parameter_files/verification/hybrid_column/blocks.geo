// Four blocks of 10 m x 10 m on top of each other.
h = 1.25;
For i In {0:4}
  Point(2 * i + 1) = {0, 10 * i, 0, h};
  Point(2 * i + 2) = {10, 10 * i, 0, h};
  Line(10 * i + 1) = {2 * i + 1, 2 * i + 2};
  Transfinite Curve{10 * i + 1} = 10 / h + 1;
EndFor
For i In {0:3}
  Line(10 * i + 2) = {2 * i + 2, 2 * i + 4};
  Line(10 * i + 4) = {2 * i + 1, 2 * i + 3};
  Transfinite Curve{10 * i + 2, 10 * i + 4} = 10 / h + 1;
  Curve Loop(i + 1) = {10 * i + 1, 10 * i + 2, -(10 * i + 11), -(10 * i + 4)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Surface{i + 1} Alternate;
EndFor
Physical Curve("bed") = {11, 21, 31};
Physical Curve("top") = {41};
Physical Surface("base") = {1};
Physical Surface("rock") = {2, 3, 4};
