// The rock about the cavity, between the radii 1 and 2.
n_around = 24; n_out = 16;
Point(1) = {0, 0, 0};
For i In {0:3}
  Point(10 + i) = {Cos(i * Pi / 2), Sin(i * Pi / 2), 0};
  Point(20 + i) = {2 * Cos(i * Pi / 2), 2 * Sin(i * Pi / 2), 0};
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Circle(10 + i) = {10 + i, 1, 10 + j};
  Circle(20 + i) = {20 + i, 1, 20 + j};
  Line(30 + i)   = {10 + i, 20 + i};
  Transfinite Curve{10 + i, 20 + i} = n_around + 1;
  Transfinite Curve{30 + i}         = n_out + 1 Using Progression 1.08;
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Curve Loop(i + 1)    = {30 + i, 20 + i, -(30 + j), -(10 + i)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Surface{i + 1} Alternate;
EndFor
Physical Curve("wall")      = {10:13};
Physical Curve("interface") = {20:23};
Physical Surface("rock")    = {1:4};
