// Tilt 0.5 of the angle of slenderness, edges of 0.25 m.
ratio = 0.5;
n = 4;
Include "block.geo";
