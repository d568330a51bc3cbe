// TU Eindhoven masonry shear wall, 990 x 1000 mm, as zero-thickness joints:
// 16 courses of 62.5 mm in running bond, 4.5 units of 220 mm in each. Odd
// courses (counted from below) are four units and a half, even ones a half and
// four units; every whole unit has a potential crack at mid-length. A steel
// beam strip of one course's height lies below and above. Lengths in metres.
//
// The triangles are transfinite with alternating diagonals: no direction is
// preferred, the mesh of a half unit is its own mirror image both ways, and two
// triangles meet in each of its corners, so that corner nodes, on which the
// stiffest joints pull, are not the lightest. That needs even nx and ny.

DefineConstant[
  nx = {4, Name "Elements along a half unit"},
  ny = {2, Name "Elements across a course"}
];

n_halves  = 9;      // half units in a course
n_courses = 16;
half      = 0.110;  // length of a half unit [m]
course    = 0.0625; // height of a course [m]

// Rows run from -1 (bottom beam) to n_courses (top beam); numbers are shifted
// by one row. Point, horizontal and vertical line at column i of row j:
stride = n_halves + 1;
For j In {0 : n_courses + 2}
  For i In {0 : n_halves}
    Point(1 + i + stride * j) = {i * half, (j - 1) * course, 0};
  EndFor
EndFor

h0 = 1000; // first horizontal line, from (i, j) to (i + 1, j)
v0 = 2000; // first vertical line, from (i, j) to (i, j + 1)
For j In {0 : n_courses + 2}
  For i In {0 : n_halves - 1}
    Line(h0 + i + stride * j) = {1 + i + stride * j, 2 + i + stride * j};
    Transfinite Curve {h0 + i + stride * j} = nx + 1;
  EndFor
EndFor
For j In {0 : n_courses + 1}
  For i In {0 : n_halves}
    Line(v0 + i + stride * j) = {1 + i + stride * j, 1 + i + stride * (j + 1)};
    Transfinite Curve {v0 + i + stride * j} = ny + 1;
  EndFor
EndFor

For j In {0 : n_courses + 1}
  For i In {0 : n_halves - 1}
    s = 1 + i + stride * j;
    Curve Loop(s) = {h0 + i + stride * j, v0 + i + 1 + stride * j,
                     -(h0 + i + stride * (j + 1)), -(v0 + i + stride * j)};
    Plane Surface(s) = {s};
    Transfinite Surface {s} AlternateLeft;
  EndFor
EndFor

bottom_beam[] = {}; top_beam[] = {}; brick[] = {};
base[] = {}; top[] = {}; left[] = {}; right[] = {};
bed[] = {}; beam_joint[] = {}; head[] = {}; crack[] = {};

For i In {0 : n_halves - 1}
  bottom_beam[] += {1 + i};
  top_beam[]    += {1 + i + stride * (n_courses + 1)};
  base[]        += {h0 + i};
  top[]         += {h0 + i + stride * (n_courses + 2)};
  beam_joint[]  += {h0 + i + stride, h0 + i + stride * (n_courses + 1)};
EndFor
For j In {1 : n_courses}
  left[]  += {v0 + stride * j};
  right[] += {v0 + n_halves + stride * j};
  For i In {0 : n_halves - 1}
    brick[] += {1 + i + stride * j};
    If (j > 1)
      bed[] += {h0 + i + stride * j};
    EndIf
    If (i > 0)
      // Odd courses have their head joints at even columns, even courses at
      // odd ones.
      If ((i + j) % 2 == 1)
        head[] += {v0 + i + stride * j};
      Else
        crack[] += {v0 + i + stride * j};
      EndIf
    EndIf
  EndFor
EndFor

Physical Surface("brick")       = {brick[]};
Physical Surface("bottom_beam") = {bottom_beam[]};
Physical Surface("top_beam")    = {top_beam[]};
Physical Curve("bed")        = {bed[]};
Physical Curve("beam_joint") = {beam_joint[]};
Physical Curve("head")       = {head[]};
Physical Curve("crack")      = {crack[]};
Physical Curve("base")  = {base[]};
Physical Curve("top")   = {top[]};
Physical Curve("left")  = {left[]};
Physical Curve("right") = {right[]};
