// The same with fewer edges.
n = 12;
m = 20;
g = 1.09;
Include "ring.geo";
