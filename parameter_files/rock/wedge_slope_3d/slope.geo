// A rock slope that faces south, 8 m high, x east, y north, z up; the crest is at
// y = z = 0. Two joints that meet in a line below its face cut a wedge out.
SetFactory("OpenCASCADE");
DefineConstant[ size = 1.1 ];
face = 70 * Pi / 180;
toe  = -8 / Tan(face);
Point(1) = {-7, 8, 0};
Point(2) = {-7, 8, -12};
Point(3) = {-7, -5.5, -12};
Point(4) = {-7, -5.5, -8};
Point(5) = {-7, toe, -8};
Point(6) = {-7, 0, 0};
For i In {1 : 6}
  Line(i) = {i, i % 6 + 1};
EndFor
Curve Loop(1) = {1 : 6};
Plane Surface(1) = {1};
rock() = Extrude {14, 0, 0} { Surface{1}; };
slope = rock(1);

// Above a joint: a box on its plane, turned about the horizontal y axis by the
// dip and about z by the dip direction, clockwise from north.
Macro Above
  above = newv;
  Box(above) = {-60, -60, 0, 120, 120, 60};
  Rotate {{1, 0, 0}, {0, 0, 0}, -dip * Pi / 180} { Volume{above}; }
  Rotate {{0, 0, 1}, {0, 0, 0}, -direction * Pi / 180} { Volume{above}; }
  Translate {1, -4.5 / Tan(face), -4.5} { Volume{above}; } // where the line comes out
Return
dip = 40; direction = 130;
Call Above;
a = above;
dip = 60; direction = 220;
Call Above;
b = above;
cut() = BooleanIntersection { Volume{a}; Delete; } { Volume{b}; Delete; };
wedge() = BooleanIntersection { Volume{slope}; } { Volume{cut(0)}; Delete; };
BooleanFragments { Volume{slope}; Delete; } { Volume{wedge(0)}; Delete; }
Physical Volume("wedge") = wedge(0);
ground() = Volume{:};
ground() -= wedge(0);
Physical Volume("ground") = ground();
e = 1e-3;
Physical Surface("east and west") = {
  Surface In BoundingBox {-7 - e, -5.5 - e, -12 - e, -7 + e, 8 + e, e},
  Surface In BoundingBox {7 - e, -5.5 - e, -12 - e, 7 + e, 8 + e, e}};
Physical Surface("north and south") = {
  Surface In BoundingBox {-7 - e, 8 - e, -12 - e, 7 + e, 8 + e, e},
  Surface In BoundingBox {-7 - e, -5.5 - e, -12 - e, 7 + e, -5.5 + e, -8 + e}};
Physical Surface("base") = Surface In BoundingBox {-7 - e, -5.5 - e, -12 - e, 7 + e, 8 + e, -12 + e};
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
