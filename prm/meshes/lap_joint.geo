// A bolted lap joint, cut by its plane of symmetry y = 0: two plates with a hole and a bolt
// between head and nut. Lengths in mm. All cells are hexahedra: each surface is meshed with
// quadrilaterals between four sides (Transfinite, Recombine) and extruded in layers.
//
//   gmsh -3 lap_joint.geo -o lap_joint.msh
//   gmsh -3 -setnumber fine 2 lap_joint.geo -o lap_joint_fine.msh      half the cell size

DefineConstant[ fine = 1 ];

thickness = 3;     // of each plate
width     = 10;    // half of it
hole      = 4.4;   // radius
shank     = 4;     // radius of the bolt
head      = 8;     // radius of head and nut
height    = 3;     // of head and nut
overlap   = 0.004; // by which head and nut are too near to each other, each: the clamping

around  = 6 * fine;  // cells along an eighth of a circle and along half of the width
radial  = 5 * fine;  // from the hole to the edge of the plate
along   = 7 * fine;  // over the free part of a plate
short   = fine;  // over the part beyond the hole
through = 2 * fine;  // over the thickness of a plate

// Half of a plate at the height z: three blocks around the hole and one on either side, the
// longer one on the side `side` (-1 left, 1 right). Sets surfaces[].
Macro Plate
  p = newp;
  Point(p)      = {0, 0, z};
  Point(p + 1)  = {hole, 0, z};
  Point(p + 2)  = {hole * Cos(Pi / 4), hole * Sin(Pi / 4), z};
  Point(p + 3)  = {-hole * Cos(Pi / 4), hole * Sin(Pi / 4), z};
  Point(p + 4)  = {-hole, 0, z};
  Point(p + 5)  = {width, 0, z};
  Point(p + 6)  = {width, width, z};
  Point(p + 7)  = {-width, width, z};
  Point(p + 8)  = {-width, 0, z};
  Point(p + 9)  = {side * 45, 0, z};
  Point(p + 10) = {side * 45, width, z};
  Point(p + 11) = {-side * 15, 0, z};
  Point(p + 12) = {-side * 15, width, z};
  near = (side > 0) ? 5 : 8; // corners of the square on the longer side ...
  far  = (side > 0) ? 8 : 5; // ... and on the shorter one
  c = newl;
  Circle(c)     = {p + 1, p, p + 2};
  Circle(c + 1) = {p + 2, p, p + 3};
  Circle(c + 2) = {p + 3, p, p + 4};
  Line(c + 3)  = {p + 5, p + 6};
  Line(c + 4)  = {p + 6, p + 7};
  Line(c + 5)  = {p + 7, p + 8};
  Line(c + 6)  = {p + 1, p + 5};
  Line(c + 7)  = {p + 2, p + 6};
  Line(c + 8)  = {p + 3, p + 7};
  Line(c + 9)  = {p + 4, p + 8};
  Line(c + 10) = {p + near, p + 9};
  Line(c + 11) = {p + 9, p + 10};
  Line(c + 12) = {p + 10, p + ((side > 0) ? 6 : 7)};
  Line(c + 13) = {p + far, p + 11};
  Line(c + 14) = {p + 11, p + 12};
  Line(c + 15) = {p + 12, p + ((side > 0) ? 7 : 6)};
  s = news;
  Curve Loop(s)     = {c + 6, c + 3, -(c + 7), -c};
  Curve Loop(s + 1) = {c + 7, c + 4, -(c + 8), -(c + 1)};
  Curve Loop(s + 2) = {c + 8, c + 5, -(c + 9), -(c + 2)};
  If (side > 0)
    Curve Loop(s + 3) = {c + 10, c + 11, c + 12, -(c + 3)};
    Curve Loop(s + 4) = {c + 13, c + 14, c + 15, c + 5};
  Else
    Curve Loop(s + 3) = {c + 10, c + 11, c + 12, c + 5};
    Curve Loop(s + 4) = {c + 13, c + 14, c + 15, -(c + 3)};
  EndIf
  surfaces[] = {};
  For k In {0:4}
    Plane Surface(s + k) = {s + k};
    surfaces[] += {s + k};
  EndFor
  Transfinite Curve {c, c + 2, c + 3, c + 5, c + 11, c + 14} = around + 1;
  Transfinite Curve {c + 1, c + 4} = 2 * around + 1;
  Transfinite Curve {c + 6, c + 7, c + 8, c + 9} = radial + 1;
  Transfinite Curve {c + 10, c + 12} = along + 1;
  Transfinite Curve {c + 13, c + 15} = short + 1;
  Transfinite Surface {surfaces[]};
  Recombine Surface {surfaces[]};
Return

