// The region with rock around it, of blocks alone.
beyond = 45;
Include "region.geo";
