// An L over the line y = 0, cells of 1/10, finer at the re-entrant corner; the scaled layer below its bottom edge.
Point(1) = {0, 0, 0, 1/10};  Point(2) = {2, 0, 0, 1/10};   Point(3) = {2, 0.5, 0, 1/10};
Point(4) = {1, 0.5, 0, 1/40}; Point(5) = {1, 1.5, 0, 1/10}; Point(6) = {0, 1.5, 0, 1/10};
Point(7) = {0, -1, 0, 1/10}; Point(8) = {2, -1, 0, 1/10};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Line(7) = {7, 8}; Line(8) = {8, 2}; Line(9) = {1, 7};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};  Plane Surface(1) = {1};
Curve Loop(2) = {7, 8, -1, 9};       Plane Surface(2) = {2};
Physical Curve("sigma", 3) = {1};
Physical Curve("clamped", 4) = {2, 3, 4, 5, 6, 8, 9};
Physical Curve("contact", 5) = {7};
Physical Surface("body", 1) = {1};
Physical Surface("layer", 2) = {2};
