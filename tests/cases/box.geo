// The box of space_oblique_waves, of tetrahedra of 2.4 m.
Include "../../parameter_files/verification/space_oblique_waves/box.geo";
Mesh.MeshSizeMin = 2.4;
Mesh.MeshSizeMax = 2.4;
