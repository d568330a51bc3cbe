// The same column with a mesh size of 2 m.
h = 2;
Include "joint_wave_p.geo";
