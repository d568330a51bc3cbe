// The vertical cut with quadrangles of 1/48 m.
h = 1 / 48;
Include "cut.geo";
