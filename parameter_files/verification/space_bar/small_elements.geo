// The bar with irregular tetrahedra and few of a tenth of the others' size in the middle
// of an edge.
h = 0.08;

Point(1) = {0, 0, 0};
Point(2) = {10, 0, 0};
Point(3) = {10, 0.2, 0};
Point(4) = {0, 0.2, 0};
Point(5) = {5, 0, 0};
Line(1) = {1, 5};
Line(2) = {5, 2};
Line(3) = {2, 3};
Line(4) = {3, 4};
Line(5) = {4, 1};
Curve Loop(1) = {1 : 5};
Plane Surface(1) = {1};
// top, volume, then a side for each of the five lines
made[] = Extrude {0, 0, 0.2} { Surface{1}; };

Field[1] = Distance;
Field[1].PointsList = {5};
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = h / 10;
Field[2].SizeMax = h;
Field[2].DistMin = 0.005;
Field[2].DistMax = 0.12;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;

Physical Surface("left") = {made[6]};
Physical Surface("right") = {made[4]};
Physical Volume("rock") = {made[1]};
