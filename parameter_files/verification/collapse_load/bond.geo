// A wall of bricks of 0.4 m x 0.2 m in stretcher bond, two long and four courses
// high, on a base of the same thickness. Edges are cut at half of a brick, where
// those of the next course end.
half = 0.2;
n    = 0;  // points and lines so far
m    = 0;  // blocks so far

// A block from (x, y), w half bricks long, as surface 1000 + m.
Macro Brick
  For i In {0 : w}
    Point(n + i)         = {x + i * half, y, 0};
    Point(n + w + 1 + i) = {x + (w - i) * half, y + half, 0};
  EndFor
  For i In {0 : 2 * w + 1}
    Line(n + i + 1) = {n + i, i == 2 * w + 1 ? n : n + i + 1};
  EndFor
  Transfinite Curve{n + 1 : n + 2 * w + 2} = 2;
  Curve Loop(1000 + m)    = {n + 1 : n + 2 * w + 2};
  Plane Surface(1000 + m) = {1000 + m};
  n += 2 * w + 3;
  m += 1;
Return

n = 1; x = 0; y = -half; w = 4;
Call Brick;
For course In {0 : 3}
  y = course * half;
  If (course % 2 == 0)
    w = 2; x = 0; Call Brick;
    w = 2; x = 2 * half; Call Brick;
  Else
    w = 1; x = 0; Call Brick;
    w = 2; x = half; Call Brick;
    w = 1; x = 3 * half; Call Brick;
  EndIf
EndFor

Physical Surface("base")  = {1000};
Physical Surface("brick") = {1001 : 1000 + m - 1};
