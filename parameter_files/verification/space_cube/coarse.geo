// The cube with half as many edges.
n = 10;
Include "cube.geo";
