// A layer of 20 m x 16 m, 20 m high along z, of tetrahedra of 1 m.
DefineConstant[h = 1, soil = 0];

Point(1) = {-10, -8, -20};
Point(2) = {10, -8, -20};
Point(3) = {10, 8, -20};
Point(4) = {-10, 8, -20};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = 20 / h + 1;
Transfinite Curve{2, 4} = 16 / h + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
// top, volume, then a side for each of the four lines
low[] = Extrude {0, 0, 12} { Surface{1}; Layers{12 / h}; };
high[] = Extrude {0, 0, 8} { Surface{low[0]}; Layers{8 / h}; };

Physical Surface("base") = {1};
Physical Surface("south") = {low[2], high[2]};
Physical Surface("east") = {low[3], high[3]};
Physical Surface("north") = {low[4], high[4]};
Physical Surface("west") = {low[5], high[5]};
Physical Volume("rock") = {low[1]};
Physical Volume("top") = {high[1]};
