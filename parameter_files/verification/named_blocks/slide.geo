// A block of 1 m x 0.5 m on a plane.
h = 0.25;
Point(1) = {-1, -0.5, 0};
Point(2) = {3, -0.5, 0};
Point(3) = {3, 0, 0};
Point(4) = {1, 0, 0};
Point(5) = {0, 0, 0};
Point(6) = {-1, 0, 0};
Point(7) = {1, 0.5, 0};
Point(8) = {0, 0.5, 0};
For i In {1 : 5}
  Line(i) = {i, i + 1};
EndFor
Line(6) = {6, 1};
Line(7) = {4, 7};
Line(8) = {7, 8};
Line(9) = {8, 5};
Curve Loop(1) = {1 : 6};
Plane Surface(1) = {1};
Curve Loop(2) = {-4, 7, 8, 9};
Plane Surface(2) = {2};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;

Physical Curve("bed") = {4};
Physical Surface("plane") = {1};
Physical Surface("block") = {2};
