// A block of 1 m x 0.4 m on a plane that falls to the right by 35 degrees.
b = 35 * Pi / 180;
h = 0.2;
Macro PutPoint
  // s down the plane, n off it
  Point(p) = {s * Cos(b) + n * Sin(b), -s * Sin(b) + n * Cos(b), 0, h};
Return
p = 1; s = -0.4; n = -0.5; Call PutPoint;
p = 2; s = 1.4; n = -0.5; Call PutPoint;
p = 3; s = 1.4; n = 0; Call PutPoint;
p = 4; s = 1; n = 0; Call PutPoint;
p = 5; s = 0; n = 0; Call PutPoint;
p = 6; s = -0.4; n = 0; Call PutPoint;
p = 7; s = 1; n = 0.4; Call PutPoint;
p = 8; s = 0; n = 0.4; Call PutPoint;
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {4, 7};
Line(8) = {7, 8};
Line(9) = {8, 5};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Curve Loop(2) = {-4, 7, 8, 9};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Physical Curve("foot") = {1};
Physical Curve("plane") = {4};
Physical Surface("base") = {1};
Physical Surface("block") = {2};
