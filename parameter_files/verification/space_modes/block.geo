// Block of 1 m x 0.7 m x 0.5 m of tetrahedra, with 6 n, 4 n and 3 n edges.
If (!Exists(n))
  n = 3;
EndIf

Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 0.7, 0};
Point(4) = {0, 0.7, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = 6 * n + 1;
Transfinite Curve{2, 4} = 4 * n + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
made[] = Extrude {0, 0, 0.5} { Surface{1}; Layers{3 * n}; };

Physical Volume("rock") = {made[1]};
