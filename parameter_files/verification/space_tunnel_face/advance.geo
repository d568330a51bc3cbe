// The tunnel of face.geo, coarser, with a core of three rounds, up to y = -4 m, -2 m and 0.
SetFactory("OpenCASCADE");
a = 1;
b = 12;
l = 10;
d = 0.001;
faces() = {-10, -4, -2, 0, 20};
DefineConstant[ h = 0.13 ];
For i In {0 : 3}
  For k In {0 : 1}
    r = k ? b : a;
    p = newp;
    Point(p) = {0, faces(i), 0};
    Point(p + 1) = {r, faces(i), 0};
    Point(p + 2) = {0, faces(i), r};
    c = newl;
    Line(c) = {p, p + 1};
    Circle(c + 1) = {p + 1, p, p + 2};
    Line(c + 2) = {p + 2, p};
    q = newll;
    Curve Loop(q) = {c, c + 1, c + 2};
    s = news;
    Plane Surface(s) = {q};
    parts() = Extrude {0, faces(i + 1) - faces(i), 0} { Surface{s}; };
    If (k)
      outer() += {parts(1)};
    Else
      inner() += {parts(1)};
    EndIf
  EndFor
EndFor
BooleanFragments{ Volume{outer()}; Delete; }{ Volume{inner()}; Delete; }

all() = Volume "*";
skin() = CombinedBoundary{ Volume{all()}; };
For i In {0 : 2}
  part() = Volume In BoundingBox {-d, faces(i) - d, -d, a + d, faces(i + 1) + d, a + d};
  Physical Volume(Sprintf("core%g", i + 1)) = part();
  all() -= part();
EndFor
Physical Volume("rock") = all();
Physical Surface("x0") = Surface In BoundingBox {-d, -l - d, -d, d, 2 * l + d, b + d};
Physical Surface("z0") = Surface In BoundingBox {-d, -l - d, -d, b + d, 2 * l + d, d};
Physical Surface("ends") = {
  Surface In BoundingBox {-d, -l - d, -d, b + d, -l + d, b + d},
  Surface In BoundingBox {-d, 2 * l - d, -d, b + d, 2 * l + d, b + d}};
For i In {0 : #skin() - 1}
  box() = BoundingBox Surface{Abs(skin(i))};
  If (box(3) - box(0) > b - d && box(4) - box(1) > 1 && box(5) - box(2) > b - d)
    out() += {Abs(skin(i))};
  EndIf
EndFor
Physical Surface("outside") = {out()};

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Field[1] = MathEval;
Field[1].F = Sprintf("%g * (1 + 2.5 * Fabs(Sqrt(x*x + z*z) - 1) + 0.4 * Max(Fabs(y + 2) - 3, 0))", h);
Background Field = 1;
