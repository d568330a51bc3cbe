// Column of 10 m x 10 m, 200 m high along z, with a joint in the middle, of tetrahedra.
h = 5;

Point(1) = {0, 0, 0};
Point(2) = {10, 0, 0};
Point(3) = {10, 10, 0};
Point(4) = {0, 10, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1 : 4} = 10 / h + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
// upper end, volume, then a side for each of the four lines
low[] = Extrude {0, 0, 100} { Surface{1}; Layers{100 / h}; };
high[] = Extrude {0, 0, 100} { Surface{low[0]}; Layers{100 / h}; };

Physical Surface("base") = {1};
Physical Surface("joint") = {low[0]};
Physical Surface("top") = {high[0]};
Physical Surface("sides") = {low[2], low[3], low[4], low[5], high[2], high[3], high[4], high[5]};
Physical Volume("rock") = {low[1], high[1]};
