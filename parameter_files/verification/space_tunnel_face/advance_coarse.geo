// The tunnel of advance.geo with edges from 0.16 m on.
h = 0.16;
Include "advance.geo";
