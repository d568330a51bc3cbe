// The cube of cube.geo in about 640 000 tetrahedra.
n_edges = 48;
Include "cube.geo";
