#pragma once
// The answers to the exercises of 29_pressure, whose page includes this one: to be read
// after predicting.
#include "antilock/core/error.hpp"

const std::vector<tutorial::Exercise> exercises{
    {"Hold the sides of the rubber block too. What becomes of beta while the groove of the "
     "obstacle fills up, and what "
     "of the solution at 1/lambda = 0 after that?",
     "beta falls, for MINI from 0.18 to 0.07 at 99 % of the groove. Once all of the bottom "
     "is held it is 0 for each "
     "method, because no displacement sees the constant pressure. A block that is pushed "
     "further has no solution, and "
     "the solver says so",
     [](const tutorial::Options&, tutorial::Report& report) {
       constexpr int n = 8;
       const Space space(structured_mesh(n, Domain{0}),
                         p1_bubble());  // the sides are clamped, and move with the top
       VariationalInequality problem =
           tutorial::rubber({"MINI", "", p1_bubble(), true}, space);
       // The mean of div u is 0, so that the bottom sinks by the push on average. It can
       // sink by the groove:
       const double groove = -problem.bounds.lower.sum() / (n - 1);
       const auto push = [&](double share) {
         for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i)
           if (problem.dirichlet_dofs[i] >= space.size())
             problem.dirichlet_values(static_cast<Eigen::Index>(i)) = -share * groove;
         return active_set(problem);
       };
       std::vector<double> beta;
       for (const double share : {0.1, 0.5, 0.9, 0.99}) {
         const VariationalInequality held =
             equality_constrained(problem, push(share).active);
         beta.push_back(
             inf_sup(multiplier_gram(held, held.a1), Eigen::MatrixXd(held.m.asDiagonal())));
         fmt::print("pushed by {:.0f} % of the groove: beta = {:.4f}\n", 100 * share,
                    beta.back());
       }
       const VariationalInequality full = equality_constrained(
           problem, std::vector<bool>(problem.bounds.unknowns.size(), true));
       const double last =
           inf_sup(multiplier_gram(full, full.a1), Eigen::MatrixXd(full.m.asDiagonal()));
       report.claim(beta[3] < 0.5 * beta[0] && last == 0,
                    "beta falls from {:.3f} to {:.3f}, with all held {:.0f}", beta[0],
                    beta[3], last);
       try {
         push(1.01);
         report.claim(false, "pushed by 101 % of the groove: a solution");
       } catch (const NotConverged& refused) {
         report.claim(true, "pushed by 101 % of the groove: {}", refused.what());
       }
     }}};

// ## Answers on paper
//
// **2.** On a triangle $\operatorname{div} Π v_h$ is constant, and so is
// $\operatorname{div} v_h$. By Gauss' theorem each is the sum of the three fluxes over
// $|T|$. The normal component of $Π v_h$ is constant on each edge and the same from both
// sides, so by parts on every triangle the terms on inner edges cancel. On the boundary
// either $ψ = 0$ or $v_h$ has no flux. What is left is $-(ψ, \operatorname{div} v_h)$,
// which is 0 for those $v_h$ that keep the volume of every triangle.
//
// **3.** Let $p = λ \operatorname{div} u$. Then
// $a_1(u, v) + (p + ψ, \operatorname{div} v) = 0$ for all $v$. With $v = u$ this is
// $a_1(u, u) + ‖p‖^2/λ = -(ψ, p)/λ$, so $‖p‖ ≤ ‖ψ‖$. Measure $v$ by
// $‖v‖^2 = a_1(v, v)$. By the inf-sup constant some $v ≠ 0$ has
// $β ‖p + ψ‖ ‖v‖ ≤ (p + ψ, \operatorname{div} v) = -a_1(u, v) ≤ ‖u‖ ‖v‖$, so
// $‖p + ψ‖ ≤ ‖u‖/β$. Once more with $v = u$:
// $‖u‖^2 = -(p + ψ, p)/λ ≤ ‖u‖ ‖ψ‖/(β λ)$. So $‖u‖ ≤ ‖ψ‖/(β λ)$.
