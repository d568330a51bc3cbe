// An eighth of a hollow sphere, 1 m to 3 m, finer at the wall, with the core that
// is excavated.
SetFactory("OpenCASCADE");
a = 1;
b = 3;
Sphere(1) = {0, 0, 0, b, 0, Pi/2, Pi/2};
Sphere(2) = {0, 0, 0, a, 0, Pi/2, Pi/2};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }

Physical Volume("core") = Volume In BoundingBox {-0.01, -0.01, -0.01, a + 0.01, a + 0.01, a + 0.01};
all() = Volume "*";
core() = Volume In BoundingBox {-0.01, -0.01, -0.01, a + 0.01, a + 0.01, a + 0.01};
rock() = {};
For i In {0 : #all() - 1}
  If (all(i) != core(0))
    rock() += all(i);
  EndIf
EndFor
Physical Volume("rock") = rock();
d = 0.001;
Physical Surface("x0") = Surface In BoundingBox {-d, -d, -d, d, b + d, b + d};
Physical Surface("y0") = Surface In BoundingBox {-d, -d, -d, b + d, d, b + d};
Physical Surface("z0") = Surface In BoundingBox {-d, -d, -d, b + d, b + d, d};
wall() = Boundary{ Volume{core(0)}; };
outer() = Boundary{ Volume{rock(0)}; };
outside() = {};
For i In {0 : #outer() - 1}
  box() = BoundingBox Surface{outer(i)};
  If (box(3) - box(0) > b - d && box(4) - box(1) > b - d && box(5) - box(2) > b - d)
    outside() += outer(i);
  EndIf
EndFor
Physical Surface("outside") = outside();

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Field[1] = MathEval;
Field[1].F = "0.075 * (1 + 2.6 * Fabs(Sqrt(x*x + y*y + z*z) - 1))";
Background Field = 1;
Mesh.Algorithm3D = 10;
