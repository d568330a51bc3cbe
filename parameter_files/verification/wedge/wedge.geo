// A wedge of 60 degrees, 1 m high, stands on its tip between two blocks whose
// flanks fit; a pebble of 20 mm lies on it. All surfaces have points of their
// own; nothing matches.
t = Tan(Pi / 6);
top = 1;
low = 0.2; // of the flanks: the tip of the wedge hangs free
Point(1) = {0, 0, 0};
Point(2) = {t * top, top, 0};
Point(3) = {-t * top, top, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 1};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};

high = 0.9;
For side In {0 : 1}
  x = 1 - 2 * side;
  p = 10 + 10 * side;
  Point(p) = {x * t * low, low, 0};
  Point(p + 1) = {x * t * high, high, 0};
  Point(p + 2) = {x * 2, high, 0};
  Point(p + 3) = {x * 2, low, 0};
  For i In {0 : 3}
    Line(p + i) = {p + i, p + (i + 1) % 4};
  EndFor
  Curve Loop(2 + side) = {p, p + 1, p + 2, p + 3};
  Plane Surface(2 + side) = {2 + side};
EndFor

Point(30) = {0.1, top, 0};
Point(31) = {0.12, top, 0};
Point(32) = {0.12, top + 0.02, 0};
Point(33) = {0.1, top + 0.02, 0};
For i In {0 : 3}
  Line(30 + i) = {30 + i, 30 + (i + 1) % 4};
EndFor
Curve Loop(4) = {30, 31, 32, 33};
Plane Surface(4) = {4};

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Transfinite Curve{1, 3} = 6;
Transfinite Curve{2} = 6;
Transfinite Curve{10 : 13, 20 : 23, 30 : 33} = 2;

Physical Surface("wedge") = {1};
Physical Surface("right") = {2};
Physical Surface("left") = {3};
Physical Surface("pebble") = {4};
