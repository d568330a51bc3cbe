// 6 m x 3 m below a free surface.
h = 0.15;
Point(1) = {-3, -3, 0, h};
Point(2) = {3, -3, 0, h};
Point(3) = {3, 0, 0, h};
Point(4) = {-3, 0, 0, h};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
  Transfinite Curve{i} = (i % 2 ? 6 : 3) / h + 1;
EndFor
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Physical Curve("interface") = {1, 2, 4};
Physical Curve("surface") = {3};
Physical Surface("rock") = {1};
