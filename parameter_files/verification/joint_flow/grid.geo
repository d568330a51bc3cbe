// Nine blocks of 1 m, between them two horizontal and two vertical joints.
Geometry.Tolerance = 1e-6;
For j In {0:3}
  For i In {0:3}
    Point(1 + i + 4 * j) = {i, j, 0, 0.5};
  EndFor
EndFor
// Horizontal lines 1 + i + 3 j, vertical lines 13 + i + 4 j.
For j In {0:3}
  For i In {0:2}
    Line(1 + i + 3 * j) = {1 + i + 4 * j, 2 + i + 4 * j};
  EndFor
EndFor
For j In {0:2}
  For i In {0:3}
    Line(13 + i + 4 * j) = {1 + i + 4 * j, 5 + i + 4 * j};
  EndFor
EndFor
For j In {0:2}
  For i In {0:2}
    n = 1 + i + 3 * j;
    Curve Loop(n) = {1 + i + 3 * j, 14 + i + 4 * j, -(4 + i + 3 * j),
                     -(13 + i + 4 * j)};
    Plane Surface(n) = {n};
  EndFor
EndFor
Physical Curve("bottom") = {1:3};
Physical Curve("h1") = {4:6};
Physical Curve("h2") = {7:9};
Physical Curve("top") = {10:12};
Physical Curve("left") = {13, 17, 21};
Physical Curve("v1") = {14, 18, 22};
Physical Curve("v2") = {15, 19, 23};
Physical Curve("right") = {16, 20, 24};
Physical Surface("rock") = {1:4, 6:9};
Physical Surface("core") = {5};
