// A segmental arch of n voussoirs between two abutments; the origin is in the
// middle of the line between the springings. Change the next six lines.
span = 4.0;        // clear [m]
rise = 1.0;        // of the intrados [m]
thickness = 0.30;  // of the ring [m]
n = 19;            // voussoirs
first = 5;         // the axle stands on this voussoir, counted from the left ...
last = 7;          // ... to this one: 0.82 m, to which the fill spreads it

faces = 4;         // of each joint
inside = (span^2 / 4 + rise^2) / (2 * rise);
outside = inside + thickness;
centre = rise - inside;
half = Asin(span / 2 / inside);
For j In {0 : n}
  a = half * (2 * j / n - 1);
  Point(100 + j) = {inside * Sin(a), centre + inside * Cos(a), 0};
  Point(200 + j) = {outside * Sin(a), centre + outside * Cos(a), 0};
  Line(300 + j) = {100 + j, 200 + j};
EndFor
For j In {0 : n - 1}
  Line(400 + j) = {100 + j, 101 + j};
  Line(500 + j) = {200 + j, 201 + j};
  Curve Loop(j + 1) = {400 + j, 301 + j, -(500 + j), -(300 + j)};
  Plane Surface(j + 1) = {j + 1};
  Transfinite Surface{j + 1};
EndFor

// abutments, 1 m long, behind the first and the last joint
Point(1) = {-span / 2 - 1, 0, 0};
Point(2) = {-span / 2 - 1, centre + outside * Cos(half), 0};
Point(3) = {span / 2 + 1, 0, 0};
Point(4) = {span / 2 + 1, centre + outside * Cos(half), 0};
Line(1) = {1, 100};
Line(2) = {200, 2};
Line(3) = {2, 1};
Line(4) = {100 + n, 3};
Line(5) = {3, 4};
Line(6) = {4, 200 + n};
Curve Loop(n + 1) = {1, 300, 2, 3};
Plane Surface(n + 1) = {n + 1};
Curve Loop(n + 2) = {4, 5, 6, -(300 + n)};
Plane Surface(n + 2) = {n + 2};
Transfinite Curve{300 : 300 + n} = faces + 1;
Transfinite Curve{400 : 399 + n, 500 : 499 + n, 1 : 6} = 2;

Physical Curve("joint") = {300 : 300 + n};
Physical Curve("axle") = {499 + first : 499 + last};
Physical Curve("extrados") = {500 : 498 + first, 500 + last : 499 + n};
Physical Surface("voussoir") = {1 : n};
Physical Surface("abutment") = {n + 1, n + 2};
