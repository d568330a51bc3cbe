// The cube with edges from 0.14 m on.
h = 0.14;
Include "cube.geo";
