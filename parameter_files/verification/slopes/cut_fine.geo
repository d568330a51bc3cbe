// The vertical cut with quadrangles of 1/44 m.
h = 1 / 44;
Include "cut.geo";
