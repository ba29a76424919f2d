// A block of two materials, x < 1/2 and x > 1/2: the sides clamped, the top in a group of its own.
// gmsh -2 two_blocks.geo -o two_materials.msh
h = 0.08;
Point(1) = {0, 0, 0, h};   Point(2) = {0.5, 0, 0, h}; Point(3) = {1, 0, 0, h};
Point(4) = {1, 1, 0, h};   Point(5) = {0.5, 1, 0, h}; Point(6) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6};  Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2};
Mesh.MshFileVersion = 2.2;
Physical Surface("left") = {1};
Physical Surface("right") = {2};
Physical Curve("contact") = {1, 2};
Physical Curve("clamped") = {3, 6};
Physical Curve("top") = {4, 5};
