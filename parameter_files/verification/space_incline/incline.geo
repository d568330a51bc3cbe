// A block of 1 m x 1 m on a base whose top falls by 35 degrees, 30 degrees from
// x to y; the block's top is parallel to it.
DefineConstant[ h = 0.25 ];
drop = Tan(35 * Pi / 180);
along_x = -drop * Cos(30 * Pi / 180);
along_y = -drop * Sin(30 * Pi / 180);

For k In {0 : 2}
  For i In {1 : 4}
    x = i == 2 || i == 3 ? 1 : 0;
    y = i > 2 ? 1 : 0;
    z = k == 0 ? 0 : 1.3 + along_x * x + along_y * y + (k == 2 ? 0.5 : 0);
    Point(4 * k + i) = {x, y, z, h};
  EndFor
EndFor
For k In {0 : 2}
  For i In {1 : 4}
    Line(10 * k + i) = {4 * k + i, 4 * k + i % 4 + 1};
  EndFor
  Curve Loop(k + 1) = {10 * k + 1 : 10 * k + 4};
  Plane Surface(k + 1) = {k + 1};
EndFor
For k In {0 : 1}
  For i In {1 : 4}
    Line(100 + 10 * k + i) = {4 * k + i, 4 * k + 4 + i};
  EndFor
  For i In {1 : 4}
    Curve Loop(10 + 10 * k + i) = {10 * k + i, 100 + 10 * k + i % 4 + 1,
      -(10 * k + 10 + i), -(100 + 10 * k + i)};
    Plane Surface(10 + 10 * k + i) = {10 + 10 * k + i};
  EndFor
  Surface Loop(k + 1) = {k + 1, k + 2, 10 + 10 * k + 1 : 10 + 10 * k + 4};
  Volume(k + 1) = {k + 1};
EndFor

Physical Surface("base") = {1};
Physical Surface("slope") = {2};
Physical Volume("ground") = {1};
Physical Volume("block") = {2};
