// Rock of 5 m x 4 m, 20 m high along z, of tetrahedra of 1 m.
DefineConstant[ h = 1 ];

Point(1) = {0, 0, -20};
Point(2) = {5, 0, -20};
Point(3) = {5, 4, -20};
Point(4) = {0, 4, -20};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = 5 / h + 1;
Transfinite Curve{2, 4} = 4 / h + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
// top, volume, then a side for each of the four lines
made[] = Extrude {0, 0, 20} { Surface{1}; Layers{20 / h}; };

Physical Surface("base") = {1};
Physical Surface("top") = {made[0]};
Physical Surface("south") = {made[2]};
Physical Surface("east") = {made[3]};
Physical Surface("north") = {made[4]};
Physical Surface("west") = {made[5]};
Physical Volume("rock") = {made[1]};
