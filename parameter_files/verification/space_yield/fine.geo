// The cube with edges of 0.12 m.
h = 0.12;
Include "cube.geo";
