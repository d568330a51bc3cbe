// Two cubes of 1 m, one on the other.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {0, 0, 1, 1, 1, 1};
Coherence;
d = 0.001;

Physical Volume("low") = {1};
Physical Volume("high") = {2};
Physical Surface("base") = Surface In BoundingBox {-d, -d, -d, 1 + d, 1 + d, d};
Physical Surface("between") = Surface In BoundingBox {-d, -d, 1 - d, 1 + d, 1 + d, 1 + d};
Physical Surface("top") = Surface In BoundingBox {-d, -d, 2 - d, 1 + d, 1 + d, 2 + d};
Physical Surface("sides x") = {Surface In BoundingBox {-d, -d, -d, d, 1 + d, 2 + d},
                               Surface In BoundingBox {1 - d, -d, -d, 1 + d, 1 + d, 2 + d}};
Physical Surface("sides y") = {Surface In BoundingBox {-d, -d, -d, 1 + d, d, 2 + d},
                               Surface In BoundingBox {-d, 1 - d, -d, 1 + d, 1 + d, 2 + d}};
Mesh.MeshSizeMin = 0.2;
Mesh.MeshSizeMax = 0.2;
