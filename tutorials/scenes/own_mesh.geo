// Body and scaled layer of figure 2, cells of 1/6 at the top and 1/24 on the contact side.
Point(1) = {0, -1, 0, 1/24}; Point(2) = {1, -1, 0, 1/24};
Point(3) = {0, 0, 0, 1/12};  Point(4) = {1, 0, 0, 1/12};
Point(5) = {0, 1, 0, 1/6};   Point(6) = {1, 1, 0, 1/6};
Line(1) = {1, 2}; Line(2) = {2, 4}; Line(3) = {4, 6}; Line(4) = {6, 5}; Line(5) = {5, 3}; Line(6) = {3, 1};
Line(7) = {3, 4};
Curve Loop(1) = {7, 3, 4, 5};  Plane Surface(1) = {1};
Curve Loop(2) = {1, 2, -7, 6}; Plane Surface(2) = {2};
Physical Curve("sigma", 3) = {7};
Physical Curve("clamped", 4) = {2, 3, 4, 5, 6};
Physical Curve("contact", 5) = {1};
Physical Surface("body", 1) = {1};
Physical Surface("layer", 2) = {2};
