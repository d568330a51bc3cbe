// The vertical cut with quadrangles of 1/8 m.
h = 1 / 8;
Include "cut.geo";
