// The same shell for mixed tetrahedra, whose edges are half as long as these.
Include "shell.geo";
Field[1].F = "0.17 * (1 + 2.6 * Fabs(Sqrt(x*x + y*y + z*z) - 1))";
