// The same out to 6.1 m.
b = 6.1;
Include "shell.geo";
