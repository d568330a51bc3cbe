// The ring of the case kirsch, in its hole a lining of 0.1 m and a core.
Include "../kirsch/ring.geo";
For i In {0:7}
  t = i * Pi / 4;
  Point(50 + i) = {0.9 * Cos(t), 0.9 * Sin(t), 0};
EndFor
For i In {0:7}
  j = (i + 1) % 8;
  Circle(50 + i) = {50 + i, 1, 50 + j};
  Line(60 + i) = {50 + i, 10 + i};
  Transfinite Curve{50 + i} = n + 1;
  Transfinite Curve{60 + i} = 3;
EndFor
For i In {0:7}
  j = (i + 1) % 8;
  Curve Loop(50 + i) = {60 + i, 10 + i, -(60 + j), -(50 + i)};
  Plane Surface(50 + i) = {50 + i};
  Transfinite Surface{50 + i} = {50 + i, 10 + i, 10 + j, 50 + j} Alternate;
EndFor
Curve Loop(100) = {50:57};
Plane Surface(100) = {100};
Physical Curve("inside") = {50:57};
Physical Surface("lining") = {50:57};
Physical Surface("core") = {100};
Mesh.MeshSizeMin = 0.1;
Mesh.MeshSizeMax = 0.3;
