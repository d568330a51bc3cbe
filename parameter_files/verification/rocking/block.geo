// Block of 1 m x 4 m tilted to the right by `ratio` of its angle of slenderness
// about its lower right corner, which stands on the base at the origin. To be
// included after ratio and n, the number of edges along its foot.
tilt = ratio * Atan(1 / 4);
c = Cos(tilt);
s = Sin(tilt);
// of the block, from its lower right corner, upright
x() = {-1, 0, 0, -1};
y() = {0, 0, 4, 4};
For i In {0 : 3}
  Point(i + 1) = {c * x(i) + s * y(i), c * y(i) - s * x(i), 0};
EndFor
Point(5) = {-3, -1, 0};
Point(6) = {3, -1, 0};
Point(7) = {3, 0, 0};
Point(8) = {-3, 0, 0};
For b In {0 : 1}
  For i In {1 : 4}
    Line(4 * b + i) = {4 * b + i, 4 * b + i % 4 + 1};
  EndFor
  Curve Loop(b + 1) = {4 * b + 1, 4 * b + 2, 4 * b + 3, 4 * b + 4};
  Plane Surface(b + 1) = {b + 1};
EndFor
Transfinite Curve{1, 3} = n + 1;
Transfinite Curve{2, 4} = 4 * n + 1;
Transfinite Curve{5, 6, 7, 8} = 2;
Transfinite Surface{1, 2};

Physical Surface("block") = {1};
Physical Surface("base") = {2};
