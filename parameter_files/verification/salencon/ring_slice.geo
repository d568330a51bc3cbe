// A slice of the quarter of a ring along z, one layer thick, for mixed tetrahedra, whose
// edges are half as long.
DefineConstant[ n = 8 ];    // edges along the wall
DefineConstant[ m = 13 ];   // and from the wall outwards,
DefineConstant[ g = 1.145 ]; // each so much longer than the one before
DefineConstant[ w = 0.2 ];
r = 5;
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {r, 0, 0};
Point(4) = {0, r, 0};
Point(5) = {0, 1, 0};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{2, 4} = n + 1;
Transfinite Curve{1} = m + 1 Using Progression g;
Transfinite Curve{3} = m + 1 Using Progression 1 / g;
Transfinite Surface{1} Alternate;
// top, volume, then a side for each of the four lines
made[] = Extrude {0, 0, w} { Surface{1}; Layers{1}; };
Physical Surface("faces") = {1, made[0]};
Physical Surface("bottom") = {made[2]};
Physical Surface("outside") = {made[3]};
Physical Surface("left") = {made[4]};
Physical Surface("wall") = {made[5]};
Physical Volume("rock") = {made[1]};
