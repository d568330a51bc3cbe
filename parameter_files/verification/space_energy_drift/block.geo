// Cuboid of 1 m x 0.8 m x 0.6 m around the origin, with a joint at z = 0.1 m.
h = 0.2;

Point(1) = {-0.5, -0.4, -0.3, h};
Point(2) = {0.5, -0.4, -0.3, h};
Point(3) = {0.5, 0.4, -0.3, h};
Point(4) = {-0.5, 0.4, -0.3, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = Round(1 / h) + 1;
Transfinite Curve{2, 4} = Round(0.8 / h) + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
low[] = Extrude {0, 0, 0.4} { Surface{1}; Layers{Round(0.4 / h)}; };
high[] = Extrude {0, 0, 0.2} { Surface{low[0]}; Layers{Round(0.2 / h)}; };

Physical Surface("joint") = {low[0]};
Physical Volume("block") = {low[1], high[1]};
