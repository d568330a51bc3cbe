// The crack with edges of 0.04 m, more than 30 000 unknowns.
h = 0.04;
Include "crack.geo";
