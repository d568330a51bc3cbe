// Tilt 0.3 of the angle of slenderness.
ratio = 0.3;
n = 1;
Include "block.geo";
