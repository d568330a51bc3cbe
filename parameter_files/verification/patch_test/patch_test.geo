// Unit square cut by three straight joints: a and b cross, c cuts a corner.
// None of them reaches the bottom. Unstructured.
DefineConstant[h = 0.1];

// a: (0, 0.25) - (1, 0.45); b: (0, 0.8) - (1, 0.3); c: (0.35, 1) - (1, 0.55)
// crossing of a and b
xc = 0.55 / 0.7;
yc = 0.25 + 0.2 * xc;

Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};
Point(3) = {1, 0.3, 0, h};
Point(4) = {1, 0.45, 0, h};
Point(5) = {1, 0.55, 0, h};
Point(6) = {1, 1, 0, h};
Point(7) = {0.35, 1, 0, h};
Point(8) = {0, 1, 0, h};
Point(9) = {0, 0.8, 0, h};
Point(10) = {0, 0.25, 0, h};
Point(11) = {xc, yc, 0, h};

For i In {1 : 9}
  Line(i) = {i, i + 1};
EndFor
Line(10) = {10, 1};
Line(11) = {10, 11};
Line(12) = {11, 4};
Line(13) = {9, 11};
Line(14) = {11, 3};
Line(15) = {7, 5};

Curve Loop(1) = {1, 2, -14, -11, 10};
Plane Surface(1) = {1};
Curve Loop(2) = {14, 3, -12};
Plane Surface(2) = {2};
Curve Loop(3) = {11, -13, 9};
Plane Surface(3) = {3};
Curve Loop(4) = {12, 4, -15, 7, 8, 13};
Plane Surface(4) = {4};
Curve Loop(5) = {15, 5, 6};
Plane Surface(5) = {5};

Physical Curve("bottom") = {1};
Physical Curve("right") = {2, 3, 4, 5};
Physical Curve("top") = {6, 7};
Physical Curve("left") = {8, 9, 10};
Physical Curve("a") = {11, 12};
Physical Curve("b") = {13, 14};
Physical Curve("c") = {15};
Physical Surface("rock") = {1 : 5};
