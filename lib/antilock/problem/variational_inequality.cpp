#include "antilock/problem/variational_inequality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw Error("variational inequality: " + what);
}

/// 0 times a number is 0 unless the number is infinite or none: a sum, which is vectorised, in
/// place of a search.
bool finite(const double* values, Eigen::Index count) {
  return (0 * Eigen::Map<const Eigen::ArrayXd>(values, count)).sum() == 0;
}
bool finite(const Eigen::VectorXd& values) { return finite(values.data(), values.size()); }

/// The largest |a_ij - a_ji|, in one walk and without a copy of A1: while the columns pass in
/// order, the part of every column below its diagonal is met row by row. (Looking each partner up
/// takes 4 lines and a twentieth of a solve.)
double asymmetry(const SparseMatrix& a) {
  const int* const outer = a.outerIndexPtr();
  const int* const row = a.innerIndexPtr();
  const double* const value = a.valuePtr();
  std::vector<int> below(a.cols());
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    below[j] = static_cast<int>(
        std::upper_bound(row + outer[j], row + outer[j + 1], static_cast<int>(j)) - row);
  double largest = 0;
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    for (int k = outer[j]; k < outer[j + 1] && row[k] < j; ++k) {
      const int i = row[k];
      for (; below[i] < outer[i + 1] && row[below[i]] < j; ++below[i])  // entries without a partner
        largest = std::max(largest, std::abs(value[below[i]]));
      const bool partner = below[i] < outer[i + 1] && row[below[i]] == j;
      largest = std::max(largest, std::abs(value[k] - (partner ? value[below[i]++] : 0)));
    }
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    for (; below[j] < outer[j + 1]; ++below[j])
      largest = std::max(largest, std::abs(value[below[j]]));
  return largest;
}

void check_constraints(const VariationalInequality& problem) {
  const RowMatrix& rows = problem.bounds.constraints;
  if (rows.rows() == 0) return;
  require(rows.cols() == problem.size(),
          fmt::format("constraints have {} columns; accepted {}, one per unknown", rows.cols(),
                      problem.size()));
  require(rows.isCompressed(), "constraints are accepted compressed only");
  require(finite(rows.valuePtr(), rows.nonZeros()), "an entry of constraints is not finite");
  std::vector<char> fixed(problem.size(), 0);
  for (const int i : problem.dirichlet_dofs) fixed[i] = 1;
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    bool free = false;
    for (RowMatrix::InnerIterator c(rows, row); c; ++c)
      free = free || (c.value() != 0 && fixed[c.col()] == 0);
    require(free, fmt::format("constraint {} holds no free unknown; accepted: one or more", row));
  }
}

}  // namespace

void check_bounds(const VariationalInequality& problem) {
  check_constraints(problem);
  const Bounds& bounds = problem.bounds;
  const Eigen::VectorXd &lower = bounds.lower, &upper = bounds.upper, &limit = bounds.force_limit;
  const auto count = static_cast<Eigen::Index>(bounds.unknowns.size()) + bounds.constraints.rows();
  require(lower.size() == count,
          fmt::format(
              "lower has {} entries; accepted {}: one bound per contact unknown and per constraint",
              lower.size(), count));
  require(upper.size() == count,
          fmt::format("upper has {} entries; accepted {}, as in lower", upper.size(), count));
  require(limit.size() == count,
          fmt::format("force_limit has {} entries; accepted {}, as in lower", limit.size(), count));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < count; ++i) {
    const double low = lower(i);
    const double high = upper(i);
    const bool one_is_finite = std::isfinite(low) || std::isfinite(high);
    const bool is_interval = one_is_finite && low <= high;
    if (is_interval && limit(i) >= 0) continue;  // of many bounds: no message is formatted
    require(
        limit(i) >= 0,
        fmt::format("force_limit {} is {}; accepted: 0 or more, infinity for any", i, limit(i)));
    require(one_is_finite && low < infinity && high > -infinity,
            fmt::format("bound {} is not finite: from {} to {}; accepted: one finite side or two, "
                        "-infinity below "
                        "or infinity above for none",
                        i, low, high));
    require(
        low <= high,
        fmt::format("bound {} is from {} to {}; accepted: lower <= upper, equal for an equation", i,
                    low, high));
  }
}

