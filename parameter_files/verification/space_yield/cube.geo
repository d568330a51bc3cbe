// Cube of 1 m with an irregular mesh of tetrahedra.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
DefineConstant[ h = 0.4 ];
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;

Physical Surface("x0") = {1};
Physical Surface("x1") = {2};
Physical Surface("y0") = {3};
Physical Surface("y1") = {4};
Physical Surface("z0") = {5};
Physical Surface("z1") = {6};
Physical Volume("rock") = {1};
