#include "antilock/solve/detail/tied.hpp"

#include <fmt/format.h>

#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/detail/tuned.hpp"

namespace antilock {
namespace {

Eigen::VectorXd scaled(Eigen::VectorXd bound, const Eigen::VectorXd& scale) {
  if (bound.size() > 0) bound.tail(scale.size()).array() *= scale.array();
  return bound;
}

}  // namespace

Tied::Tied(const VariationalInequality& problem) : problem_(problem) {
  const Eigen::Index n = problem.size(), rows = problem.b.rows(), ties = problem.combinations.rows();
  if (ties == 0) return;
  VariationalInequality& tied = made_.emplace(problem);
  tied.ties = static_cast<int>(ties);
  tied.combinations.resize(0, 0);
  tied.a1.conservativeResize(n + ties, n + ties);
  tied.load.conservativeResize(n + ties);
  tied.load.tail(ties).setZero();
  tied.m.conservativeResize(rows + ties);
  scale_.resize(ties);

  std::vector<char> fixed(n, 0);
  for (const int i : problem.fixed) fixed[i] = 1;
  Eigen::VectorXd stiffness = problem.a1.diagonal();
  stiffness += problem.b.cwiseAbs2().transpose() * problem.m / moderate_delta(problem);
  for (Eigen::Index j = 0; j < n; ++j)  // the tie would hide it from the factor but for round-off
    if (fixed[j] == 0 && !(stiffness(j) > 0))
      throw Error(
          fmt::format("solve: unknown {} is held by nothing: A1 and B' M B are 0 there; accepted: a matrix A1 + "
                      "B' M B that is positive definite on the free unknowns",
                      j));
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index row = 0; row < rows; ++row)
    for (RowMatrix::InnerIterator b(problem.b, row); b; ++b) entries.emplace_back(row, b.col(), b.value());
  for (Eigen::Index k = 0; k < ties; ++k) {
    double largest = 0, yields = 0;
    for (RowMatrix::InnerIterator c(problem.combinations, k); c; ++c) largest = std::max(largest, std::abs(c.value()));
    scale_(k) = std::ldexp(1, -std::ilogb(largest));
    for (RowMatrix::InnerIterator c(problem.combinations, k); c; ++c) {
      const double value = scale_(k) * c.value();
      entries.emplace_back(rows + k, c.col(), value);
      if (fixed[c.col()] == 0) yields += value * value / stiffness(c.col());
    }
    entries.emplace_back(rows + k, n + k, -1);
    tied.m(rows + k) = tuned::tie / yields;
    tied.contact.push_back(static_cast<int>(n + k));
  }
  tied.b.resize(rows + ties, n + ties);
  tied.b.setFromTriplets(entries.begin(), entries.end());
  tied.b.makeCompressed();
  tied.a1.makeCompressed();
  tied.lower = scaled(problem.lower, scale_);
  tied.upper = scaled(problem.upper, scale_);
  tied.force_bound = scaled(problem.force_bound, scale_.cwiseInverse());
}

Eigen::VectorXd Tied::forces(Eigen::VectorXd lambda) const { return scaled(std::move(lambda), scale_); }

}  // namespace antilock
