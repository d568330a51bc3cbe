// Block of 1 m x 2 m cut by a joint at 45 degrees through its centre. The
// middle 0.54 m of the joint can slip (crack), the rest cannot (bridges).
DefineConstant[h = 0.08];

W = 1;
H = 2;
l = 0.54;
d = l / 2 / Sqrt(2);

Point(1) = {0, 0, 0, h};
Point(2) = {W, 0, 0, h};
Point(3) = {W, H / 2 + W / 2, 0, h};
Point(4) = {W, H, 0, h};
Point(5) = {0, H, 0, h};
Point(6) = {0, H / 2 - W / 2, 0, h};
Point(7) = {W / 2 - d, H / 2 - d, 0, h / 2};
Point(8) = {W / 2 + d, H / 2 + d, 0, h / 2};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {6, 7};
Line(8) = {7, 8};
Line(9) = {8, 3};

Curve Loop(1) = {1, 2, -9, -8, -7, 6};
Plane Surface(1) = {1};
Curve Loop(2) = {3, 4, 5, 7, 8, 9};
Plane Surface(2) = {2};

Physical Curve("bottom") = {1};
Physical Curve("top") = {4};
Physical Curve("crack") = {8};
Physical Curve("bridges") = {7, 9};
Physical Surface("rock") = {1, 2};
