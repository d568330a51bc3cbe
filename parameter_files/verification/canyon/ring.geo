// The rock about the canyon, between the radii 1 and 1.75.
n_around = 36; n_out = 24;
Point(1) = {0, 0, 0};
For i In {0:2}
  Point(10 + i) = {Cos(Pi + i * Pi / 2), Sin(Pi + i * Pi / 2), 0};
  Point(20 + i) = {1.75 * Cos(Pi + i * Pi / 2), 1.75 * Sin(Pi + i * Pi / 2), 0};
  Line(30 + i)  = {10 + i, 20 + i};
  Transfinite Curve{30 + i} = n_out + 1 Using Progression 1.06;
EndFor
For i In {0:1}
  Circle(10 + i) = {10 + i, 1, 11 + i};
  Circle(20 + i) = {20 + i, 1, 21 + i};
  Transfinite Curve{10 + i, 20 + i} = n_around + 1;
EndFor
For i In {0:1}
  Curve Loop(i + 1)    = {30 + i, 20 + i, -(31 + i), -(10 + i)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Surface{i + 1} Alternate;
EndFor
Physical Curve("canyon")    = {10, 11};
Physical Curve("interface") = {20, 21};
Physical Surface("rock")    = {1, 2};
