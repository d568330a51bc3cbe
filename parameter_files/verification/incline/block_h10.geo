// Block of 10 m x 10 m on a plane of 40 degrees, touching with its two lower
// corners only.
slope = 40;
plane_start = -10;
plane_end = 50;
plane_depth = 10;
width = 10;
height = 10;
plane_edges = 1;
width_edges = 1;
height_edges = 1;
Include "../../../meshes/block_on_plane.geo";
