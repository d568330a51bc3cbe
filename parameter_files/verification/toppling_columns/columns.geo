// A column of 4 m that leans on one of 2 m below it, both 1 m wide, on a base.
h = 0.25;
Point(1) = {-1, -1, 0, h}; Point(2) = {3, -1, 0, h}; Point(3) = {3, 0, 0, h};
Point(4) = {2, 0, 0, h};   Point(5) = {1, 0, 0, h};  Point(6) = {0, 0, 0, h};
Point(7) = {-1, 0, 0, h};  Point(8) = {0, 4, 0, h};  Point(9) = {1, 4, 0, h};
Point(10) = {1, 2, 0, h};  Point(11) = {2, 2, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};   Line(4) = {4, 5};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 1};   Line(8) = {6, 8};
Line(9) = {8, 9}; Line(10) = {9, 10}; Line(11) = {10, 5}; Line(12) = {10, 11};
Line(13) = {11, 4};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};   Plane Surface(1) = {1};
Curve Loop(2) = {8, 9, 10, 11, 5};       Plane Surface(2) = {2};
Curve Loop(3) = {-11, 12, 13, 4};        Plane Surface(3) = {3};
Physical Surface("base")    = {1};
Physical Surface("columns") = {2, 3};
Physical Curve("foot") = {4, 5};
Physical Curve("side") = {11};
