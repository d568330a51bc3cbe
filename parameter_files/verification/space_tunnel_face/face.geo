// A quarter of a round tunnel along y, of radius 1 m, in rock out to 12 m: its
// core is excavated up to the face, y = 0, from the plane y = -10 m on.
SetFactory("OpenCASCADE");
a = 1;
b = 12;
l = 10;
d = 0.001;
Point(1) = {0, -l, 0};
Point(2) = {a, -l, 0};
Point(3) = {b, -l, 0};
Point(4) = {0, -l, a};
Point(5) = {0, -l, b};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {1, 4};
Line(4) = {4, 5};
Circle(5) = {2, 1, 4};
Circle(6) = {3, 1, 5};
Curve Loop(1) = {1, 5, -3};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 6, -4, -5};
Plane Surface(2) = {2};
Extrude {0, l, 0} { Surface{1, 2}; }
Extrude {0, 2 * l, 0} { Surface{1, 2}; }
Coherence;

core() = Volume In BoundingBox {-d, -l - d, -d, a + d, d, a + d};
all() = Volume In BoundingBox {-d, -l - d, -d, b + d, l + d, b + d};
all() -= core();
Physical Volume("core") = {core()};
Physical Volume("rock") = {all()};
Physical Surface("x0") = Surface In BoundingBox {-d, -l - d, -d, d, l + d, b + d};
Physical Surface("z0") = Surface In BoundingBox {-d, -l - d, -d, b + d, l + d, d};
Physical Surface("ends") = {
  Surface In BoundingBox {-d, -l - d, -d, b + d, -l + d, b + d},
  Surface In BoundingBox {-d, l - d, -d, b + d, l + d, b + d}};
outer() = CombinedBoundary{ Volume{core(), all()}; };
For i In {0 : #outer() - 1}
  box() = BoundingBox Surface{outer(i)};
  If (box(3) - box(0) > b - d && box(4) - box(1) > l - d && box(5) - box(2) > b - d)
    out() += {outer(i)};
  EndIf
EndFor
Physical Surface("outside") = {out()};

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Field[1] = MathEval;
Field[1].F = "0.1 + 0.2 * Fabs(Sqrt(x*x + z*z) - 1) + 0.02 * Fabs(y)";
Background Field = 1;
