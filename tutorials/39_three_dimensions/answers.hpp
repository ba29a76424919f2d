#pragma once
// The answers to the exercises of 39_three_dimensions, whose page includes this one: to be
// read after predicting.
#include "antilock/mesh/layered.hpp"

/// Returns the share of the energy that P1 keeps at epsilon = 1e-2 on a mesh in space.
double share_kept(const Mesh& mesh) {
  const Space space(mesh, affine);
  const VariationalInequality problem = assemble(free_scene(1e-2), space);
  const ReleasedEnergy released(space, problem);
  return released.of(problem, active_set(problem)) /
         released_by(ExactWithoutObstacle(1e-2));
}

const std::vector<tutorial::Exercise> exercises{
    {"Write the function family_mesh for a fourth family: gmsh's tetrahedra in the body, "
     "and "
     "below each face of Sigma a prism cut into tetrahedra, layered_mesh(8, 1, "
     "tetrahedra). "
     "How many groups has its layer, and how much does P1 keep at epsilon = 1e-2?",
     "one group below each face of Sigma, k = 0, and all is kept, up to the error of the "
     "coarse mesh",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Mesh mesh = layered_mesh(8, 1, tetrahedra);
       const int groups = layer_components(mesh).count;
       report.claim(groups == tutorial::layer_faces(mesh).sigma,
                    "{} groups, as many as faces of Sigma (proved)", groups);
       report.claim_within(tutorial::bending_length_in_space(mesh), 0, 1e-12,
                           "bending length (proved: 0):");
       report.claim_within(share_kept(mesh), 0.9, 1.3, "kept (observed):");
     }},
    {"Move the inner vertices of the structured mesh up and down only. How many functions "
     "without strain are left of (n - 1)^2, and does P1 lock?",
     "all of them, and it does not lock: seen from above nothing has moved, so that each "
     "vertical edge is still vertical",
     [](const tutorial::Options&, tutorial::Report& report) {
       Mesh mesh = family_mesh("structured", 6);
       mesh.vertices.col(2) = family_mesh("jittered", 6).vertices.col(2);
       const int kernel =
           layer_kernel_dimension(assemble(free_scene(0), Space(mesh, affine)));
       report.claim(kernel == 25, "1/h = 6: {} of 25 functions (proved)", kernel);
       report.claim_within(share_kept(mesh), 0.9, 1.3, "kept (observed):");
     }},
    {"P2 on gmsh's mesh. In the plane one parabola without strain is left in the layer "
     "(chapter 07). How many functions are left in space, and from which degree on is "
     "there "
     "one?",
     "none: a polynomial of x and y that is 0 on the four sides contains the factor "
     "x (1 - x) y (1 - y), so that the degree must be 4 at least",
     [](const tutorial::Options&, tutorial::Report& report) {
       for (const int n : {3, 4}) {
         const Space space(family_mesh("unstructured", n), p2(tetrahedra));
         const int groups = layer_components(space.mesh()).count;
         const int kernel = layer_kernel_dimension(assemble(free_scene(0), space));
         report.claim(groups == 1 && kernel == 0,
                      "1/h = {}: {} group, {} functions without strain (proved: 0)", n,
                      groups, kernel);
       }
     }}};

// ## Answers on paper
//
// **4.** A vertex moves by $t$ times a fixed vector. To first order in $t$ the $p_i$ change
// by a multiple of $t$, and $Q_T$, which is 0 at $t = 0$, is a multiple of $t$. So $k$ is
// halved, and ρ falls to a quarter. Half of the energy is kept at half of the ε.
