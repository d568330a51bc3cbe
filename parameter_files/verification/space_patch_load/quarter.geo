// A quarter of the ground under a square of 2 m, in a box of 6 m, finer under it.
SetFactory("OpenCASCADE");
b = 1;
a = 6;
Box(1) = {0, 0, -a, a, a, a};
Rectangle(100) = {0, 0, 0, b, b};
// points of histories
Point(101) = {0, 0, -b};
Point(102) = {0, 0, -2 * b};
Point(103) = {2 * b, 0, 0};
BooleanFragments{ Volume{1}; Delete; }{ Surface{100}; Point{101 : 103}; Delete; }

d = 0.001;
Physical Volume("ground") = Volume "*";
Physical Surface("x0") = Surface In BoundingBox {-d, -d, -a - d, d, a + d, d};
Physical Surface("y0") = Surface In BoundingBox {-d, -d, -a - d, a + d, d, d};
Physical Surface("outside") = {Surface In BoundingBox {a - d, -d, -a - d, a + d, a + d, d},
  Surface In BoundingBox {-d, a - d, -a - d, a + d, a + d, d},
  Surface In BoundingBox {-d, -d, -a - d, a + d, a + d, -a + d}};
Physical Surface("square") = Surface In BoundingBox {-d, -d, -d, b + d, b + d, d};

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Field[1] = MathEval;
Field[1].F = "0.1 + 0.12 * Sqrt(Max(x-0.8, 0)^2 + Max(y-0.8, 0)^2 + Max(-z-0.8, 0)^2)";
Background Field = 1;
Mesh.Algorithm3D = 10;
