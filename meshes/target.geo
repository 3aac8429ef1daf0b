// SPDX-License-Identifier: LGPL-2.1-or-later
// A quarter of a disc of two materials, mm: a steel core of radius 5 in copper
// of radius 12, 6 thick, made of hexahedra by extrusion. The groups of cells are
// called as the materials.
r = 5; q = 2.5; R = 12; t = 6; c = Sqrt(.5);
Point(1) = {0, 0, 0};
Point(2) = {q, 0, 0};
Point(3) = {q * .95, q * .95, 0};
Point(4) = {0, q, 0};
Point(5) = {r, 0, 0};
Point(6) = {r * c, r * c, 0};
Point(7) = {0, r, 0};
Point(8) = {R, 0, 0};
Point(9) = {R * c, R * c, 0};
Point(10) = {0, R, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {2, 5};
Circle(6) = {5, 1, 6};
Line(7) = {3, 6};
Circle(8) = {6, 1, 7};
Line(9) = {4, 7};
Line(10) = {5, 8};
Circle(11) = {8, 1, 9};
Line(12) = {6, 9};
Circle(13) = {9, 1, 10};
Line(14) = {7, 10};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6, -7, -2};
Curve Loop(3) = {7, 8, -9, -3};
Curve Loop(4) = {10, 11, -12, -6};
Curve Loop(5) = {12, 13, -14, -8};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Plane Surface(4) = {4};
Plane Surface(5) = {5};
Transfinite Curve{1, 2, 3, 4, 6, 8, 11, 13} = 4;
Transfinite Curve{5, 7, 9} = 3;
Transfinite Curve{10, 12, 14} = 6;
Transfinite Surface{1, 2, 3, 4, 5};
Recombine Surface{1, 2, 3, 4, 5};
v[] = Extrude {0, 0, t} { Surface{1, 2, 3, 4, 5}; Layers{5}; Recombine; };
// an extruded surface gives its top, its volume and a side for each edge
Physical Volume("steel-4340", 1) = {v[1], v[7], v[13]};
Physical Volume("copper-ofhc", 2) = {v[19], v[25]};
Physical Surface("back", 11) = {1, 2, 3, 4, 5};
Physical Surface("front", 12) = {v[0], v[6], v[12], v[18], v[24]};
Physical Surface("rim", 13) = {v[21], v[27]};
Physical Surface("seam", 14) = {v[9], v[15]};
