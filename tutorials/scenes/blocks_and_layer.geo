// Two bodies: a block with the scaled layer below it, and a finer block below that, which is not
// connected to it.
// gmsh -2 -format msh22 blocks_and_layer.geo -o two_bodies.msh
h = 0.12; k = 0.09;
Point(1) = {0, 1, 0, h};   Point(2) = {1, 1, 0, h};
Point(3) = {0, 0, 0, h};   Point(4) = {1, 0, 0, h};
Point(5) = {0, -1, 0, h};  Point(6) = {1, -1, 0, h};
Line(1) = {2, 1}; Line(2) = {1, 3}; Line(3) = {3, 4}; Line(4) = {4, 2};
Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4};   Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -3};  Plane Surface(2) = {2};
Point(11) = {0, -1, 0, k}; Point(12) = {1, -1, 0, k};
Point(13) = {0, -2, 0, k}; Point(14) = {1, -2, 0, k};
Line(11) = {12, 11}; Line(12) = {11, 13}; Line(13) = {13, 14}; Line(14) = {14, 12};
Curve Loop(11) = {11, 12, 13, 14}; Plane Surface(11) = {11};
Physical Surface("body", 1) = {1, 11};
Physical Surface("layer", 2) = {2};
Physical Curve("sigma", 3) = {3};
Physical Curve("clamped", 4) = {1, 2, 4, 5, 7, 12, 13, 14};
Physical Curve("below the layer", 5) = {6};
Physical Curve("top of the block", 6) = {11};
