// What the boundary elements surround.
Include "hole.geo";
Physical Curve("interface") = {30, 40, 31, 41, 32, 42, 33, 43};
