// A box of rock 24 m wide on a plane across the direction d, 6 m along it, cut by
// n joints across d; tetrahedra of 0.5 m, or as wide as g across d.
DefineConstant[ dx = 0.48, dy = 0.6, dz = 0.64, n = 1, g = 0.5 ];
h  = 0.5;
w  = 12;
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
open() = {1};
joint() = {};
rock() = {};
top = 1;
For k In {0 : n}
  // joints stand 0.5 m from each other about the middle
  low  = k == 0 ? 0 : 3 + 0.5 * (k - 1 - (n - 1) / 2);
  high = k == n ? 6 : 3 + 0.5 * (k - (n - 1) / 2);
  l    = high - low;
  part() = Extrude {l * dx, l * dy, l * dz} { Surface{top}; Layers{l / h}; };
  top = part(0);
  rock() += part(1);
  open() += part({2 : 5});
  If (k < n)
    joint() += top;
  EndIf
EndFor
open() += top;
Physical Volume("rock") = rock();
Physical Surface("joint") = joint();
Physical Surface("open") = open();
