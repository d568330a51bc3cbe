// A slope of 60 degrees.
DefineConstant[ h = 0.0625 ]; // size of the quadrangles
c = 0.57735;
Include "slope.inc";
