// Two blocks of 1 m x 0.8 m x 0.5 m of tetrahedra, one on the other; the triangles of the
// joint are irregular.
h = 0.3;

Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};
Point(3) = {1, 0.8, 0, h};
Point(4) = {0, 0.8, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
base[] = Extrude {0, 0, 0.5} { Surface{1}; Layers{2}; };
slider[] = Extrude {0, 0, 0.5} { Surface{base[0]}; Layers{2}; };

Physical Surface("joint") = {base[0]};
Physical Volume("base") = {base[1]};
Physical Volume("slider") = {slider[1]};
