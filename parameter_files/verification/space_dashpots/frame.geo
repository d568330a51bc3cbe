// A stack of cuboids of 1 m x 1 m of tetrahedra, out of the axes: layers are normal to
// n = (2, 3, 6)/7, sides along s = (3, -6, 2)/7 and t = (6, 2, -3)/7.
n[] = {2 / 7, 3 / 7, 6 / 7};
s[] = {3 / 7, -6 / 7, 2 / 7};
t[] = {6 / 7, 2 / 7, -3 / 7};

// Surface "foot" of stack number "at", 3 m from the next along s, at "below" m under the origin.
Macro Foot
  p = newp;
  For i In {0 : 3}
    a = 3 * at + (i == 1 || i == 2);
    b = i >= 2;
    Point(p + i) = {a * s[0] + b * t[0] - below * n[0], a * s[1] + b * t[1] - below * n[1], a * s[2] + b * t[2] - below * n[2]};
  EndFor
  l = newl;
  For i In {0 : 3}
    Line(l + i) = {p + i, p + (i + 1) % 4};
  EndFor
  Transfinite Curve{l : l + 3} = 3;
  Curve Loop(newll) = {l : l + 3};
  foot = news;
  Plane Surface(foot) = {newll - 1};
  Transfinite Surface{foot} Alternate;
Return
