// Tilt 0.5 of the angle of slenderness.
ratio = 0.5;
n = 1;
Include "block.geo";
