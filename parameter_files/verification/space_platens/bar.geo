// A bar of 1 m x 1 m, 4 m high along z, of tetrahedra.
DefineConstant[ h = 0.5 ];
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1 : 4} = 1 / h + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
made[] = Extrude {0, 0, 4} { Surface{1}; Layers{4 / h}; };

Physical Surface("foot") = {1};
Physical Surface("head") = {made[0]};
Physical Volume("bar") = {made[1]};
