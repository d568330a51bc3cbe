// The cut with edges of 1/4 m.
h = 1 / 4;
Include "cut.geo";
