// A column of 1 m x 1 m, 3 m high, cut by a plane that dips by 50 degrees to 30 degrees from x.
SetFactory("OpenCASCADE");
h   = 0.3;
dip = 50 * Pi / 180;
to  = 30 * Pi / 180;
Box(1) = {-0.5, -0.5, 0, 1, 1, 3};
Rectangle(100) = {-2, -2, 0, 4, 4};
Rotate{ {0, 1, 0}, {0, 0, 0}, dip } { Surface{100}; }
Rotate{ {0, 0, 1}, {0, 0, 0}, to } { Surface{100}; }
Translate{ 0, 0, 1.5 } { Surface{100}; }
BooleanFragments{ Volume{1}; Delete; }{ Surface{100}; Delete; }
d = 0.001;
all() = Surface "*";
For i In {0 : #all() - 1}
  box() = BoundingBox Surface{all(i)};
  If (box(0) < -1)
    Recursive Delete { Surface{all(i)}; }
  EndIf
EndFor
lower() = Volume In BoundingBox {-0.5 - d, -0.5 - d, -d, 0.5 + d, 0.5 + d, 3 - d};
upper() = Volume "*";
upper() -= lower();
Physical Volume("lower") = lower();
Physical Volume("upper") = upper();
Physical Surface("base") = Surface In BoundingBox {-0.5 - d, -0.5 - d, -d, 0.5 + d, 0.5 + d, d};
Physical Surface("top") = Surface In BoundingBox {-0.5 - d, -0.5 - d, 3 - d, 0.5 + d, 0.5 + d, 3 + d};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
