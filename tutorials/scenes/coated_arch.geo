// An arch with a round hole: the body alone. Its feet are clamped, its inner curve is contact, the rest is free.
// gmsh -2 coated_arch.geo -o coated_arch.msh
SetFactory("OpenCASCADE");
h = 0.06;
Rectangle(1) = {0, 0, 0, 2, 1};
Disk(2) = {1, 0, 0, 0.6, 0.6};
Disk(3) = {1.7, 0.6, 0, 0.15, 0.15};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2, 3}; Delete; };
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
Mesh.MshFileVersion = 2.2;
feet() = Curve In BoundingBox{-0.01, -0.001, -1, 2.01, 0.001, 1};
top() = Curve In BoundingBox{-0.01, 0.999, -1, 2.01, 1.001, 1};
hole() = Curve In BoundingBox{1.5, 0.4, -1, 1.9, 0.8, 1};
left() = Curve In BoundingBox{-0.001, -0.01, -1, 0.001, 1.01, 1};
right() = Curve In BoundingBox{1.999, -0.01, -1, 2.001, 1.01, 1};
arch() = Curve In BoundingBox{0.39, -0.001, -1, 1.61, 0.61, 1};
arch() -= feet();
Physical Surface("body") = {4};
Physical Curve("contact") = {arch()};
Physical Curve("clamped") = {feet()};
Physical Curve("flanks") = {hole(), left(), right()};
Physical Curve("top") = {top()};
