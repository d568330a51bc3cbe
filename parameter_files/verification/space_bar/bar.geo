// Bar of 10 m x 0.2 m x 0.2 m along x, of tetrahedra.
h = 0.05;

Point(1) = {0, 0, 0, h};
Point(2) = {10, 0, 0, h};
Point(3) = {10, 0.2, 0, h};
Point(4) = {0, 0.2, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = 10 / h + 1;
Transfinite Curve{2, 4} = 0.2 / h + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
// top, volume, then a side for each of the four lines
made[] = Extrude {0, 0, 0.2} { Surface{1}; Layers{0.2 / h}; };

Physical Surface("left") = {made[5]};
Physical Surface("right") = {made[3]};
Physical Volume("rock") = {made[1]};
