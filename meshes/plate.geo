// SPDX-License-Identifier: LGPL-2.1-or-later
// A quarter of a plate with a hole, mm: hole radius 5, plate 100 x 100.
a = 5; w = 100; c = Sqrt(.5);
Point(1) = {0, 0, 0};
Point(2) = {a, 0, 0};
Point(3) = {a * c, a * c, 0};
Point(4) = {0, a, 0};
Point(5) = {w, 0, 0};
Point(6) = {w, w, 0};
Point(7) = {0, w, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Line(3) = {2, 5};
Line(4) = {5, 6};
Line(5) = {3, 6};
Line(6) = {6, 7};
Line(7) = {4, 7};
Curve Loop(1) = {3, 4, -5, -1};
Curve Loop(2) = {5, 6, -7, -2};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve{1, 2, 4, 6} = 13;
Transfinite Curve{3, 5, 7} = 25 Using Progression 1.165;
Transfinite Surface{1, 2};
Recombine Surface{1, 2};
Physical Curve("hole", 1) = {1, 2};
Physical Curve("right", 2) = {4};
Physical Curve("top", 3) = {6};
Physical Surface("plate", 4) = {1, 2};
