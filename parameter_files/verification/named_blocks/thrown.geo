// A block of 1 m x 0.5 m.
Point(1) = {2, 1, 0};
Point(2) = {3, 1, 0};
Point(3) = {3, 1.5, 0};
Point(4) = {2, 1.5, 0};
For i In {1 : 4}
  Line(i) = {i, i % 4 + 1};
EndFor
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 3} = 5;
Transfinite Curve{2, 4} = 3;
Transfinite Surface{1};
Physical Surface("block") = {1};
