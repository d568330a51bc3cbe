// Column of 4 m x 200 m, mesh size h, with curves at 80, 100 and 120 m of which
// a run makes joints as it likes. Crossed-diagonal pattern, so that the mesh is
// refined uniformly by halving h (4, 2, 1, 0.5).
DefineConstant[h = 1];

W = 4;
Y[] = {0, 80, 100, 120, 200};

For i In {0 : 4}
  Point(2 * i + 1) = {0, Y[i], 0, h};
  Point(2 * i + 2) = {W, Y[i], 0, h};
  Line(100 + i) = {2 * i + 1, 2 * i + 2};
  Transfinite Curve(100 + i) = W / h + 1;
EndFor
For i In {0 : 3}
  Line(200 + i) = {2 * i + 1, 2 * i + 3};
  Line(300 + i) = {2 * i + 2, 2 * i + 4};
  Transfinite Curve{200 + i, 300 + i} = (Y[i + 1] - Y[i]) / h + 1;
  Curve Loop(i + 1) = {100 + i, 300 + i, -(101 + i), -(200 + i)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Surface{i + 1} Alternate;
EndFor

Physical Curve("bottom") = {100};
Physical Curve("lower") = {101};
Physical Curve("middle") = {102};
Physical Curve("upper") = {103};
Physical Curve("top") = {104};
Physical Curve("sides") = {200 : 203, 300 : 303};
Physical Surface("rock") = {1 : 4};
