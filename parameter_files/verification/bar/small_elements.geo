// The bar with few elements of a tenth of the others' size at its middle.
h = 0.04;

Point(1) = {0, 0, 0, h};
Point(2) = {10, 0, 0, h};
Point(3) = {10, 0.2, 0, h};
Point(4) = {0, 0.2, 0, h};
Point(5) = {5, 0.1, 0, h / 10};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Point{5} In Surface{1};

Field[1] = Distance;
Field[1].PointsList = {5};
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = h / 10;
Field[2].SizeMax = h;
Field[2].DistMin = 0.005;
Field[2].DistMax = 0.06;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;

Physical Curve("left") = {4};
Physical Curve("right") = {2};
Physical Surface("rock") = {1};
