// A slope of 45 degrees.
DefineConstant[ h = 0.0625 ]; // size of the quadrangles
c = 1;
Include "slope.inc";
