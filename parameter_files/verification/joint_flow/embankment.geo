// Blocks of 1 m, 5 beside each other and 10 on each other: joints between them.
n_x = 5;
n_y = 10;
For j In {0:n_y}
  For i In {0:n_x}
    Point(1 + i + (n_x + 1) * j) = {i, j, 0, 1};
  EndFor
EndFor
// Horizontal lines 1000 + i + n_x j, vertical lines 2000 + i + (n_x + 1) j.
For j In {0:n_y}
  For i In {0:n_x - 1}
    Line(1000 + i + n_x * j) = {1 + i + (n_x + 1) * j, 2 + i + (n_x + 1) * j};
  EndFor
EndFor
For j In {0:n_y - 1}
  For i In {0:n_x}
    Line(2000 + i + (n_x + 1) * j) = {1 + i + (n_x + 1) * j,
                                      1 + i + (n_x + 1) * (j + 1)};
  EndFor
EndFor
For j In {0:n_y - 1}
  For i In {0:n_x - 1}
    n = 1 + i + n_x * j;
    Curve Loop(n) = {1000 + i + n_x * j, 2001 + i + (n_x + 1) * j,
                     -(1000 + i + n_x * (j + 1)), -(2000 + i + (n_x + 1) * j)};
    Plane Surface(n) = {n};
  EndFor
EndFor
Physical Curve("bottom") = {1000:999 + n_x};
Physical Curve("top") = {1000 + n_x * n_y:999 + n_x * (n_y + 1)};
For j In {0:n_y - 1}
  left[] += {2000 + (n_x + 1) * j};
  right[] += {2000 + n_x + (n_x + 1) * j};
  For i In {1:n_x - 1}
    joints[] += {2000 + i + (n_x + 1) * j};
  EndFor
EndFor
For j In {1:n_y - 1}
  joints[] += {1000 + n_x * j:999 + n_x * (j + 1)};
EndFor
Physical Curve("left") = {left[]};
Physical Curve("right") = {right[]};
Physical Curve("joints") = {joints[]};
Physical Surface("rock") = {1:n_x * n_y};
