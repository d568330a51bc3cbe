// Three units of 210 x 60 mm on each other, with two joints; the middle one is
// pushed. Lengths in metres.
h = 0.03;
For j In {0 : 3}
  Point(2 * j + 1) = {0, 0.06 * j, 0, h};
  Point(2 * j + 2) = {0.21, 0.06 * j, 0, h};
  Line(j + 1) = {2 * j + 1, 2 * j + 2};
EndFor
For j In {0 : 2}
  Line(10 + j) = {2 * j + 2, 2 * j + 4};
  Line(20 + j) = {2 * j + 1, 2 * j + 3};
  Curve Loop(j + 1) = {j + 1, 10 + j, -(j + 2), -(20 + j)};
  Plane Surface(j + 1) = {j + 1};
EndFor
Physical Surface("lower")  = {1};
Physical Surface("middle") = {2};
Physical Surface("upper")  = {3};
Physical Curve("joint")    = {2, 3};
