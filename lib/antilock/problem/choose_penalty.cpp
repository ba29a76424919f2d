#include "antilock/problem/choose_penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"

namespace antilock {

// Why default_penalty is 6e-8. Let sigma be the smallest nonzero eigenvalue of a0 against a1. A
// correction multiplies the error by about delta / (delta + sigma). sigma falls with the mesh width
// h, like h^2 in the layer and like h^4 in a beam, so that delta must not be too large. Round-off
// in the factor changes a correction by about 0.005 eps / (h^2 delta) of itself, so that delta must
// not be too small either. With s = 1 and 1/h = 64 there are 2 corrections from 6e-8 down to 1e-9,
// 3 at 1e-10 and 5 at 1e-12: 6e-8 leaves room for finer meshes. In the beam, where the ratio of the
// traces is far below that of the maxima, 6e-11 on 512 cells took 3 corrections but 19 contact
// iterations, 6e-10 takes 6 and 13, 1e-8 took 20 and 9.
//
// Corrections measured with contact, the most over the compliances 1 to 1e-12 and 0: in the layer
// with 1/h = 8 to 128: P1 2, CR 2, locked P1 4 (with 1e-6 in place of 6e-8: 4, 4, 20); in the beam
// with 512 cells 6, with 1024 cells 12 (locked, where all of u tends to 0).

double StiffnessRatio::value() const {
  const double s = std::cbrt(trace_a0 / trace_a1) * std::pow(std::cbrt(max_a0 / max_a1), 2);
  return std::isfinite(s) && s > 0 ? s : 1;
}

StiffnessRatio stiffness_ratio(const VariationalInequality& problem) {
  Eigen::VectorXd a1 = problem.a1.diagonal(), a0 = problem.b.cwiseAbs2().transpose() * problem.m;
  for (const int i : problem.dirichlet_dofs) a0(i) = a1(i) = 0;
  const Eigen::VectorXd both = (a0.array() > 0 && a1.array() > 0).cast<double>();
  return {a0.dot(both), a1.dot(both), a0.maxCoeff(), std::max(0.0, a1.maxCoeff())};
}

double penalty_parameter(const VariationalInequality& problem, std::optional<double> penalty) {
  if (penalty && !(*penalty > 0 && std::isfinite(*penalty)))
    throw Error(fmt::format("solve: penalty = {}; accepted: a positive number", *penalty));
  const bool only_fixed_rows = problem.parametric_row_count() == 0 && problem.b.rows() > 0;
  const double compliance = only_fixed_rows ? 0 : problem.compliance;
  return std::max(compliance, penalty ? *penalty : choose_penalty(problem));
}

}  // namespace antilock
