// The domain of Figure 2, coarse. gmsh wrote the fixtures beside this file from it:
//   gmsh -2 -format msh22 two_squares.geo -o two_squares_22.msh
//   gmsh -2 -format msh41 two_squares.geo -o two_squares_41.msh
h = 0.5;
Point(1) = {0, 0, 0, h};  Point(2) = {1, 0, 0, h};  Point(3) = {1, 1, 0, h};
Point(4) = {0, 1, 0, h};  Point(5) = {0, -1, 0, h}; Point(6) = {1, -1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {1, 5}; Line(6) = {5, 6}; Line(7) = {6, 2};
Curve Loop(1) = {1, 2, 3, 4};   Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -1};  Plane Surface(2) = {2};
Physical Curve("sigma", 3) = {1};
Physical Curve("clamped", 4) = {2, 3, 4, 5, 7};
Physical Curve("contact", 5) = {6};
Physical Surface("body", 1) = {1};
Physical Surface("layer", 2) = {2};
