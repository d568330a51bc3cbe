// A block on a longer one, both fine enough to be divided among ranks.
h = 0.04;

Point(1) = {0, 0, 0, h};
Point(2) = {2, 0, 0, h};
Point(3) = {2, 0.3, 0, h};
Point(4) = {1, 0.3, 0, 0.7 * h};
Point(5) = {0.2, 0.3, 0, 0.7 * h};
Point(6) = {0, 0.3, 0, h};
Point(7) = {1, 0.6, 0, h};
Point(8) = {0.2, 0.6, 0, h};

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

Physical Curve("bottom") = {1};
Physical Curve("seam") = {4};
Physical Curve("behind") = {9};
Physical Surface("bed") = {1};
Physical Surface("sled") = {2};
