// A layer of 40 m x 36 m, 20 m high along z, with a notch of 8 m x 8 m, 8 m deep in its surface, of
// tetrahedra of 2 m; wider by o on all four sides.
DefineConstant[ o = 0, h = 2 ];
x() = {-20 - o, -2, 6, 20 + o};
y() = {-18 - o, -4, 4, 18 + o};
For j In {0 : 3}
  For i In {0 : 3}
    Point(1 + i + 4 * j) = {x(i), y(j), -20};
  EndFor
EndFor
For j In {0 : 3}
  For i In {0 : 2}
    Line(1 + i + 3 * j) = {1 + i + 4 * j, 2 + i + 4 * j};
    Transfinite Curve{1 + i + 3 * j} = (x(i + 1) - x(i)) / h + 1;
    Line(21 + j + 4 * i) = {1 + j + 4 * i, 5 + j + 4 * i};
    Transfinite Curve{21 + j + 4 * i} = (y(i + 1) - y(i)) / h + 1;
  EndFor
EndFor
For j In {0 : 2}
  For i In {0 : 2}
    k = 1 + i + 3 * j;
    Curve Loop(k) = {k, 22 + i + 4 * j, -(k + 3), -(21 + i + 4 * j)};
    Plane Surface(k) = {k};
    Transfinite Surface{k} Alternate;
    low() = Extrude {0, 0, 12} { Surface{k}; Layers{12 / h}; };
    rock() += low(1);
    For side In {2 : 5}
      walls() += low(side);
    EndFor
    If (k != 5)
      high() = Extrude {0, 0, 8} { Surface{low(0)}; Layers{8 / h}; };
      rock() += high(1);
      For side In {2 : 5}
        walls() += high(side);
      EndFor
    EndIf
  EndFor
EndFor
d = 0.01;
Physical Volume("rock") = rock();
Physical Surface("base") = {1 : 9};
Physical Surface("west") = Surface In BoundingBox {x(0) - d, y(0) - d, -20 - d, x(0) + d, y(3) + d, d};
Physical Surface("east") = Surface In BoundingBox {x(3) - d, y(0) - d, -20 - d, x(3) + d, y(3) + d, d};
Physical Surface("south") = Surface In BoundingBox {x(0) - d, y(0) - d, -20 - d, x(3) + d, y(0) + d, d};
Physical Surface("north") = Surface In BoundingBox {x(0) - d, y(3) - d, -20 - d, x(3) + d, y(3) + d, d};
