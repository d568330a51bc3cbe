// A layer of 20 m x 16 m, 20 m high along z, with a cavity in it; w times as wide.
SetFactory("OpenCASCADE");
DefineConstant[w = 1, h = 1.25];
d = 0.01;
Box(1) = {-10 * w, -8 * w, -20, 20 * w, 16 * w, 20};
Sphere(2) = {2, -1, -9, 2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Physical Volume("rock") = {3};
Physical Surface("cavity") = Surface In BoundingBox {-d, -3 - d, -11 - d, 4 + d, 1 + d, -7 + d};
Physical Surface("base") = Surface In BoundingBox {-10 * w - d, -8 * w - d, -20 - d, 10 * w + d, 8 * w + d, -20 + d};
Physical Surface("west") = Surface In BoundingBox {-10 * w - d, -8 * w - d, -20 - d, -10 * w + d, 8 * w + d, d};
Physical Surface("east") = Surface In BoundingBox {10 * w - d, -8 * w - d, -20 - d, 10 * w + d, 8 * w + d, d};
Physical Surface("south") = Surface In BoundingBox {-10 * w - d, -8 * w - d, -20 - d, 10 * w + d, -8 * w + d, d};
Physical Surface("north") = Surface In BoundingBox {-10 * w - d, 8 * w - d, -20 - d, 10 * w + d, 8 * w + d, d};

Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
