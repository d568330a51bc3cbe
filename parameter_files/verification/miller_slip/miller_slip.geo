// Column of 20 m x 200 m, elements of 5 m (1/388 of the S wavelength at 1 Hz),
// with a joint at mid-height.
h = 5;
W = 20;
H = 100;

For i In {0 : 2}
  Point(2 * i + 1) = {0, i * H, 0, h};
  Point(2 * i + 2) = {W, i * H, 0, h};
  Line(100 + i) = {2 * i + 1, 2 * i + 2};
  Transfinite Curve(100 + i) = W / h + 1;
EndFor
For i In {0 : 1}
  Line(200 + i) = {2 * i + 1, 2 * i + 3};
  Line(300 + i) = {2 * i + 2, 2 * i + 4};
  Transfinite Curve{200 + i, 300 + i} = H / h + 1;
  Curve Loop(i + 1) = {100 + i, 300 + i, -(101 + i), -(200 + i)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Surface{i + 1} Alternate;
EndFor

Physical Curve("bottom") = {100};
Physical Curve("joint") = {101};
Physical Curve("top") = {102};
Physical Curve("sides") = {200, 201, 300, 301};
Physical Surface("rock") = {1, 2};
