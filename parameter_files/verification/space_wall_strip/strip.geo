// A strip of wall of n courses: 0.24 m long, 0.12 m thick, 2.4 m high; the load
// comes from y = 0.
SetFactory("OpenCASCADE");
DefineConstant[ n = 16, faces = 2 ]; // courses, faces of joints over the thickness
b = 0.24; t = 0.12; h = 2.4; c = h / n;
For i In {0 : n - 1}
  Box(i + 1) = {0, 0, i * c, b, t, c};
EndFor
Coherence;
Physical Volume("unit") = Volume{:};
e = 0.001;
beds() = {};
For i In {1 : n - 1}
  beds() += Surface In BoundingBox {-e, -e, i * c - e, b + e, t + e, i * c + e};
EndFor
Physical Surface("bed") = beds();
Physical Surface("base") = Surface In BoundingBox {-e, -e, -e, b + e, t + e, e};
Physical Surface("head") = Surface In BoundingBox {-e, -e, h - e, b + e, t + e, h + e};
Physical Surface("front") = Surface In BoundingBox {-e, -e, -e, b + e, e, h + e};
Physical Surface("ends") = {Surface In BoundingBox {-e, -e, -e, e, t + e, h + e}, Surface In BoundingBox {b - e, -e, -e, b + e, t + e, h + e}};
Mesh.MeshSizeMin = t / faces;
Mesh.MeshSizeMax = t / faces;
