// The same with edges of 2.5 m on edges of 4.3 m.
slope = 20;
plane_start = -10;
plane_end = 20;
plane_depth = 10;
width = 10;
height = 5;
plane_edges = 7;
width_edges = 4;
height_edges = 2;
Include "../../../meshes/block_on_plane.geo";
