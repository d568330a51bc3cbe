// Two cubes, and a slab between two others: see README.md.
Include "frame.geo";

at = 0; below = 1;
Call Foot;
low[] = Extrude {n[0], n[1], n[2]} { Surface{foot}; Layers{2}; };
high[] = Extrude {n[0], n[1], n[2]} { Surface{low[0]}; Layers{2}; };
Physical Surface("bed") = {low[0]};
Physical Volume("low") = {low[1]};
Physical Volume("high") = {high[1]};

at = 1; below = 0;
Call Foot;
under[] = Extrude {0.1 * n[0], 0.1 * n[1], 0.1 * n[2]} { Surface{foot}; Layers{1}; };
slab[] = Extrude {0.2 * n[0], 0.2 * n[1], 0.2 * n[2]} { Surface{under[0]}; Layers{1}; };
over[] = Extrude {0.1 * n[0], 0.1 * n[1], 0.1 * n[2]} { Surface{slab[0]}; Layers{1}; };
Physical Surface("sides") = {under[0], slab[0]};
Physical Volume("slab") = {slab[1]};
Physical Volume("held") = {under[1], over[1]};
