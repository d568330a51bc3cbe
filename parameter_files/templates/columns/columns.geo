// Two free-standing columns of n drums each with a beam across, on a stiff floor;
// the origin is in the middle of the floor. Change the next six lines.
n = 4;             // drums of a column
width = 0.80;      // of a drum [m]
height = 1.00;     // of a drum [m]
distance = 3.00;   // between the axes of the columns [m]
beam = 0.60;       // height of the beam [m]
faces = 4;         // of each joint

left = -distance / 2 - width / 2;
right = distance / 2 + width / 2;
Point(1) = {2 * left, 0, 0};
Point(2) = {2 * left, -0.5, 0};
Point(3) = {2 * right, -0.5, 0};
Point(4) = {2 * right, 0, 0};
For c In {0 : 1}
  x = left + c * distance;
  For j In {0 : n}
    Point(100 + 50 * c + j) = {x, j * height, 0};
    Point(200 + 50 * c + j) = {x + width, j * height, 0};
    Line(100 + 50 * c + j) = {100 + 50 * c + j, 200 + 50 * c + j};
    joints[] += {100 + 50 * c + j};
  EndFor
  For j In {0 : n - 1}
    Line(300 + 50 * c + j) = {200 + 50 * c + j, 201 + 50 * c + j};
    Line(400 + 50 * c + j) = {101 + 50 * c + j, 100 + 50 * c + j};
    Curve Loop(10 + 50 * c + j) = {100 + 50 * c + j, 300 + 50 * c + j, -(101 + 50 * c + j), 400 + 50 * c + j};
    Plane Surface(10 + 50 * c + j) = {10 + 50 * c + j};
    sides[] += {300 + 50 * c + j, 400 + 50 * c + j};
    drums[] += {10 + 50 * c + j};
  EndFor
EndFor
Point(5) = {left, n * height + beam, 0};
Point(6) = {right, n * height + beam, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 250};
Line(5) = {150, 200};
Line(6) = {100, 1};
Curve Loop(1) = {1, 2, 3, 4, -150, 5, -100, 6};
Plane Surface(1) = {1};
Line(11) = {200 + n, 150 + n};
Line(12) = {250 + n, 6};
Line(13) = {6, 5};
Line(14) = {5, 100 + n};
Curve Loop(2) = {100 + n, 11, 150 + n, 12, 13, 14};
Plane Surface(2) = {2};
Transfinite Curve{joints[]} = faces + 1;
Transfinite Curve{sides[], 1 : 6, 11 : 14} = 2;

Physical Curve("joint") = {joints[]};
Physical Surface("drum") = {drums[]};
Physical Surface("beam") = {2};
Physical Surface("floor") = {1};
