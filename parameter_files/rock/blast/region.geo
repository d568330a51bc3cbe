// A tunnel and a charge hole in jointed rock: the region of blocks, between
// x = -16 and 12 m, y = -11 and 11 m. Two families of joints, dipping 70 and
// -15 degrees, at distances of 4 m. If 'beyond' is set, rock without joints as
// wide as that surrounds it.
SetFactory("OpenCASCADE");
left = -16; right = 12; half = 11;
radius = 3; hole = 0.4; x_hole = -9; y_hole = -2;
DefineConstant[ beyond = 0 ];
h_hole = 0.15; h_far = 0.45;

Rectangle(1) = {left, -half, 0, right - left, 2 * half};
Disk(2) = {0, 0, 0, radius};
Disk(3) = {x_hole, y_hole, 0, hole};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2, 3}; Delete; };

joints[] = {};
For family In {0:1}
  dip     = (family == 0) ? 70 * Pi / 180 : -15 * Pi / 180;
  shift   = (family == 0) ? 1.4 : 2.2;
  For i In {-8:8}
    // the point of the joint that is nearest to the tunnel's centre
    d = 4 * i + shift;
    x = -d * Sin(dip);
    y = d * Cos(dip);
    a = newp; Point(a) = {x - 60 * Cos(dip), y - 60 * Sin(dip), 0};
    b = newp; Point(b) = {x + 60 * Cos(dip), y + 60 * Sin(dip), 0};
    c = newc; Line(c) = {a, b};
    joints[] += c;
  EndFor
EndFor
inside[] = BooleanIntersection{ Curve{joints[]}; Delete; }{ Surface{4}; };
cut[] = BooleanFragments{ Surface{4}; Delete; }{ Curve{inside[]}; Delete; };

If (beyond > 0)
  pieces[] = Surface{:};
  Rectangle(1000) = {left - beyond, -half - beyond, 0,
                     right - left + 2 * beyond, 2 * (half + beyond)};
  Rectangle(1001) = {left, -half, 0, right - left, 2 * half};
  BooleanDifference(1002) = { Surface{1000}; Delete; }
                            { Surface{1001}; Delete; };
  whole[] = BooleanFragments{ Surface{pieces[]}; Delete; }
                             { Surface{1002}; Delete; };
EndIf

e       = 1e-3;
sides[] = Curve In BoundingBox{left - e, -half - e, -e, left + e, half + e, e};
sides[] += Curve In BoundingBox{right - e, -half - e, -e,
                                right + e, half + e, e};
sides[] += Curve In BoundingBox{left - e, -half - e, -e,
                                right + e, -half + e, e};
sides[] += Curve In BoundingBox{left - e, half - e, -e, right + e, half + e, e};
inner[] = Curve{:};
ends[]  = Abs(CombinedBoundary{ Surface{:}; });
inner[] -= ends[];
inner[] -= sides[];
tunnel[] = Curve In BoundingBox{-radius - e, -radius - e, -e,
                                radius + e, radius + e, e};
tunnel[] -= inner[];
charge[] = Curve In BoundingBox{x_hole - hole - e, y_hole - hole - e, -e,
                                x_hole + hole + e, y_hole + hole + e, e};
charge[] -= inner[];
Physical Curve("joints")    = {inner[]};
Physical Curve("tunnel")    = {tunnel[]};
Physical Curve("charge")    = {charge[]};
Physical Curve("interface") = {sides[]};
If (beyond > 0)
  ends[] -= tunnel[];
  ends[] -= charge[];
  Physical Curve("far") = {ends[]};
EndIf
Physical Surface("rock") = {Surface{:}};

// From h_hole at the charge to h_far in the region and h_beyond beyond it.
h_beyond                   = 1.2;
Field[1]                   = Distance;
Field[1].CurvesList        = {charge[]};
Field[1].NumPointsPerCurve = 40;
Field[2]                   = Threshold;
Field[2].InField           = 1;
Field[2].SizeMin           = h_hole;
Field[2].SizeMax           = h_beyond;
Field[2].DistMin           = 0.2;
Field[2].DistMax           = 13.5;
Field[3]                   = Box;
Field[3].XMin              = left;
Field[3].XMax              = right;
Field[3].YMin              = -half;
Field[3].YMax              = half;
Field[3].VIn               = h_far;
Field[3].VOut              = h_beyond;
Field[3].Thickness         = 10;
Field[4]                   = Min;
Field[4].FieldsList        = {2, 3};
Background Field           = 4;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints         = 0;
