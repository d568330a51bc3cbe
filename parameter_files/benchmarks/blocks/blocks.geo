// Square blocks of 1 m, apart from each other, n_blocks x n_blocks of them with
// n_edges edges on each side. Defaults: 100 blocks, about 100 000 triangles.
If (!Exists(n_blocks))
  n_blocks = 10;
EndIf
If (!Exists(n_edges))
  n_edges = 21;
EndIf
Mesh.Algorithm = 6; // frontal

h = 1 / n_edges;
faces[] = {};
lines[] = {};
For j In {0:n_blocks-1}
  For i In {0:n_blocks-1}
    x = 1.1 * i;
    y = 1.1 * j;
    p = newp;
    Point(p)     = {x, y, 0, h};
    Point(p + 1) = {x + 1, y, 0, h};
    Point(p + 2) = {x + 1, y + 1, 0, h};
    Point(p + 3) = {x, y + 1, 0, h};
    c = newc;
    Line(c)     = {p, p + 1};
    Line(c + 1) = {p + 1, p + 2};
    Line(c + 2) = {p + 2, p + 3};
    Line(c + 3) = {p + 3, p};
    l = newll;
    Curve Loop(l) = {c, c + 1, c + 2, c + 3};
    s = news;
    Plane Surface(s) = {l};
    faces[] += s;
    lines[] += c + 1;
  EndFor
EndFor
Physical Surface("rock") = faces[];
Physical Curve("right")  = lines[];
