// A column of 2 m x 2 m, 20 m high along z, of tetrahedra of 1 m.
DefineConstant[ h = 1 ];
Point(1) = {-1, -1, -20};
Point(2) = {1, -1, -20};
Point(3) = {1, 1, -20};
Point(4) = {-1, 1, -20};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1 : 4} = 2 / h + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
// top, volume, then a side for each of the four lines
made[] = Extrude {0, 0, 20} { Surface{1}; Layers{20 / h}; };

Physical Surface("base") = {1};
Physical Surface("south") = {made[2]};
Physical Surface("east") = {made[3]};
Physical Surface("north") = {made[4]};
Physical Surface("west") = {made[5]};
Physical Volume("rock") = {made[1]};
