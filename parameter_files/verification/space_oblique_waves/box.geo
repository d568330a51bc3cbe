// A box of rock, 20 m wide, below z = 0.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, -16, 20, 20, 16};
Physical Volume("rock") = {1};
top() = Surface In BoundingBox {-1, -1, -0.1, 21, 21, 0.1};
Physical Surface("top") = top();
below() = Surface{:};
below() -= top();
Physical Surface("below") = below();
// where motions are compared
inside = newp;
Point(inside) = {12, 8, -6, 1.2};
Point{inside} In Volume{1};
above = newp;
Point(above) = {10, 10, 0, 1.2};
Point{above} In Surface{top(0)};
Mesh.MeshSizeMin = 1.2;
Mesh.MeshSizeMax = 1.2;
