// A quarter of a ring, radii 1 and 5 m.
n = 32;   // edges along the wall
m = 36;   // and from the wall outwards,
g = 1.06; // each so much longer than the one before
Include "../salencon/ring.geo";