// Half of a disc at the height z, four blocks of the shank and, if rim = 1, three of the rim.
Macro Disc
  p = newp;
  core = 0.5 * shank;
  Point(p)     = {0, 0, z};
  Point(p + 1) = {core, 0, z};
  Point(p + 2) = {0.85 * core, 0.85 * core, z};
  Point(p + 3) = {-0.85 * core, 0.85 * core, z};
  Point(p + 4) = {-core, 0, z};
  For k In {0:1}
    r = (k == 0) ? shank : head;
    Point(p + 5 + 4 * k) = {r, 0, z};
    Point(p + 6 + 4 * k) = {r * Cos(Pi / 4), r * Sin(Pi / 4), z};
    Point(p + 7 + 4 * k) = {-r * Cos(Pi / 4), r * Sin(Pi / 4), z};
    Point(p + 8 + 4 * k) = {-r, 0, z};
  EndFor
  c = newl;
  Line(c)     = {p + 1, p + 2};
  Line(c + 1) = {p + 2, p + 3};
  Line(c + 2) = {p + 3, p + 4};
  Line(c + 3) = {p + 4, p + 1};
  For k In {0:1}
    For i In {0:2}
      Circle(c + 4 + 7 * k + i) = {p + 5 + 4 * k + i, p, p + 6 + 4 * k + i};
    EndFor
    For i In {0:3}
      Line(c + 7 + 7 * k + i) = {p + 1 + 4 * k + i, p + 5 + 4 * k + i};
    EndFor
  EndFor
  s = news;
  Curve Loop(s) = {c, c + 1, c + 2, c + 3};
  Plane Surface(s) = {s};
  surfaces[] = {s};
  rims[] = {};
  For k In {0:1}
    For i In {0:2}
      t = s + 1 + 3 * k + i;
      inner = (k == 0) ? c + i : c + 4 + i;
      Curve Loop(t) = {c + 7 + 7 * k + i, c + 4 + 7 * k + i, -(c + 8 + 7 * k + i), -inner};
      Plane Surface(t) = {t};
      If (k == 0)
        surfaces[] += {t};
      Else
        rims[] += {t};
      EndIf
    EndFor
  EndFor
  Transfinite Curve {c, c + 2, c + 4, c + 6, c + 11, c + 13} = around / 2 + 1;
  Transfinite Curve {c + 1, c + 3, c + 5, c + 12} = around + 1;
  Transfinite Curve {c + 7, c + 8, c + 9, c + 10} = 2 * fine + 1;
  Transfinite Curve {c + 14, c + 15, c + 16, c + 17} = 3 * fine + 1;
  Transfinite Surface {surfaces[], rims[]};
  Recombine Surface {surfaces[], rims[]};
Return

z = 0; side = -1;
Call Plate;
lower[] = Extrude {0, 0, thickness} { Surface{surfaces[]}; Layers{through}; Recombine; };
lower_bottom[] = surfaces[];

// The upper plate is made somewhere else and moved to its place in the end: Gmsh would join
// points of the two plates that coincide, but bodies share no nodes.
z = 100; side = 1;
Call Plate;
upper[] = Extrude {0, 0, thickness} { Surface{surfaces[]}; Layers{through}; Recombine; };
upper_bottom[] = surfaces[];

// The bolt is three extrusions of the whole disc; of the one in the middle the rim is left out.
z = overlap;
Call Disc;
nut[]    = Extrude {0, 0, -height} { Surface{surfaces[], rims[]}; Layers{2 * fine}; Recombine; };
middle[] = Extrude {0, 0, 2 * thickness - 2 * overlap} { Surface{surfaces[], rims[]}; Layers{4 * fine}; Recombine; };
tops[] = {};
For k In {0:6}
  tops[] += {middle[6 * k]};
EndFor
top[] = Extrude {0, 0, height} { Surface{tops[]}; Layers{2 * fine}; Recombine; };

Geometry.AutoCoherence = 0;
Translate {0, 0, thickness - 100} { Volume{upper[1], upper[7], upper[13], upper[19], upper[25]}; }

// An extrusion of a surface with four sides gives: its other end, the volume, four sides.
Physical Volume("lower plate") = {lower[1], lower[7], lower[13], lower[19], lower[25]};
Physical Volume("upper plate") = {upper[1], upper[7], upper[13], upper[19], upper[25]};
bolt[] = {};
For k In {0:6}
  bolt[] += {nut[6 * k + 1], top[6 * k + 1]};
EndFor
For k In {0:3}
  bolt[] += {middle[6 * k + 1]};
EndFor
Physical Volume("bolt") = {bolt[]};

e = 1e-3;
Physical Surface("lower bottom") = {lower_bottom[]};
Physical Surface("lower top")    = {lower[0], lower[6], lower[12], lower[18], lower[24]};
Physical Surface("left")         = Surface In BoundingBox {-45 - e, -e, -e, -45 + e, width + e, thickness + e};
Physical Surface("upper bottom") = {upper_bottom[]};
Physical Surface("upper top")    = {upper[0], upper[6], upper[12], upper[18], upper[24]};
Physical Surface("right")        = Surface In BoundingBox {45 - e, -e, thickness - e, 45 + e, width + e, 2 * thickness + e};
Physical Surface("under nut")    = {rims[]};
Physical Surface("under head")   = {tops[4], tops[5], tops[6]};
Physical Surface("cut")          = Surface In BoundingBox {-45 - e, -e, -height - e, 45 + e, e, 2 * thickness + height + e};
