// Two blocks of 0.3 m, 5 cm above a wall and above a ram.
Macro Quad
  p = newp;
  Point(p) = {x, y, 0};
  Point(p + 1) = {x + w, y, 0};
  Point(p + 2) = {x + w, y + h, 0};
  Point(p + 3) = {x, y + h, 0};
  l = newl;
  For i In {0 : 3}
    Line(l + i) = {p + i, p + (i + 1) % 4};
  EndFor
  Transfinite Curve{l : l + 3} = 2;
  s = news;
  Curve Loop(s) = {l : l + 3};
  Plane Surface(s) = {s};
  Transfinite Surface{s};
Return

w = 0.3; h = 0.3; y = 0.05;
x = 0; Call Quad;
flying = s;
x = 4; Call Quad;
struck = s;
w = 3; h = 1; y = -1;
x = -1; Call Quad;
wall = s;
x = 3; Call Quad;
ram = s;
Physical Surface("flying") = flying;
Physical Surface("struck") = struck;
Physical Surface("wall") = wall;
Physical Surface("ram") = ram;
