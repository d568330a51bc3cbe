// A cube of rock of 6 m with a small cube in its middle on which a force acts, finer around that one.
SetFactory("OpenCASCADE");
a = 0.25;
b = 3;
Box(1) = {-b, -b, -b, 2 * b, 2 * b, 2 * b};
Box(2) = {-a, -a, -a, 2 * a, 2 * a, 2 * a};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }

d = 0.001;
core() = Volume In BoundingBox {-a - d, -a - d, -a - d, a + d, a + d, a + d};
rock() = Volume "*";
rock() -= core();
Physical Volume("core") = core();
Physical Volume("rock") = rock();
Physical Surface("outside") = {
  Surface In BoundingBox {-b - d, -b - d, -b - d, -b + d, b + d, b + d},
  Surface In BoundingBox {b - d, -b - d, -b - d, b + d, b + d, b + d},
  Surface In BoundingBox {-b - d, -b - d, -b - d, b + d, -b + d, b + d},
  Surface In BoundingBox {-b - d, b - d, -b - d, b + d, b + d, b + d},
  Surface In BoundingBox {-b - d, -b - d, -b - d, b + d, b + d, -b + d},
  Surface In BoundingBox {-b - d, -b - d, b - d, b + d, b + d, b + d}};

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
DefineConstant[ h = 0.1 ];
Field[1] = MathEval;
Field[1].F = Sprintf("%g * (1 + 1.2 * Max(Sqrt(x*x + y*y + z*z) - 0.4, 0))", h);
Background Field = 1;