void check_data(const VariationalInequality& problem) {
  const Eigen::Index n = problem.load.size(), rows = problem.b.rows();
  require(n > 0, "no unknowns");
  require(problem.a1.rows() == n && problem.a1.cols() == n,
          fmt::format("a1 is {} x {}; accepted {} x {}, as the load says", problem.a1.rows(),
                      problem.a1.cols(), n, n));
  require(problem.b.cols() == n && problem.m.size() == rows,
          fmt::format("B is {} x {} and M has {} entries; accepted R x {} and R", rows,
                      problem.b.cols(), problem.m.size(), n));
  require(problem.a1.isCompressed() && problem.b.isCompressed(),
          "a1 and B are accepted compressed only");
  require(finite(problem.a1.valuePtr(), problem.a1.nonZeros()) &&
              finite(problem.b.valuePtr(), problem.b.nonZeros()) && finite(problem.m) &&
              finite(problem.load) && finite(problem.dirichlet_values),
          "an entry is not finite");
  require(rows == 0 || problem.m.minCoeff() > 0, "M is not positive");
  require(problem.compliance >= 0 && std::isfinite(problem.compliance),
          fmt::format("compliance = {}; accepted: a finite number, 0 or more", problem.compliance));
  const Eigen::VectorXd& own = problem.fixed_compliances;
  require(own.size() <= rows,
          fmt::format("fixed_compliances has {} entries; accepted: {} at most, one per row of B",
                      own.size(), rows));
  require(own.size() == 0 || (own.allFinite() && own.minCoeff() >= 0),
          "a fixed compliance is negative or not finite; accepted: 0 or more");
  require(
      problem.dirichlet_values.size() == static_cast<Eigen::Index>(problem.dirichlet_dofs.size()),
      "one value per fixed unknown is needed");
  std::vector<char> taken(n, 0);
  for (const std::vector<int>* list : {&problem.dirichlet_dofs, &problem.bounds.unknowns})
    for (const int i : *list) {
      require(i >= 0 && i < n,
              fmt::format("unknown {} is out of range; accepted 0 to {}", i, n - 1));
      require(!taken[i], fmt::format("unknown {} is fixed or bounded twice", i));
      taken[i] = 1;
    }
  check_bounds(problem);
  require(problem.free_count() > 0, "every unknown is fixed; accepted: one free unknown or more");
}

void append_rows(VariationalInequality& problem, const RowMatrix& b, const Eigen::VectorXd& m,
                 const Eigen::VectorXd& fixed_compliances) {
  RowMatrix all(problem.b.rows() + b.rows(), b.cols());
  all.reserve(problem.b.nonZeros() + b.nonZeros());
  for (const RowMatrix* part : {static_cast<const RowMatrix*>(&problem.b), &b})
    for (Eigen::Index row = 0; row < part->rows(); ++row) {
      all.startVec(row + (part == &b ? problem.b.rows() : 0));
      for (RowMatrix::InnerIterator entry(*part, row); entry; ++entry)
        all.insertBack(row + (part == &b ? problem.b.rows() : 0), entry.col()) = entry.value();
    }
  all.finalize();
  const auto append = [](Eigen::VectorXd& to, const Eigen::VectorXd& more) {
    to.conservativeResize(to.size() + more.size());
    to.tail(more.size()) = more;
  };
  problem.b.swap(all);
  append(problem.m, m);
  append(problem.fixed_compliances, fixed_compliances);
}

VariationalInequality assemble_fixed_rows(VariationalInequality problem) {
  if ((problem.fixed_compliances.array() == 0).all()) return problem;
  const Eigen::Index first = problem.parametric_row_count();
  const Eigen::VectorXd own = std::exchange(problem.fixed_compliances, {}), m = problem.m;
  const RowMatrix b = problem.b;
  problem.b = b.topRows(first);
  problem.m = m.head(first);
  for (Eigen::Index k = 0; k < own.size(); ++k) {
    const RowMatrix row = b.middleRows(first + k, 1);
    if (own(k) == 0) append_rows(problem, row, m.segment(first + k, 1), own.segment(k, 1));
  }
  // as a square: the sum is symmetric to the last digit
  RowMatrix root = b.bottomRows(own.size());
  for (Eigen::Index k = 0; k < own.size(); ++k)
    for (RowMatrix::InnerIterator entry(root, k); entry; ++entry)
      entry.valueRef() *= own(k) > 0 ? std::sqrt(m(first + k) / own(k)) : 0;
  problem.a1 += SparseMatrix(root.transpose() * root);
  problem.a1.makeCompressed();
  return problem;
}

void check(const VariationalInequality& problem) {
  check_data(problem);
  // Relative to the largest entry: what assembly leaves is round-off of the sums.
  const double largest = problem.a1.nonZeros() > 0 ? problem.a1.coeffs().abs().maxCoeff() : 0;
  require(asymmetry(problem.a1) <= 1e-12 * largest, "a1 is not symmetric");
}

void set_dirichlet(VariationalInequality& problem, const std::map<int, double>& values) {
  problem.dirichlet_dofs.clear();
  problem.dirichlet_values.resize(static_cast<Eigen::Index>(values.size()));
  for (const auto& [unknown, value] : values) {
    problem.dirichlet_values(static_cast<Eigen::Index>(problem.dirichlet_dofs.size())) = value;
    problem.dirichlet_dofs.push_back(unknown);
  }
}

VariationalInequality equality_constrained(VariationalInequality problem,
                                           const std::vector<bool>& active) {
  const Bounds bounds = std::exchange(problem.bounds, {});
  require_lower_bounds(bounds, "equality_constrained");
  if (active.size() != bounds.unknowns.size())
    throw Error(fmt::format("equality_constrained: {} marks; accepted: {}, one per contact unknown",
                            active.size(), bounds.unknowns.size()));
  std::map<int, double> fixed;
  for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i)
    fixed[problem.dirichlet_dofs[i]] = problem.dirichlet_values(static_cast<Eigen::Index>(i));
  for (std::size_t i = 0; i < active.size(); ++i)
    if (active[i]) fixed[bounds.unknowns[i]] = bounds.lower(static_cast<Eigen::Index>(i));
  set_dirichlet(problem, fixed);
  return problem;
}

}  // namespace antilock
