// A strip of 20 m x 0.4 m.
h = 0.1;
Point(1) = {0, 0, 0};
Point(2) = {20, 0, 0};
Point(3) = {20, 0.4, 0};
Point(4) = {0, 0.4, 0};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
  Transfinite Curve{i} = (i % 2 ? 20 : 0.4) / h + 1;
EndFor
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
Physical Curve("long") = {1, 3};
Physical Curve("ends") = {2, 4};
Physical Surface("rock") = {1};
