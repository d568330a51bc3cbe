// The box with edges twice as long.
h = 0.4;
Include "box.geo";
