#pragma once
// The answers to the exercises of 32_coating, whose page includes this one: to be read
// after predicting.

#include "antilock/analysis/kernel.hpp"

/// By how much the coating becomes longer: the mean of u_x over it.
double stretch(const VectorSpace& space, const Solution& solution) {
  const FactoredForm along = strain_form_factored(space, {{{1, 0, 0, 0}}}, Region::layer);
  return along.m.dot(along.b * solution.u);
}

const std::vector<tutorial::Exercise> exercises{
    {"Drop the completed square: three rows, and 2 mu u_x^2 in a1. How much further does "
     "the coating stretch at t = 0 "
     "than "
     "at t = 1e-6?",
     "1.36 times, less than 1.43 times: the membrane has the modulus 2 mu in place of one "
     "that is 1.43 times as large, "
     "and "
     "the block bears a part; with the square completed it is the same at both",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Space cr(with_free_sides(unstructured_mesh(16)), crouzeix_raviart());
       const VectorSpace space{cr, cr};
       const auto plain = [&](double t) {
         VariationalInequality problem = assemble(coating(t), space);
         const Lame layer = coating(t).layer;
         Eigen::Matrix4d soft = Eigen::Matrix4d::Zero();
         soft(0, 0) = 2 * layer.mu;
         problem.a1 =
             strain_form(space, coating(t).body.matrix(), soft) + jump_form(space, 1);
         const FactoredForm rows = strain_form_factored(space,
                                                        {{{t, 0, 0, 1}, layer.lambda},
                                                         {{0, 0, 0, 1}, 2 * layer.mu},
                                                         {{0, 1, t, 0}, layer.mu}},
                                                        Region::layer);
         problem.b = rows.b;
         problem.m = rows.m;
         return stretch(space, active_set(problem));
       };
       const double ratio = plain(0) / plain(1e-6),
                    same = stretch(space, pressed(space, 0)) /
                           stretch(space, pressed(space, 1e-6));
       report.claim_within(ratio, 1.2, 1.43,
                           "stretch at t = 0 over that at 1e-6, three rows");
       report.claim(std::abs(same - 1) < 1e-4, "with the square completed: {:.6f}", same);
     }},
    {"CR / P1 at 1/h = 8 and 16: how does dim G_h grow, and how many independent motions "
     "of the bounds are in it?",
     "like the number of triangles. Of the bounds two on both meshes: v may be 1 or x and "
     "nothing else, and all that "
     "grows are motions of u",
     [](const tutorial::Options&, tutorial::Report& report) {
       const auto limit = [](int n) {
         const Space x(with_free_sides(unstructured_mesh(n)), crouzeix_raviart()),
             y(x, p1());
         return assemble(coating(0), {x, y});
       };
       const VariationalInequality coarse = limit(8), fine = limit(16);
       const LockingDiagnosis found = diagnose_locking(coarse, fine);
       const int from = kernel_dimension(coarse), to = kernel_dimension(fine);
       report.claim(to > 3 * from, "dim G_h: {}, then {}", from, to);
       report.claim(found.fine <= 2 && found.coarse <= 2,
                    "motions of the bounds: {} of {}, then {} of {}", found.coarse,
                    found.coarse_bounds, found.fine, found.fine_bounds);
     }},
    {"Press P1 in columns at t = 1e-4, 1e-5, 1e-6 with the usual penalty. How do the "
     "corrections grow?",
     "to 16, 29, 39: each correction brings in t^2/delta of what is left. That they stay "
     "so few is due to mixing the "
     "last six iterates (Anderson) and to a smaller penalty after 15. With delta = t^2 "
     "they are 2, 3, 6",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Space x(with_free_sides(structured_mesh(16)), p1());
       std::vector<int> usual, ours;
       for (const double t : {1e-4, 1e-5, 1e-6}) {
         usual.push_back(active_set(assemble(coating(t), {x, x})).counters.corrections);
         ours.push_back(pressed({x, x}, t).counters.corrections);
       }
       report.claim(usual[2] > usual[0] && usual[2] > 3 * ours[2],
                    "corrections with the usual penalty: {}, {}, {}; with t^2: {}, {}, {}",
                    usual[0], usual[1], usual[2], ours[0], ours[1], ours[2]);
     }}};

// ## Answers on paper
//
// **4.** A column is cut into pairs of triangles. The two triangles on the two sides of a
// vertical edge have that edge in common, and $v_Y$ is the slope along it: the same in
// both. But they lie in different columns, and $u_x$ is the slope of $u$ there: different
// on the two sides of a kink. No $v$ makes $v_Y = -r u_x$ in both. What is left costs
// $(λ + 2μ) r^2$ times the squared deviation from the mean, of order $h^2$ for a smooth
// $u$.
