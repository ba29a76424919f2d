#pragma once
// The answers to the exercises of 25_beam, whose page includes this one: to be read after
// predicting.

const auto bent = [](double load, double gap) {
  return active_set(assemble(Beam{.cells = 64, .epsilon = 1e-4, .load = load, .gap = gap}));
};
const std::vector<tutorial::Exercise> exercises{
    {"Double the load. Do deflection, force and contact double? And if the gap doubles "
     "with it?",
     "load alone: no, K is no cone, contact starts at 2^(-1/4) c or so; load and gap: w "
     "and force double, the "
     "contact set stays",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Solution one = bent(5832, 1), load = bent(2 * 5832, 1),
                      both = bent(2 * 5832, 2);
       report.claim_within((both.u - 2 * one.u).norm() / one.u.norm(), 0, 1e-9,
                           "load and gap: u - 2 u, relative");
       report.claim(both.active == one.active, "load and gap: the same contact set");
       const double c = ExactBeam({.epsilon = 1e-4, .load = 2 * 5832}).contact_start() /
                        ExactBeam({.epsilon = 1e-4}).contact_start();
       report.claim_within(c, 0.98 * std::pow(2, -0.25), 1.02 * std::pow(2, -0.25),
                           "load alone: c changes by the factor");
       report.claim(load.lambda.sum() > 2.05 * one.lambda.sum(),
                    "load alone: the force is {:.3f} times as large",
                    load.lambda.sum() / one.lambda.sum());
     }},
    {"How many cells does full integration need at epsilon = 1e-4 to be 1 % too stiff?",
     "h^2 / (12 epsilon) = 0.01: h = 1/289",
     [](const tutorial::Options&, tutorial::Report& report) {
       const VariationalInequality full =
           assemble(Beam{.cells = 289, .epsilon = 1e-4, .shear = ShearIntegration::full});
       VariationalInequality reduced = assemble(Beam{.cells = 289, .epsilon = 1e-4});
       reduced.a1 *= 1.01;
       report.claim_within(
           (active_set(full).u - active_set(reduced).u).cwiseAbs().maxCoeff(), 0, 1e-4,
           "difference from 1 % more stiffness");
     }}};

// ## Answers on paper
//
// **3.** For constant loads, on cells of one length $h$: the pairs $(w + b, θ)$ of this
// page are the $V_h$, and $a_0$ is exact on them. On a cell with midpoint $x_m$:
// $b' = θ' (x - x_m)$, so $b = ½ θ' ((x - x_m)^2 - h^2/4)$ and
// $∫ b = ½ θ' (h^3/12 - h^3/4) = -h^3 θ'/12$. The load's work on all $b$ is $q h^2/12$
// times the sum of $h θ'$ over the cells. This sum is $θ(1) - θ(0) = 0$, by the clamps.
