// A round tunnel along y in a box of rock that two joint sets cut, with the four
// rounds of 3 m in which it is excavated. x is east, y north, z up.
SetFactory("OpenCASCADE");
r = 3;
b = 12;
l = 21;
round = 3;
n_rounds = 4;
d = 1e-3;

Box(1) = {-b, 0, -b, 2 * b, l, 2 * b};
For k In {1 : n_rounds}
  Cylinder(10 + k) = {0, (k - 1) * round, 0, 0, round, 0, r};
EndFor
core() = {11 : 10 + n_rounds};

// Joints: dip, dip direction [degrees] and a point of each plane (x, y, z).
dip() = {55, 55, 55, 70, 70};
towards() = {250, 250, 250, 115, 115};
px() = {-2, 1, 4, -3.5, 0};
py() = {6, 6, 6, 6, 8};
pz() = {0, 0, 0, 0, 0};
For i In {0 : #dip() - 1}
  a = dip(i) * Pi / 180;
  t = towards(i) * Pi / 180;
  nx(i) = Sin(a) * Sin(t);
  ny(i) = Sin(a) * Cos(t);
  nz(i) = Cos(a);
  // a square, turned by the dip about x and by its direction about z
  Rectangle(101 + i) = {-40, -40, 0, 80, 80};
  Rotate {{1, 0, 0}, {0, 0, 0}, -a} { Surface{101 + i}; }
  Rotate {{0, 0, 1}, {0, 0, 0}, -t} { Surface{101 + i}; }
  Translate {px(i), py(i), pz(i)} { Surface{101 + i}; }
  BooleanIntersection{ Surface{101 + i}; Delete; }{ Volume{1}; }
EndFor
planes() = Surface In BoundingBox {-b - d, -d, -b - d, b + d, l + d, b + d};
planes() -= Boundary{ Volume{1, core()}; };
BooleanFragments{ Volume{1, core()}; Delete; }{ Surface{planes()}; Delete; }

// The pieces of a plane are the surfaces whose points all lie in it, but for
// those of the box and between rounds.
surfaces() = Surface{:};
For s In {0 : #surfaces() - 1}
  box() = BoundingBox Surface{surfaces(s)};
  If (box(3) < -b + d || box(0) > b - d)
    across() += {surfaces(s)};
  ElseIf (box(4) < d || box(1) > l - d)
    ends() += {surfaces(s)};
  ElseIf (box(5) < -b + d || box(2) > b - d)
    base_and_top() += {surfaces(s)};
  ElseIf (box(4) - box(1) > d)
    points() = PointsOf{ Surface{surfaces(s)}; };
    For i In {0 : #dip() - 1}
      farthest = 0;
      For p In {0 : #points() - 1}
        at() = Point{points(p)};
        farthest = Max(farthest, Fabs(nx(i) * (at(0) - px(i)) + ny(i) * (at(1) - py(i)) + nz(i) * (at(2) - pz(i))));
      EndFor
      If (farthest < d && i < 3)
        foliation() += {surfaces(s)};
      ElseIf (farthest < d)
        cross() += {surfaces(s)};
      EndIf
    EndFor
  EndIf
EndFor
Physical Surface("foliation") = {foliation()};
Physical Surface("cross") = {cross()};
Physical Surface("across") = {across()};
Physical Surface("ends") = {ends()};
Physical Surface("base_and_top") = {base_and_top()};

rock() = Volume{:};
For k In {1 : n_rounds}
  pieces() = Volume In BoundingBox {-r - d, (k - 1) * round - d, -r - d, r + d, k * round + d, r + d};
  Physical Volume(Sprintf("round_%g", k)) = {pieces()};
  rock() -= pieces();
EndFor
Physical Volume("rock") = {rock()};

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Field[1] = MathEval;
Field[1].F = "0.7 + 0.2 * Fabs(Sqrt(x*x + z*z) - 3) + 0.05 * Fabs(y - 8)";
Background Field = 1;
