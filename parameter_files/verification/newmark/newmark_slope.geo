// Block of 2 m x 1 m on a base that falls to the right by 5 degrees.
slope = 5;
plane_start = -6;
plane_end = 8;
plane_depth = 1;
width = 2;
height = 1;
plane_edges = 13;
width_edges = 2;
height_edges = 1;
Include "../../../meshes/block_on_plane.geo";
