// Bar of 10 m x 0.2 m x 0.2 m along (2, 3, 6)/7, of tetrahedra, from the origin on.
h = 0.05;
nx = 2/7; ny = 3/7; nz = 6/7;
sx = 3/7; sy = -6/7; sz = 2/7;
tx = 6/7; ty = 2/7; tz = -3/7;

Point(1) = {0, 0, 0, h};
Point(2) = {10*nx, 10*ny, 10*nz, h};
Point(3) = {10*nx + 0.2*sx, 10*ny + 0.2*sy, 10*nz + 0.2*sz, h};
Point(4) = {0.2*sx, 0.2*sy, 0.2*sz, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = 10 / h + 1;
Transfinite Curve{2, 4} = 0.2 / h + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
made[] = Extrude {0.2*tx, 0.2*ty, 0.2*tz} { Surface{1}; Layers{0.2 / h}; };

Physical Surface("left") = {made[5]};
Physical Surface("right") = {made[3]};
Physical Volume("rock") = {made[1]};
