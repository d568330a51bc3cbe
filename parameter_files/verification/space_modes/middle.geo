// The block with two thirds of the edges.
n = 2;
Include "block.geo";
