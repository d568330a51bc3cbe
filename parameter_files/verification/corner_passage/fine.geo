// The same with a slider of three edges a side.
slider_edges = 3;
Include "corner_passage.geo";
