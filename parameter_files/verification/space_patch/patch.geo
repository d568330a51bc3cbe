// Box of 1 m x 0.8 m x 0.6 m with an irregular mesh of tetrahedra.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 0.8, 0.6};
Mesh.MeshSizeMin = 0.2;
Mesh.MeshSizeMax = 0.2;

Physical Surface("x0") = {1};
Physical Surface("x1") = {2};
Physical Surface("y0") = {3};
Physical Surface("y1") = {4};
Physical Surface("base") = {5};
Physical Surface("top") = {6};
Physical Volume("rock") = {1};
