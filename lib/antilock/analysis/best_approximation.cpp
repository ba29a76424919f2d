#include "antilock/analysis/best_approximation.hpp"

#include <algorithm>
#include <cmath>

#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/measure/residual.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

/// The same K_h, the form of a norm, and B v = 0 or no condition on B v.
void minimise_norm(VariationalInequality& problem, const SparseMatrix& norm, bool kernel) {
  problem.a1 = norm;
  problem.compliance = 0;
  for (double& g : problem.bounds.force_limit)  // what gives way is no part of K_h
    if (std::isfinite(g)) g = 0;
  if (kernel) return;
  problem.b.resize(0, problem.size());
  problem.m.resize(0);
  problem.fixed_compliances.resize(0);
}

}  // namespace

BestApproximation best_approximation(const Space& space, VariationalInequality problem,
                                     const Reference& u, AdmissibleSet within,
                                     const Eigen::VectorXd& functional) {
  problem = assemble_fixed_rows(std::move(problem));
  minimise_norm(problem, h1_gram_matrix(space), within == AdmissibleSet::k_0h);
  problem.load = h1_products(space, u);  // |u - v|_h^2 / 2 but for a constant
  if (functional.size() > 0) problem.load -= 0.5 * functional;
  Solution solution = active_set(problem);
  solution.p.resize(
      0);  // of the norm's problem: no stress, and of a projected form not one per triangle
  const double distance = measure_errors(space, solution, 1, u).h1;
  const double added = functional.size() > 0 ? functional.dot(solution.u) : 0;
  return {solution.u, distance, distance * distance + added};
}

double dual_norm(VariationalInequality problem, const SparseMatrix& norm,
                 const Eigen::VectorXd& functional, bool kernel) {
  problem = assemble_fixed_rows(std::move(problem));
  minimise_norm(problem, norm, kernel);
  problem.bounds = {};
  problem.dirichlet_values.setZero();
  problem.load = functional;
  return std::sqrt(std::max(0.0, functional.dot(active_set(problem).u)));
}

}  // namespace antilock
