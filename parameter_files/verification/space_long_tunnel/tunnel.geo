// An eighth of a round tunnel along y, from its mid-length on, of radius 1 m, in rock out to
// 5 m, with its core.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.08, l = 5 ];
a = 1;
b = 5;
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
Extrude {0, l, 0} { Surface{1, 2}; }
Coherence;

Physical Volume("core") = {1};
Physical Volume("rock") = {2};
Physical Surface("x0") = Surface In BoundingBox {-d, -d, -d, d, l + d, b + d};
Physical Surface("z0") = Surface In BoundingBox {-d, -d, -d, b + d, l + d, d};
Physical Surface("middle") = Surface In BoundingBox {-d, -d, -d, b + d, d, b + d};
outer() = Boundary{ Volume{2}; };
For i In {0 : #outer() - 1}
  box() = BoundingBox Surface{outer(i)};
  If (box(3) - box(0) > b - d && box(5) - box(2) > b - d)
    If (box(4) - box(1) > l - d)
      Physical Surface("outside") = {outer(i)};
    ElseIf (box(1) > l - d)
      Physical Surface("end") = {outer(i)};
    EndIf
  EndIf
EndFor

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Field[1] = MathEval;
Field[1].F = Sprintf("%g * (1 + 2 * Fabs(Sqrt(x*x + z*z) - 1) + 0.5 * Max(y - 1, 0))", h);
Background Field = 1;
