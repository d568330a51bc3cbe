// The same with edges of half the length.
h = 0.125;
Include "ground.geo";
