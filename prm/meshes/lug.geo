// Half of a lug (an eye with a shank), cut by its plane of symmetry y = 0 and at half its thickness, z = 0.
// Hexahedra of 20 nodes, whose edges lie on the circles. Lengths in mm.
//
//   gmsh -3 lug.geo -o lug.msh

hole = 10; outer = 20; length = 50; thickness = 4;
around = 4;  // cells along an eighth of the hole
radial = 4; along = 3; through = 2;

Point(1) = {0, 0, 0};
Point(2) = {-hole, 0, 0};
Point(3) = {0, hole, 0};
Point(4) = {hole, 0, 0};
Point(5) = {-outer, 0, 0};
Point(6) = {0, outer, 0};
Point(7) = {outer, outer, 0};
Point(8) = {outer, 0, 0};
Point(9) = {length, outer, 0};
Point(10) = {length, 0, 0};
Point(11) = {hole * Cos(Pi / 4), hole * Sin(Pi / 4), 0};

Circle(1) = {2, 1, 3};  Circle(2) = {3, 1, 11}; Circle(3) = {11, 1, 4};
Circle(4) = {5, 1, 6};  Line(5) = {6, 7};       Line(6) = {7, 8};
Line(7) = {2, 5}; Line(8) = {3, 6}; Line(9) = {11, 7}; Line(10) = {4, 8};
Line(11) = {7, 9}; Line(12) = {9, 10}; Line(13) = {8, 10};

Curve Loop(1) = {7, 4, -8, -1};   Plane Surface(1) = {1};
Curve Loop(2) = {8, 5, -9, -2};   Plane Surface(2) = {2};
Curve Loop(3) = {9, 6, -10, -3};  Plane Surface(3) = {3};
Curve Loop(4) = {-6, 11, 12, -13}; Plane Surface(4) = {4};

Transfinite Curve {1, 4} = 2 * around + 1;
Transfinite Curve {2, 3, 5, 6, 12} = around + 1;
Transfinite Curve {7, 8, 9, 10} = radial + 1;
Transfinite Curve {11, 13} = along + 1;
Transfinite Surface {1, 2, 3, 4};
Recombine Surface {1, 2, 3, 4};

e1[] = Extrude {0, 0, thickness} { Surface{1}; Layers{through}; Recombine; };
e2[] = Extrude {0, 0, thickness} { Surface{2}; Layers{through}; Recombine; };
e3[] = Extrude {0, 0, thickness} { Surface{3}; Layers{through}; Recombine; };
e4[] = Extrude {0, 0, thickness} { Surface{4}; Layers{through}; Recombine; };

// The sides of an extruded surface follow its curves.
Physical Volume("lug")    = {e1[1], e2[1], e3[1], e4[1]};
Physical Surface("hole")  = {e1[5], e2[5], e3[5]};
Physical Surface("cut")   = {e1[2], e3[4], e4[5]};
Physical Surface("end")   = {e4[4]};
Physical Surface("middle") = {1, 2, 3, 4};

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1; // 20 nodes, not 27
Mesh.MshFileVersion = 4.1;
