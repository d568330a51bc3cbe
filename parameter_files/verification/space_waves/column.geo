// Column of 0.4 m x 0.4 m, 20 m high along z, of tetrahedra.
h = 0.2;

Point(1) = {0, 0, 0, h};
Point(2) = {0.4, 0, 0, h};
Point(3) = {0.4, 0.4, 0, h};
Point(4) = {0, 0.4, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1 : 4} = 3;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
// top, volume, then a side for each of the four lines
made[] = Extrude {0, 0, 20} { Surface{1}; Layers{20 / h}; };

Physical Surface("base") = {1};
Physical Surface("top") = {made[0]};
Physical Surface("y sides") = {made[2], made[4]};
Physical Surface("x sides") = {made[3], made[5]};
Physical Volume("rock") = {made[1]};
