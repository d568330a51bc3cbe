// The square, and a smaller one beside it.
Include "square.geo";
For i In {0:3}
  Point(10 + i) = {(i == 1 || i == 2) ? 8 : 5, (i > 1) ? 1 : -2, 0, h};
EndFor
For i In {0:3}
  Line(10 + i) = {10 + i, 10 + (i + 1) % 4};
  Transfinite Curve{10 + i} = 3 / h + 1;
EndFor
Curve Loop(2) = {10:13};
Plane Surface(2) = {2};
Physical Curve("second") = {10:13};
Physical Surface("rock") += {2};
