// The box with edges of 0.036 m, more than 30 000 unknowns.
h = 0.036;
Include "patch.geo";
