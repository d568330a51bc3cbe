// A cube with a passage through its west side.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {0, 0.3, 0.3, 0.5, 0.3, 0.3};
BooleanDifference { Volume{1}; Delete; } { Volume{2}; Delete; }
Physical Volume("rock") = {1};
e = 1e-3;
Physical Surface("west") = Surface In BoundingBox {-e, -e, -e, e, 1 + e, 1 + e};
Physical Surface("base") = Surface In BoundingBox {-e, -e, -e, 1 + e, 1 + e, e};
Mesh.MeshSizeMin = 0.3;
Mesh.MeshSizeMax = 0.3;
