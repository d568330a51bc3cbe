// A block of 4 m by 12 m on a strip of ground; "foot" is the joint below it, with
// eight faces.
Point(1) = {0, -1, 0};
Point(2) = {4, -1, 0};
Point(3) = {4, 0, 0};
Point(4) = {0, 0, 0};
Point(5) = {4, 12, 0};
Point(6) = {0, 12, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {-3, 5, 6, 7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
MeshSize{ : } = 0.5;
Transfinite Curve{3} = 9;
Physical Curve("base") = {1};
Physical Curve("foot") = {3};
Physical Curve("face") = {7};
Physical Surface("ground") = {1};
Physical Surface("block") = {2};
