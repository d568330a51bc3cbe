// Three blocks, 1 m wide, one on the other.
n = 4;
y[] = {0, 0.5, 1.25, 1.65};
For i In {0 : 3}
  Point(2 * i + 1) = {0, y[i], 0};
  Point(2 * i + 2) = {1, y[i], 0};
  Line(i + 1) = {2 * i + 1, 2 * i + 2};
EndFor
For i In {0 : 2}
  Line(10 + 2 * i) = {2 * i + 2, 2 * i + 4};
  Line(11 + 2 * i) = {2 * i + 3, 2 * i + 1};
  Curve Loop(i + 1) = {i + 1, 10 + 2 * i, -(i + 2), 11 + 2 * i};
  Plane Surface(i + 1) = {i + 1};
EndFor
Transfinite Curve{1 : 4} = n + 1;
Transfinite Curve{10 : 15} = 3;
Transfinite Surface{1, 2, 3};

Physical Curve("bottom") = {1};
Physical Curve("bed") = {2, 3};
Physical Surface("stone") = {1, 2, 3};
