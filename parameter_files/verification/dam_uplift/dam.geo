// A triangular dam, 50 m high and 40 m wide, on a strip of ground; "foot" is the
// joint between them, with 80 faces.
Point(1) = {0, -4, 0};
Point(2) = {40, -4, 0};
Point(3) = {40, 0, 0};
Point(4) = {0, 50, 0};
Point(5) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Line(6) = {5, 3};
Curve Loop(1) = {1, 2, -6, 5};
Curve Loop(2) = {6, 3, 4};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
MeshSize{ : } = 5;
Transfinite Curve{6} = 81;
Physical Curve("upstream") = {4};
Physical Curve("downstream") = {3};
Physical Curve("foot") = {6};
Physical Surface("ground") = {1};
Physical Surface("dam") = {2};
