w = 3;
Include "cavity.geo";
