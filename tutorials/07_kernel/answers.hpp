#pragma once

// The answers to the exercises of 07_kernel, whose page includes this one: to be read after
// predicting.

const std::vector<tutorial::Exercise> exercises{
    {"The staggered mesh of chapter 02 is as regular as the others. The kernel on its "
     "layer, for P1 and for CR?",
     "P1: 0. CR: N_T / 2, as on each mesh with as many edges on the two sides of the layer "
     "as on its top and bottom",
     [](const tutorial::Options&, tutorial::Report& report) {
       const TriangleMesh mesh = mesh_family("staggered").mesh(8);
       const auto triangles = static_cast<double>(
           std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
       report.claim_within(layer_kernel_dimension(assemble(scene, Space(mesh, p1()))), 0, 0,
                           "P1:");
       report.claim_within(
           layer_kernel_dimension(assemble(scene, Space(mesh, crouzeix_raviart()))) /
               triangles,
           0.5, 0.5, "CR, per triangle:");
     }},
    {"epsilon = 0 and vertices moved by a millionth of h. How much of the displacement is "
     "lost?",
     "all: a kernel is 0 or it is not, and at epsilon = 0 nothing else counts",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Space space(jittered_mesh(8, 1e-6), p1());
       ActiveSetOptions patient;
       patient.corrections.max_corrections = 100000;
       const Solution solution = active_set(assemble(scene, space), patient);
       report.claim_within(solution.u(space.contact_dofs()).maxCoeff() / 0.0457160, 0, 1e-3,
                           "share that is kept:");
     }}};

// ## Answers on paper
//
// **3.** On one group $∂_y v = 0$ leaves one polynomial of degree 3 in $x$ for all
// triangles. It is 0 at both ends, so it is $x (1 - x)(a + b x)$: two functions, $x(1 - x)$
// and $x^2 (1 - x)$. For degree $p$ there are $p - 1$ (chapter 16 counts them).
