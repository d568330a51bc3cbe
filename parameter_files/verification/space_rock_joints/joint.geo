// Two blocks of 1 m x 1 m x 0.5 m on each other: all corners are on the sides.
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1 : 4} = 2;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1};
// upper end, volume, then a side for each of the four lines
low[] = Extrude {0, 0, 0.5} { Surface{1}; Layers{1}; };
high[] = Extrude {0, 0, 0.5} { Surface{low[0]}; Layers{1}; };

Physical Surface("base") = {1};
Physical Surface("low sides") = {low[2], low[3], low[4], low[5]};
Physical Surface("joint") = {low[0]};
Physical Surface("high sides") = {high[2], high[3], high[4], high[5]};
Physical Surface("top") = {high[0]};
Physical Volume("rock") = {low[1], high[1]};
