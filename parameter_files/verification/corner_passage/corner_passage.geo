// Slider of 0.5 m x 0.25 m on two neighbouring blocks of a table with flush
// tops, their junction at x = 0, the end of the table at x = 1 m.
DefineConstant[ slider_edges = 1 ];

Macro Outline
  p = newp;
  Point(p) = {x0, y0, 0};
  Point(p + 1) = {x1, y0, 0};
  Point(p + 2) = {x1, y1, 0};
  Point(p + 3) = {x0, y1, 0};
  l = newl;
  For i In {0 : 3}
    Line(l + i) = {p + i, p + (i + 1) % 4};
  EndFor
  Transfinite Curve{l, l + 2} = nx + 1;
  Transfinite Curve{l + 1, l + 3} = ny + 1;
  Curve Loop(block) = {l, l + 1, l + 2, l + 3};
  Plane Surface(block) = {block};
  Transfinite Surface{block};
Return

block = 1; x0 = -2; x1 = 0; y0 = -0.5; y1 = 0; nx = 1; ny = 1;
Call Outline;
block = 2; x0 = 0; x1 = 1; y0 = -0.5; y1 = 0; nx = 1; ny = 1;
Call Outline;
block = 3; x0 = -1.3; x1 = -0.8; y0 = 0; y1 = 0.25; nx = slider_edges; ny = slider_edges;
Call Outline;

Physical Surface("left") = {1};
Physical Surface("right") = {2};
Physical Surface("slider") = {3};
Physical Curve("behind") = {l + 3};
