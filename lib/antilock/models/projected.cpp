#include "antilock/models/projected.hpp"

#include <fmt/format.h>

#include <cmath>

#include "antilock/core/error.hpp"

namespace antilock {

double projected_compliance(double compliance, double kept) {
  if (!(kept >= 0 && kept < 1)) throw Error(fmt::format("projected: kept = {}; accepted: 0 to below 1", kept));
  if (!(compliance >= 0 && kept * compliance < 1))
    throw Error(
        fmt::format("projected: compliance {} with kept = {}; accepted: 0 to below 1 / kept", compliance, kept));
  return (1 - kept) * compliance / (1 - kept * compliance);
}

VariationalInequality projected(VariationalInequality problem, const Shares& shares, double kept) {
  check(problem);
  problem.compliance = projected_compliance(problem.compliance, kept);
  if (kept > 0) {  // as a square: the sum is symmetric to the last digit
    RowMatrix root = problem.b;
    for (Eigen::Index r = 0; r < root.rows(); ++r)
      for (RowMatrix::InnerIterator entry(root, r); entry; ++entry) entry.valueRef() *= std::sqrt(kept * problem.m(r));
    problem.a1 += SparseMatrix(root.transpose() * root);
  }
  FactoredForm mean = averaged({problem.b, (1 - kept) * problem.m, {}}, shares);
  problem.b.swap(mean.b);
  problem.m.swap(mean.m);
  return problem;
}

}  // namespace antilock
