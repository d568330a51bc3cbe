// A block on a plane that falls to the right by `slope` degrees, as two
// surfaces with points of their own. To be included after
//   slope [deg], plane_start, plane_end, plane_depth, width, height [m],
//   plane_edges, width_edges, height_edges.
// The block's lower left corner is the origin; distances along the plane count
// down it.
c = Cos(slope * Pi / 180);
s = Sin(slope * Pi / 180);
along() = {plane_start, plane_end, plane_end, plane_start,
           0, width, width, 0};
above() = {-plane_depth, -plane_depth, 0, 0, 0, 0, height, height};
For i In {0 : 7}
  Point(i + 1) = {c * along(i) + s * above(i), c * above(i) - s * along(i), 0};
EndFor
For b In {0 : 1}
  For i In {1 : 4}
    Line(4 * b + i) = {4 * b + i, 4 * b + i % 4 + 1};
  EndFor
  Curve Loop(b + 1) = {4 * b + 1, 4 * b + 2, 4 * b + 3, 4 * b + 4};
  Plane Surface(b + 1) = {b + 1};
EndFor
Transfinite Curve{1, 3} = plane_edges + 1;
Transfinite Curve{2, 4} = 2;
Transfinite Curve{5, 7} = width_edges + 1;
Transfinite Curve{6, 8} = height_edges + 1;
Transfinite Surface{1, 2};

Physical Surface("plane") = {1};
Physical Surface("block") = {2};
