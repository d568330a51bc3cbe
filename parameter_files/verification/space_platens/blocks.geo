// A block of 2 m x 1 m x 0.5 m on one that is as large.
n = 8;
Point(1) = {0, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = n + 1;
Transfinite Curve{2, 4} = n / 2 + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
low[] = Extrude {0, 0, 0.5} { Surface{1}; Layers{n / 4}; };
high[] = Extrude {0, 0, 0.5} { Surface{low[0]}; Layers{n / 4}; };

Physical Surface("foot") = {1};
Physical Surface("joint") = {low[0]};
Physical Volume("low") = {low[1]};
Physical Volume("high") = {high[1]};
