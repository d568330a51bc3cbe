// The block with a third of the edges.
n = 1;
Include "block.geo";
