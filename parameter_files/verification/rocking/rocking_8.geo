// Tilt 0.8 of the angle of slenderness.
ratio = 0.8;
n = 1;
Include "block.geo";
