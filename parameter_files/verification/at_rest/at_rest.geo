// Block of 10 m x 5 m on a plane of 20 degrees, touching with its two lower
// corners.
slope = 20;
plane_start = -10;
plane_end = 20;
plane_depth = 10;
width = 10;
height = 5;
plane_edges = 1;
width_edges = 1;
height_edges = 1;
Include "../../../meshes/block_on_plane.geo";
