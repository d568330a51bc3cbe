// A square of 6 m about the origin.
h = 0.15;
Point(1) = {-3, -3, 0, h};
Point(2) = {3, -3, 0, h};
Point(3) = {3, 3, 0, h};
Point(4) = {-3, 3, 0, h};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
  Transfinite Curve{i} = 6 / h + 1;
EndFor
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Point(5) = {0, 0, 0, h}; // where the histories look
Point{5} In Surface{1};
Physical Curve("interface") = {1:4};
Physical Surface("rock") = {1};
