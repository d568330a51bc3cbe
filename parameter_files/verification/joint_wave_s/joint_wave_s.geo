// The column of the case joint_wave_p.
h = 1;
Include "../joint_wave_p/joint_wave_p.geo";
