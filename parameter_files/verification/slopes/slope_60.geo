// A slope of 60 degrees.
DefineConstant[ h = 1 / 24 ]; // size of the quadrangles
c = 0.57735;
Include "slope.inc";
