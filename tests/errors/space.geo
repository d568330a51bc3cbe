// Two cubes on each other, in one piece.
h = 0.5;
Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};
Point(3) = {1, 1, 0, h};
Point(4) = {0, 1, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
low[] = Extrude {0, 0, 1} { Surface{1}; };
high[] = Extrude {0, 0, 1} { Surface{low[0]}; };

Physical Surface("base") = {1};
Physical Surface("middle") = {low[0]};
Physical Surface("top") = {high[0]};
Physical Volume("low") = {low[1]};
Physical Volume("high") = {high[1]};
Physical Surface("south") = {low[2], high[2]};
Physical Surface("east") = {low[3], high[3]};
