// The block and its base with edges of 0.5 m.
h = 0.5;
Include "incline.geo";
