// A tetrahedral wedge in a roof at z = 0, with its apex above, and a tetrahedron of
// ground on each of its three joints.
h = 0.4;
Point(1) = {-1.0, -0.6, 0, h};
Point(2) = {1.2, -0.4, 0, h};
Point(3) = {0.1, 1.1, 0, h};
Point(4) = {0.15, 0.05, 1.6, h};
// each outside of the joint between two corners of the roof and the apex
Point(5) = {0.2, -1.2, 0.8, h};
Point(6) = {1.2, 0.9, 0.8, h};
Point(7) = {-0.9, 0.8, 0.8, h};
For i In {1 : 3}
  Line(i) = {i, i % 3 + 1};
  Line(10 + i) = {i, 4};
  Line(20 + i) = {i, 4 + i};
  Line(30 + i) = {i % 3 + 1, 4 + i};
  Line(40 + i) = {4, 4 + i};
EndFor
For i In {1 : 3}
  j = i % 3 + 1;
  Curve Loop(i) = {i, 10 + j, -(10 + i)};
  Curve Loop(10 + i) = {i, 30 + i, -(20 + i)};
  Curve Loop(20 + i) = {10 + j, 40 + i, -(30 + i)};
  Curve Loop(30 + i) = {10 + i, 40 + i, -(20 + i)};
  For k In {0 : 3}
    Plane Surface(10 * k + i) = {10 * k + i};
  EndFor
  Surface Loop(i) = {i, 10 + i, 20 + i, 30 + i};
  Volume(i) = {i};
EndFor
Curve Loop(4) = {1, 2, 3};
Plane Surface(4) = {4};
Surface Loop(4) = {1 : 4};
Volume(4) = {4};

Physical Surface("joint a") = {1};
Physical Surface("joint b") = {2};
Physical Surface("joint c") = {3};
Physical Surface("roof") = {4};
Physical Surface("held") = {11 : 13, 21 : 23, 31 : 33};
Physical Volume("wedge") = {4};
Physical Volume("ground") = {1 : 3};
