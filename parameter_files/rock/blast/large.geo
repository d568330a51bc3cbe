// The region with rock around it, of blocks alone.
beyond = 30;
Include "region.geo";
