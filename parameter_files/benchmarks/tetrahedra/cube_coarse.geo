// The cube of cube.geo, for tetrahedra that are each cut into eight.
n_edges = 24;
Include "cube.geo";
