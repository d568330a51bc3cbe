// The box along the direction of askew.geo, cut by three joints, of the tetrahedra of
// askew_one_flat.geo.
n = 3;
g = 2;
Include "askew.geo";
