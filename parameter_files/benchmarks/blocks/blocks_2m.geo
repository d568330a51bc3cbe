// Two million triangles in 3969 blocks.
n_blocks = 63;
n_edges  = 15;
Include "blocks.geo";
