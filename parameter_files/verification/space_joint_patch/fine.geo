// The box with edges of 0.1 m.
h = 0.1;
Include "patch.geo";
