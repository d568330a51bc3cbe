// The bar with edges of 0.2 m.
h = 0.2;
Include "bar.geo";
