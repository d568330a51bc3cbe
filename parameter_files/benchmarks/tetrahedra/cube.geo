// A cube of 1 m; meshed by gmsh as it likes, or with structured = 1 in a grid
// whose cells are each cut into six tetrahedra. About 85 000 tetrahedra.
DefineConstant[ structured = 0, n_edges = 24 ];
h = structured ? 1 / n_edges : 0.87 / n_edges;
Point(1) = {0, 0, 0, h};
line() = Extrude {1, 0, 0} { Point{1}; Layers{1 / h}; };
side() = Extrude {0, 1, 0} { Line{line(1)}; Layers{1 / h}; };
If (structured)
  cube() = Extrude {0, 0, 1} { Surface{side(1)}; Layers{n_edges}; };
Else
  cube() = Extrude {0, 0, 1} { Surface{side(1)}; };
EndIf
Physical Volume("rock") = cube(1);
Physical Surface("right") = Surface In BoundingBox {0.99, -0.01, -0.01, 1.01, 1.01, 1.01};
Mesh.Algorithm3D = 10; // HXT
