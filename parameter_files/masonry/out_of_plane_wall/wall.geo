// A wall in running bond, x along it, y through it, z up; the load comes from
// y = 0. The nominal units meet on joints without thickness.
SetFactory("OpenCASCADE");
DefineConstant[ units = 5, courses = 8, faces = 2 ]; // faces of joints over the thickness
a = 0.24; t = 0.12; c = 0.1; e = 0.001;
length = units * a; height = courses * c;
n = 0;
For i In {0 : courses - 1}
  If (i % 2 == 0)
    For j In {0 : units - 1}
      n += 1;
      Box(n) = {j * a, 0, i * c, a, t, c};
    EndFor
  Else
    n += 1;
    Box(n) = {0, 0, i * c, a / 2, t, c};
    For j In {0 : units - 2}
      n += 1;
      Box(n) = {a / 2 + j * a, 0, i * c, a, t, c};
    EndFor
    n += 1;
    Box(n) = {length - a / 2, 0, i * c, a / 2, t, c};
  EndIf
EndFor
Coherence;
Physical Volume("unit") = Volume{:};
beds() = {};
For i In {1 : courses - 1}
  beds() += Surface In BoundingBox {-e, -e, i * c - e, length + e, t + e, i * c + e};
EndFor
Physical Surface("bed") = beds();
heads() = {};
For i In {0 : courses - 1}
  For j In {1 : 2 * units - 1}
    heads() += Surface In BoundingBox {j * a / 2 - e, -e, i * c - e, j * a / 2 + e, t + e, (i + 1) * c + e};
  EndFor
EndFor
Physical Surface("head") = heads();
Physical Surface("base") = Surface In BoundingBox {-e, -e, -e, length + e, t + e, e};
Physical Surface("top") = Surface In BoundingBox {-e, -e, height - e, length + e, t + e, height + e};
Physical Surface("front") = Surface In BoundingBox {-e, -e, -e, length + e, e, height + e};
Physical Surface("sides") = {Surface In BoundingBox {-e, -e, -e, e, t + e, height + e}, Surface In BoundingBox {length - e, -e, -e, length + e, t + e, height + e}};
Mesh.MeshSizeMin = t / faces;
Mesh.MeshSizeMax = t / faces;
