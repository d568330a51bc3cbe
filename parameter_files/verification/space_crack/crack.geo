// A quarter of a disc of radius 1 m, the crack, inside a quarter of a block of
// 8 m x 8 m x 8 m; it ends at the planes of symmetry x = 0 and y = 0.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.12 ]; // edges at the crack
Box(1) = {0, 0, -4, 4, 4, 8};
Point(101) = {0, 0, 0};
Point(102) = {1, 0, 0};
Point(103) = {0, 1, 0};
Line(101) = {101, 102};
Circle(102) = {102, 101, 103};
Line(103) = {103, 101};
Curve Loop(101) = {101, 102, 103};
Plane Surface(101) = {101};
BooleanFragments{ Volume{1}; Delete; }{ Surface{101}; Delete; }

e = 1e-3;
crack[] = Surface In BoundingBox{-e, -e, -e, 1 + e, 1 + e, e};
Field[1] = Distance;
Field[1].SurfacesList = {crack[]};
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = h;
Field[2].SizeMax = 1;
Field[2].DistMin = 0.2;
Field[2].DistMax = 4;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;

Physical Surface("crack") = {crack[]};
Physical Surface("base") = Surface In BoundingBox{-e, -e, -4 - e, 4 + e, 4 + e, -4 + e};
Physical Surface("top") = Surface In BoundingBox{-e, -e, 4 - e, 4 + e, 4 + e, 4 + e};
Physical Surface("x0") = Surface In BoundingBox{-e, -e, -4 - e, e, 4 + e, 4 + e};
Physical Surface("y0") = Surface In BoundingBox{-e, -e, -4 - e, 4 + e, e, 4 + e};
Physical Volume("rock") = Volume In BoundingBox{-e, -e, -4 - e, 4 + e, 4 + e, 4 + e};
