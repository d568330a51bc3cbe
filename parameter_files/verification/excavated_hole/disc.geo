// The ring of the case kirsch, and what is taken out of its hole. Each sector
// of the disc has the edges of the ring along its arc.
Include "../kirsch/ring.geo";
Curve Loop(100) = {10:17};
Plane Surface(100) = {100};
Physical Surface("core") = {100};
Mesh.MeshSizeMin = 0.1;
Mesh.MeshSizeMax = 0.3;
