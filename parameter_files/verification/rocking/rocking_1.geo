// Tilt 0.1 of the angle of slenderness.
ratio = 0.1;
n = 1;
Include "block.geo";
