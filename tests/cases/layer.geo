// The layer of space_free_field_sides, of tetrahedra of 2 m.
h = 2;
Include "../../parameter_files/verification/space_free_field_sides/layer.geo";
