// A rectangle of 45.4299461 m x 80.9694602 m.
Point(1) = {-45.4299461, 0, 0};
Point(2) = {0, 0, 0};
Point(3) = {0, 80.9694602, 0};
Point(4) = {-45.4299461, 80.9694602, 0};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Transfinite Curve{1, 3} = 58;
Transfinite Curve{2, 4} = 102;
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Surface{1};
Physical Curve("wall") = {2};
Physical Curve("rest") = {1, 3, 4};
Physical Surface("rock") = {1};
