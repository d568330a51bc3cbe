// A wedge on two planes, dip / dip direction 40/130 and 60/220 degrees; x points
// east, y north. The line of intersection, 2 m of it, comes out at the origin. A
// tetrahedron of ground lies under each plane.
h = 0.5;
deg = Pi / 180;
// upward normals
ax = Sin(40 * deg) * Sin(130 * deg);
ay = Sin(40 * deg) * Cos(130 * deg);
az = Cos(40 * deg);
bx = Sin(60 * deg) * Sin(220 * deg);
by = Sin(60 * deg) * Cos(220 * deg);
bz = Cos(60 * deg);
// the line of intersection, upwards: a x b
lx = ay * bz - az * by;
ly = az * bx - ax * bz;
lz = ax * by - ay * bx;
l = Sqrt(lx * lx + ly * ly + lz * lz);
s = lz > 0 ? 2 / l : -2 / l;
// horizontal directions in the planes, each above the other plane
px = Cos(130 * deg);
py = -Sin(130 * deg);
p = px * bx + py * by > 0 ? 1.5 : -1.5;
qx = Cos(220 * deg);
qy = -Sin(220 * deg);
q = qx * ax + qy * ay > 0 ? 1.5 : -1.5;

Point(1) = {0, 0, 0, h};
Point(2) = {s * lx, s * ly, s * lz, h};
Point(3) = {s * lx + p * px, s * ly + p * py, s * lz, h};
Point(4) = {s * lx + q * qx, s * ly + q * qy, s * lz, h};
Point(5) = {(2 * s * lx + p * px) / 3 - 0.6 * ax,
            (2 * s * ly + p * py) / 3 - 0.6 * ay, 2 * s * lz / 3 - 0.6 * az, h};
Point(6) = {(2 * s * lx + q * qx) / 3 - 0.6 * bx,
            (2 * s * ly + q * qy) / 3 - 0.6 * by, 2 * s * lz / 3 - 0.6 * bz, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 1};
Line(4) = {2, 4};
Line(5) = {4, 1};
Line(6) = {3, 4};
For i In {1 : 3}
  Line(10 + i) = {i, 5};
EndFor
Line(21) = {1, 6};
Line(22) = {2, 6};
Line(23) = {4, 6};

Curve Loop(1) = {1, 2, 3};
Curve Loop(2) = {1, 4, 5};
Curve Loop(3) = {2, 6, -4};
Curve Loop(4) = {3, -5, -6};
Curve Loop(11) = {1, 12, -11};
Curve Loop(12) = {2, 13, -12};
Curve Loop(13) = {3, 11, -13};
Curve Loop(21) = {1, 22, -21};
Curve Loop(22) = {4, 23, -22};
Curve Loop(23) = {5, 21, -23};
For i In {1 : 4}
  Plane Surface(i) = {i};
EndFor
For i In {1 : 3}
  Plane Surface(10 + i) = {10 + i};
  Plane Surface(20 + i) = {20 + i};
EndFor
Surface Loop(1) = {1 : 4};
Volume(1) = {1};
Surface Loop(2) = {1, 11, 12, 13};
Volume(2) = {2};
Surface Loop(3) = {2, 21, 22, 23};
Volume(3) = {3};

Physical Surface("plane a") = {1};
Physical Surface("plane b") = {2};
Physical Surface("held") = {11, 12, 13, 21, 22, 23};
Physical Volume("wedge") = {1};
Physical Volume("ground") = {2, 3};
