// Six bricks in three courses, 0.3 m x 0.3 m: see README.md. Lengths in metres.
h = 0.02; // size of the triangles

Point(1) = {0, 0, 0, h};     Point(2) = {0.2, 0, 0, h};
Point(3) = {0.3, 0, 0, h};
Point(4) = {0, 0.1, 0, h};   Point(5) = {0.1, 0.1, 0, h};
Point(6) = {0.2, 0.1, 0, h}; Point(7) = {0.3, 0.1, 0, h};
Point(8) = {0, 0.2, 0, h};   Point(9) = {0.1, 0.2, 0, h};
Point(10) = {0.2, 0.2, 0, h}; Point(11) = {0.3, 0.2, 0, h};
Point(12) = {0, 0.3, 0, h};  Point(13) = {0.2, 0.3, 0, h};
Point(14) = {0.3, 0.3, 0, h};

// Horizontal lines from left to right, cut where a head joint meets them
Line(1) = {1, 2};   Line(2) = {2, 3};
Line(3) = {4, 5};   Line(4) = {5, 6};   Line(5) = {6, 7};
Line(6) = {8, 9};   Line(7) = {9, 10};  Line(8) = {10, 11};
Line(9) = {12, 13}; Line(10) = {13, 14};

// Vertical lines from below: left side, right side, head joints
Line(11) = {1, 4};  Line(12) = {4, 8};  Line(13) = {8, 12};
Line(14) = {3, 7};  Line(15) = {7, 11}; Line(16) = {11, 14};
Line(17) = {2, 6};  Line(18) = {5, 9};  Line(19) = {10, 13};

// The bricks, course by course
Curve Loop(1) = {1, 17, -4, -3, -11};     Plane Surface(1) = {1};
Curve Loop(2) = {2, 14, -5, -17};         Plane Surface(2) = {2};
Curve Loop(3) = {3, 18, -6, -12};         Plane Surface(3) = {3};
Curve Loop(4) = {4, 5, 15, -8, -7, -18};  Plane Surface(4) = {4};
Curve Loop(5) = {6, 7, 19, -9, -13};      Plane Surface(5) = {5};
Curve Loop(6) = {8, 16, -10, -19};        Plane Surface(6) = {6};

Physical Surface("brick") = {1 : 6};
Physical Curve("bed")  = {3 : 8};
Physical Curve("head") = {17, 18, 19};
Physical Curve("base") = {1, 2};
Physical Curve("top")  = {9, 10};
