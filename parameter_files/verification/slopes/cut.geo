// A vertical cut.
DefineConstant[ h = 0.0625 ]; // size of the quadrangles
c = 0;
Include "slope.inc";
