// Seven blocks on others: see README.md.
Include "frame.geo";

// Block "low" of "below" m and block "high" of "above" m with the joint "bed" between them.
Macro Stack
  Call Foot;
  lower[] = Extrude {below * n[0], below * n[1], below * n[2]} { Surface{foot}; Layers{Ceil(below / 0.5)}; };
  upper[] = Extrude {above * n[0], above * n[1], above * n[2]} { Surface{lower[0]}; Layers{Ceil(above / 0.5)}; };
  Physical Surface(StrCat("bed ", name)) = {lower[0]};
  Physical Volume(StrCat("low ", name)) = {lower[1]};
  Physical Volume(StrCat("high ", name)) = {upper[1]};
Return

at = 0; name = "0.2"; below = 1; above = 1;
Call Stack;
at = 1; name = "0.5";
Call Stack;
at = 2; name = "0.8";
Call Stack;
at = 3; name = "heavy";
Call Stack;
at = 4; name = "wall"; below = 0.1;
Call Stack;
at = 5; name = "slides"; above = 0.04;
Call Stack;
at = 6; name = "sticks";
Call Stack;
