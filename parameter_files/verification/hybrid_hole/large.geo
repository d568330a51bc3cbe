// The same in a square five times as large.
Include "hole.geo";
Point(101) = {-15, -15, 0, h};
Point(102) = {15, -15, 0, h};
Point(103) = {15, 15, 0, h};
Point(104) = {-15, 15, 0, h};
For i In {0:3}
  Line(101 + i) = {101 + i, 101 + (i + 1) % 4};
  Transfinite Curve{101 + i} = 30 / h + 1;
EndFor
Curve Loop(101) = {101:104};
Curve Loop(102) = {30, 40, 31, 41, 32, 42, 33, 43};
Plane Surface(101) = {101, 102};
Physical Curve("outside") = {101:104};
Physical Surface("surroundings") = {101};
