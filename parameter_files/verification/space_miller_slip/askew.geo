// A box of rock on a plane across the direction d, 40 m along it, with a joint across d in the
// middle, of tetrahedra of 2.5 m along d. Across it, where a plane wave does not vary, the box and its
// tetrahedra are so wide that nothing comes back from the sides in 0.44 s.
dx = -0.48;
dy = 0.36;
dz = 0.8;
h  = 2.5;
g  = 375;
w  = 1500;
r  = Sqrt(dx * dx + dy * dy);
// unit vectors across d: the first one is horizontal
ax = -dy / r;
ay = dx / r;
bx = -dz * ay;
by = dz * ax;
bz = dx * ay - dy * ax;
For i In {0 : 3}
  s = (i == 0 || i == 3) ? -w : w;
  t = i < 2 ? -w : w;
  Point(i + 1) = {s * ax + t * bx, s * ay + t * by, t * bz, h};
EndFor
For i In {1 : 4}
  Line(i) = {i, i % 4 + 1};
EndFor
Transfinite Curve{1 : 4} = 2 * w / g + 1;
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
// upper end, volume, then a side for each of the four lines
low() = Extrude {20 * dx, 20 * dy, 20 * dz} { Surface{1}; Layers{20 / h}; };
high() = Extrude {20 * dx, 20 * dy, 20 * dz} { Surface{low(0)}; Layers{20 / h}; };
Physical Volume("rock") = {low(1), high(1)};
Physical Surface("joint") = {low(0)};
Physical Surface("open") = {1, low({2 : 5}), high({2 : 5}), high(0)};
