// A slice across a quarter of a tunnel along y, out to 4 m, with its core.
SetFactory("OpenCASCADE");
a = 1;
b = 4;
w = 0.3;
d = 0.001;
Point(1) = {0, 0, 0};
Point(2) = {a, 0, 0};
Point(3) = {b, 0, 0};
Point(4) = {0, 0, a};
Point(5) = {0, 0, b};
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
one() = Extrude {0, w, 0} { Surface{1, 2}; };
Coherence;

Physical Volume("core") = {1};
Physical Volume("rock") = {2};
Physical Surface("x0") = Surface In BoundingBox {-d, -d, -d, d, w + d, b + d};
Physical Surface("z0") = Surface In BoundingBox {-d, -d, -d, b + d, w + d, d};
Physical Surface("ends") = {1, 2, Surface In BoundingBox {-d, w - d, -d, b + d, w + d, b + d}};
outer() = Boundary{ Volume{2}; };
For i In {0 : #outer() - 1}
  box() = BoundingBox Surface{outer(i)};
  If (box(3) - box(0) > b - d && box(4) - box(1) > w - d && box(5) - box(2) > b - d)
    Physical Surface("outside") = {outer(i)};
  EndIf
EndFor

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Field[1] = MathEval;
Field[1].F = "0.1 + 0.2 * Fabs(Sqrt(x*x + z*z) - 1)";
Background Field = 1;
