// notch.geo, wider by 32 m on all four sides: of the same mesh about the notch.
o = 32;
Include "notch.geo";
