// A quarter of a ring, radii 1 and 5 m.
DefineConstant[ n = 16 ];   // edges along the wall
DefineConstant[ m = 26 ];   // and from the wall outwards,
DefineConstant[ g = 1.07 ]; // each so much longer than the one before
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
Physical Curve("bottom") = {1};
Physical Curve("outside") = {2};
Physical Curve("left") = {3};
Physical Curve("wall") = {4};
Physical Surface("rock") = {1};
