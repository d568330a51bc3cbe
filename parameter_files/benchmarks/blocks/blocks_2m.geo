// 3136 blocks of 44 triangles, two million triangles with 'Refinements = 2' in
// section 'Mesh'.
n_blocks = 56;
n_edges  = 4;
Include "blocks.geo";
