// Column of 0.4 m x 0.4 m, 20 m high along z, with a joint in the middle, of tetrahedra.
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
// upper end, volume, then a side for each of the four lines
low[] = Extrude {0, 0, 10} { Surface{1}; Layers{10 / h}; };
high[] = Extrude {0, 0, 10} { Surface{low[0]}; Layers{10 / h}; };

Physical Surface("base") = {1};
Physical Surface("joint") = {low[0]};
Physical Surface("top") = {high[0]};
Physical Surface("y sides") = {low[2], low[4], high[2], high[4]};
Physical Surface("x sides") = {low[3], low[5], high[3], high[5]};
Physical Volume("rock") = {low[1], high[1]};
