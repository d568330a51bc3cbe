// Box of 1 m x 0.8 m x 0.6 m, cut by the plane z = 0.2 + 0.2 x + y/16.
DefineConstant[ h = 0.2 ];

Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};
Point(3) = {1, 0.8, 0, h};
Point(4) = {0, 0.8, 0, h};
Point(5) = {0, 0, 0.2, h};
Point(6) = {1, 0, 0.4, h};
Point(7) = {1, 0.8, 0.45, h};
Point(8) = {0, 0.8, 0.25, h};
Point(9) = {0, 0, 0.6, h};
Point(10) = {1, 0, 0.6, h};
Point(11) = {1, 0.8, 0.6, h};
Point(12) = {0, 0.8, 0.6, h};
For k In {0 : 2}
  For i In {1 : 4}
    Line(10 * k + i) = {4 * k + i, 4 * k + i % 4 + 1};
  EndFor
  Curve Loop(k + 1) = {10 * k + 1 : 10 * k + 4};
  Plane Surface(k + 1) = {k + 1};
EndFor
For k In {0 : 1}
  For i In {1 : 4}
    Line(100 + 10 * k + i) = {4 * k + i, 4 * k + 4 + i};
  EndFor
  For i In {1 : 4}
    Curve Loop(10 + 10 * k + i) = {10 * k + i, 100 + 10 * k + i % 4 + 1,
      -(10 * k + 10 + i), -(100 + 10 * k + i)};
    Plane Surface(10 + 10 * k + i) = {10 + 10 * k + i};
  EndFor
  Surface Loop(k + 1) = {k + 1, k + 2, 10 + 10 * k + 1 : 10 + 10 * k + 4};
  Volume(k + 1) = {k + 1};
EndFor

Physical Surface("base") = {1};
Physical Surface("joint") = {2};
Physical Surface("top") = {3};
Physical Surface("y0") = {11, 21};
Physical Surface("x1") = {12, 22};
Physical Surface("y1") = {13, 23};
Physical Surface("x0") = {14, 24};
Physical Volume("rock") = {1, 2};
