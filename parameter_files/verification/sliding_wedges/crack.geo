// A rigid block on a plane of 35 degrees, before a tension crack 9 m behind the toe.
h = 1;
foot = 5 + 9 * Tan(35 * Pi / 180);
Point(1) = {10, 5, 0, h};     Point(2) = {19, foot, 0, h};
Point(3) = {19, 15, 0, h};    Point(4) = {10 + 10 / Sqrt(3), 15, 0, h};
Point(5) = {5, 5, 0, h};      Point(6) = {5, 2, 0, h};
Point(7) = {26, 2, 0, h};     Point(8) = {26, 15, 0, h};

Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Line(5) = {1, 5};  Line(6) = {5, 6};  Line(7) = {6, 7};  Line(8) = {7, 8};
Line(9) = {8, 3};

Curve Loop(1) = {1, 2, 3, 4};                   Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8, 9, -2, -1};        Plane Surface(2) = {2};
Physical Surface("block") = {1};
Physical Surface("base")  = {2};
Physical Curve("plane")   = {1};
Physical Curve("crack")   = {2};
