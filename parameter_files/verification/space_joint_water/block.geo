// The block and the base of space_incline with larger tetrahedra.
h = 0.5;
Include "../space_incline/incline.geo";
