// Block of 10 m x 5 m on a plane of 40 degrees; edges of 2.5 m on edges of
// 3.5 m, so that vertices of both sides pass each other.
slope = 40;
plane_start = -10;
plane_end = 50;
plane_depth = 10;
width = 10;
height = 5;
plane_edges = 17;
width_edges = 4;
height_edges = 2;
Include "../../../meshes/block_on_plane.geo";
