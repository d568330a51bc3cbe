// The column, finer.
h = 0.5;
Include "column.geo";
