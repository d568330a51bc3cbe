// The box in another direction, cut by three joints.
dx = -0.36;
dy = 0.48;
dz = 0.8;
n  = 3;
Include "askew.geo";
