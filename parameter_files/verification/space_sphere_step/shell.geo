// An eighth of a hollow sphere, 1 m to 5 m, finer at the wall, with nodes at 2 m.
SetFactory("OpenCASCADE");
DefineConstant[ b = 5 ];
a = 1;
m = 2;
Sphere(1) = {0, 0, 0, b, 0, Pi/2, Pi/2};
Sphere(2) = {0, 0, 0, m, 0, Pi/2, Pi/2};
Sphere(3) = {0, 0, 0, a, 0, Pi/2, Pi/2};
BooleanDifference(4) = { Volume{2}; }{ Volume{3}; };
BooleanDifference(5) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Recursive Delete { Volume{3}; }
Coherence;

Physical Volume("rock") = {4, 5};
d = 0.001;
Physical Surface("x0") = Surface In BoundingBox {-d, -d, -d, d, b + d, b + d};
Physical Surface("y0") = Surface In BoundingBox {-d, -d, -d, b + d, d, b + d};
Physical Surface("z0") = Surface In BoundingBox {-d, -d, -d, b + d, b + d, d};
For part In {4 : 5}
  faces() = Boundary{ Volume{part}; };
  For i In {0 : #faces() - 1}
    box() = BoundingBox Surface{faces(i)};
    If (part == 4 && box(3) < a + d && box(4) < a + d && box(5) < a + d)
      wall = faces(i);
    EndIf
    If (part == 5 && box(3) - box(0) > b - d && box(4) - box(1) > b - d && box(5) - box(2) > b - d)
      outside = faces(i);
    EndIf
  EndFor
EndFor
Physical Surface("wall") = {wall};
Physical Surface("outside") = {outside};

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Field[1] = MathEval;
Field[1].F = "0.085 * (0.5 + 0.5 * Sqrt(x*x + y*y + z*z))";
Background Field = 1;
Mesh.Algorithm3D = 10;
