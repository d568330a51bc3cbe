// A slice of half the ground under a strip footing of the width 4 m, 10 by 5 m.
DefineConstant[ h = 0.5 ]; // edges, halved by mixed tetrahedra
DefineConstant[ layers = 1 ]; // of the thickness of 0.5 m
Point(1) = {0, 0, -5};
Point(2) = {2, 0, -5};
Point(3) = {10, 0, -5};
Point(4) = {10, 0, 0};
Point(5) = {2, 0, 0};
Point(6) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve{1, 5} = 2 / h + 1;
Transfinite Curve{2, 4} = 8 / h + 1;
Transfinite Curve{3, 6, 7} = 5 / h + 1;
Transfinite Surface{1};
Transfinite Surface{2};
Extrude {0, 0.5, 0} { Surface{1, 2}; Layers{layers}; }
d = 0.001;
Physical Volume("clay") = Volume "*";
Physical Surface("bottom") = Surface In BoundingBox {-d, -d, -5 - d, 10 + d, 0.5 + d, -5 + d};
Physical Surface("far") = Surface In BoundingBox {10 - d, -d, -5 - d, 10 + d, 0.5 + d, d};
Physical Surface("axis") = Surface In BoundingBox {-d, -d, -5 - d, d, 0.5 + d, d};
Physical Surface("footing") = Surface In BoundingBox {-d, -d, -d, 2 + d, 0.5 + d, d};
Physical Surface("slice") = {Surface In BoundingBox {-d, -d, -5 - d, 10 + d, d, d},
                             Surface In BoundingBox {-d, 0.5 - d, -5 - d, 10 + d, 0.5 + d, d}};
