// Half of a square of rock at a free surface; boundary elements beyond.
h = 0.3;
Point(20) = {-2, 0, 0, h};
Point(21) = {-2, -2, 0, h};
Point(22) = {2, -2, 0, h};
Point(23) = {2, 0, 0, h};
Point(24) = {0.6, 0, 0, h};
Point(25) = {-0.3, 0, 0, h};
For i In {0:4}
  Line(20 + i) = {20 + i, 21 + i};
EndFor
Line(25) = {25, 20};
Curve Loop(1) = {20:25};
Plane Surface(1) = {1};
Physical Curve("wall") = {24};
Physical Curve("interface") = {20:22};
Physical Surface("rock") = {1};
