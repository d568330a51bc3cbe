// A slope of 45 degrees.
DefineConstant[ h = 1 / 24 ]; // size of the quadrangles
c = 1;
Include "slope.inc";
