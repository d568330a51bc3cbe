// The box along the direction of askew_three.geo, cut by one joint, of tetrahedra that
// are four times as wide across it as long: a plane wave does not vary there.
dx = -0.36;
dy = 0.48;
dz = 0.8;
g  = 2;
Include "askew.geo";
