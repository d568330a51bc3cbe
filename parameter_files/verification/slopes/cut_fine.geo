// The vertical cut with quadrangles of half the size.
h = 0.03125;
Include "cut.geo";
