// Blocks above a wall, or above a block that hangs free: impact i at x = 3 i.
gap = 0.02;

// Block of width w and height h with its lower left corner at (x, y), meshed
// with n by n cells. Call ends its line: gmsh reads the rest of it first.
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
  Transfinite Curve{l : l + 3} = n + 1;
  s = news;
  Curve Loop(s) = {l : l + 3};
  Plane Surface(s) = {s};
  Transfinite Surface{s};
Return

// onto the wall
n = 2;
w = 1; h = 1; y = gap;
x = 0;  Call Quad;
wall_02 = s;
x = 3;  Call Quad;
wall_05 = s;
x = 6;  Call Quad;
wall_08 = s;
x = 9;  Call Quad;
wall_10 = s;
x = 12; n = 4; Call Quad;
wall_soft_05 = s;
// thin, so that friction hardly turns them
n = 2;
h = 0.04;
x = 15; Call Quad;
slides = s;
x = 18; Call Quad;
sticks = s;

// onto a free block, the lower one of the two
y = 2.5 + gap; h = 1;
x = 0;  Call Quad;
equal_02 = s;
x = 3;  Call Quad;
equal_05 = s;
x = 6;  Call Quad;
equal_08 = s;
x = 9;  Call Quad;
equal_10 = s;
x = 12; n = 4; Call Quad;
soft_05 = s;
n = 2;
x = 15; Call Quad;
light_02 = s;
x = 18; Call Quad;
light_08 = s;
x = 21.3; w = 0.4; h = 0.4; Call Quad;
small_05 = s;
w = 1; h = 1;
x = 24; n = 4; Call Quad;
soft_02 = s;

y = 1.5;
x = 0;  Call Quad;
below_02 = s;
x = 3;  Call Quad;
below_05 = s;
x = 6;  Call Quad;
below_08 = s;
x = 9;  Call Quad;
below_10 = s;
x = 12; n = 5; Call Quad;
soft_below_05 = s;
n = 2;
x = 15; Call Quad;
heavy_02 = s;
x = 18; Call Quad;
heavy_08 = s;
x = 21; Call Quad;
big_05 = s;
x = 24; n = 5; Call Quad;
soft_below_02 = s;

n = 1;
x = -1; y = -1; w = 27; h = 1; Call Quad;
wall = s;

Physical Surface("above e=0.2") = {wall_02, equal_02, light_02};
Physical Surface("above e=0.5") = {wall_05, equal_05, small_05};
Physical Surface("above e=0.8") = {wall_08, equal_08, light_08};
Physical Surface("above e=1") = {wall_10, equal_10};
Physical Surface("soft above e=0.5") = {wall_soft_05, soft_05};
Physical Surface("soft above e=0.2") = {soft_02};
Physical Surface("slides") = {slides};
Physical Surface("sticks") = {sticks};
Physical Surface("below e=0.2") = {below_02};
Physical Surface("below e=0.5") = {below_05, big_05};
Physical Surface("below e=0.8") = {below_08};
Physical Surface("below e=1") = {below_10};
Physical Surface("soft below e=0.5") = {soft_below_05};
Physical Surface("soft below e=0.2") = {soft_below_02};
Physical Surface("heavy e=0.2") = {heavy_02};
Physical Surface("heavy e=0.8") = {heavy_08};
Physical Surface("wall") = {wall};
