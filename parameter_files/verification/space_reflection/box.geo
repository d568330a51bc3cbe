// A box of 3.2 m x 3.2 m x 2.4 m, turned out of the axes: a square wall around the
// origin with the normal (2, 3, 6)/7, the rock behind it.
nx = 2/7; ny = 3/7; nz = 6/7;
sx = 3/7; sy = -6/7; sz = 2/7;
tx = 6/7; ty = 2/7; tz = -3/7;
If (!Exists(h))
  h = 0.2;
EndIf

k = 1;
For i In {-1 : 1 : 2}
  For j In {-1 : 1 : 2}
    Point(k) = {1.6*(i*sx + i*j*tx), 1.6*(i*sy + i*j*ty),
                1.6*(i*sz + i*j*tz)};
    k += 1;
  EndFor
EndFor
For i In {1 : 4}
  Line(i) = {i, i % 4 + 1};
EndFor
Transfinite Curve{1 : 4} = Round(3.2 / h) + 1;
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Transfinite Surface{1} Alternate;
made[] = Extrude {-2.4*nx, -2.4*ny, -2.4*nz} {
  Surface{1}; Layers{Round(2.4 / h)}; };

Physical Surface("wall") = {1};
Physical Surface("rest") = {made[0], made[2], made[3], made[4], made[5]};
Physical Volume("rock") = {made[1]};
