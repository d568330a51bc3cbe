// Two blocks of 1 m x 1 m, 0.5 m apart.
For b In {0 : 1}
  Point(4 * b + 1) = {1.5 * b, 0, 0};
  Point(4 * b + 2) = {1.5 * b + 1, 0, 0};
  Point(4 * b + 3) = {1.5 * b + 1, 1, 0};
  Point(4 * b + 4) = {1.5 * b, 1, 0};
  For i In {1 : 4}
    Line(4 * b + i) = {4 * b + i, 4 * b + i % 4 + 1};
  EndFor
  Curve Loop(b + 1) = {4 * b + 1 : 4 * b + 4};
  Plane Surface(b + 1) = {b + 1};
EndFor
Transfinite Curve{1 : 8} = 3;
Transfinite Surface{1, 2};

Physical Surface("light") = {1};
Physical Surface("heavy") = {2};
