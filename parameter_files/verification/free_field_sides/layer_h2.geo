// A layer of 40 m x 20 m, finer.
h = 0.5;
Point(1) = {-20, -20, 0, h};
Point(2) = {20, -20, 0, h};
Point(3) = {20, 0, 0, h};
Point(4) = {-20, 0, 0, h};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
  Transfinite Curve{i} = (i % 2 ? 40 : 20) / h + 1;
EndFor
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Physical Curve("base") = {1};
Physical Curve("right") = {2};
Physical Curve("surface") = {3};
Physical Curve("left") = {4};
Physical Surface("rock") = {1};
