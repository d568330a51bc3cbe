// A tunnel in jointed rock below a free surface: the region of blocks, between
// x = -20 and 20 m and down to y = -32 m. Two families of joints, dipping 60
// and -25 degrees, at distances of 4 and 5 m.
SetFactory("OpenCASCADE");
width = 20; depth = 32; centre = -16; radius = 3;
h_tunnel = 0.5; h_far = 1.0;

Rectangle(1) = {-width, -depth, 0, 2 * width, depth};
Disk(2) = {0, centre, 0, radius};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };

joints[] = {};
For family In {0:1}
  dip     = (family == 0) ? 60 * Pi / 180 : -25 * Pi / 180;
  spacing = (family == 0) ? 4 : 5;
  shift   = (family == 0) ? 0.6 : 1.7;
  For i In {-12:12}
    // the point of the joint that is nearest to the tunnel's centre
    d = i * spacing + shift;
    x = -d * Sin(dip);
    y = centre + d * Cos(dip);
    a = newp; Point(a) = {x - 60 * Cos(dip), y - 60 * Sin(dip), 0};
    b = newp; Point(b) = {x + 60 * Cos(dip), y + 60 * Sin(dip), 0};
    c = newc; Line(c) = {a, b};
    joints[] += c;
  EndFor
EndFor
inside[] = BooleanIntersection{ Curve{joints[]}; Delete; }{ Surface{3}; };
blocks[] = BooleanFragments{ Surface{3}; Delete; }{ Curve{inside[]}; Delete; };

all[]   = Curve{:};
outer[] = Abs(CombinedBoundary{ Surface{:}; });
all[] -= outer[];
e      = 1e-3;
wall[] = Curve In BoundingBox{-radius - e, centre - radius - e, -e,
                              radius + e, centre + radius + e, e};
top[]  = Curve In BoundingBox{-width - e, -e, -e, width + e, e, e};
wall[] -= all[];
sides[] = outer[];
sides[] -= wall[];
sides[] -= top[];
base[] = Curve In BoundingBox{-width - e, -depth - e, -e, width + e, -depth + e, e};
sides[] -= base[];
left[]  = Curve In BoundingBox{-width - e, -depth - e, -e, -width + e, e, e};
right[] = sides[];
right[] -= left[];
Physical Curve("joints")    = {all[]};
Physical Curve("tunnel")    = {wall[]};
Physical Curve("surface")   = {top[]};
Physical Curve("left")      = {left[]};
Physical Curve("right")     = {right[]};
Physical Curve("base")      = {base[]};
Physical Surface("rock")    = {Surface{:}};

Field[1]           = Distance;
Field[1].CurvesList = {wall[]};
Field[1].NumPointsPerCurve = 40;
Field[2]           = Threshold;
Field[2].InField   = 1;
Field[2].SizeMin   = h_tunnel;
Field[2].SizeMax   = h_far;
Field[2].DistMin   = 1;
Field[2].DistMax   = 8;
Background Field   = 2;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
