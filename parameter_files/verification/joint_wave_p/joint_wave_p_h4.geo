// The same column with a mesh size of 4 m.
h = 4;
Include "joint_wave_p.geo";
