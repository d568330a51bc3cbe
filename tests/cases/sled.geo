// A bed of three blocks with flush tops; on its left a sled that bears a
// load, on its right a stone in the sled's way.
DefineConstant[ h = 0.05 ];

// bed: three blocks 0.5 m x 0.2 m with common sides
For i In {0 : 3}
  Point(2 * i + 1) = {0.5 * i, 0, 0, h};
  Point(2 * i + 2) = {0.5 * i, 0.2, 0, h};
  Line(i + 1) = {2 * i + 1, 2 * i + 2};
EndFor
For i In {0 : 2}
  Point(11 + i) = {0.5 * i + 0.1, 0, 0, h};
  Point(15 + i) = {0.5 * i + 0.4, 0, 0, h};
  Line(11 + i) = {11 + i, 15 + i};
  Line(15 + i) = {2 * i + 1, 11 + i};
  Line(19 + i) = {15 + i, 2 * i + 3};
  Line(25 + i) = {2 * i + 2, 2 * i + 4};
  Curve Loop(i + 1) = {15 + i, 11 + i, 19 + i, i + 2, -(25 + i), -(i + 1)};
  Plane Surface(i + 1) = {i + 1};
EndFor

// sled 0.36 m x 0.15 m and on it, with a common side, a load of 0.2 m x 0.1 m
Point(31) = {0.11, 0.2, 0, 0.06};
Point(32) = {0.47, 0.2, 0, 0.06};
Point(33) = {0.47, 0.35, 0, 0.06};
Point(34) = {0.39, 0.35, 0, 0.04};
Point(35) = {0.19, 0.35, 0, 0.04};
Point(36) = {0.11, 0.35, 0, 0.06};
Point(37) = {0.39, 0.45, 0, 0.05};
Point(38) = {0.19, 0.45, 0, 0.05};
Line(31) = {31, 32};
Line(32) = {32, 33};
Line(33) = {33, 34};
Line(34) = {34, 35};
Line(35) = {35, 36};
Line(36) = {36, 31};
Line(37) = {34, 37};
Line(38) = {37, 38};
Line(39) = {38, 35};
Curve Loop(4) = {31 : 36};
Plane Surface(4) = {4};
Curve Loop(5) = {-34, 37, 38, 39};
Plane Surface(5) = {5};

// stone 0.15 m x 0.2 m
Point(41) = {0.67, 0.2, 0, 0.07};
Point(42) = {0.82, 0.2, 0, 0.07};
Point(43) = {0.82, 0.4, 0, 0.07};
Point(44) = {0.67, 0.4, 0, 0.07};
For i In {0 : 3}
  Line(41 + i) = {41 + i, 41 + (i + 1) % 4};
EndFor
Curve Loop(6) = {41 : 44};
Plane Surface(6) = {6};

Physical Curve("bottom") = {11 : 13};
Physical Curve("behind") = {36};
Physical Curve("cuts") = {2, 3};
Physical Curve("seam") = {34};
Physical Surface("bed") = {1 : 3};
Physical Surface("sled") = {4};
Physical Surface("load") = {5};
Physical Surface("stone") = {6};
