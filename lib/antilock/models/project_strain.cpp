#include "antilock/models/project_strain.hpp"

#include <fmt/format.h>

#include <cmath>

#include "antilock/core/error.hpp"

namespace antilock {

double projected_class_parameter(double compliance, double exact_fraction) {
  if (!(exact_fraction >= 0 && exact_fraction < 1))
    throw Error(
        fmt::format("project_strain: exact_fraction = {}; accepted: 0 to below 1", exact_fraction));
  if (!(compliance >= 0 && exact_fraction * compliance < 1))
    throw Error(
        fmt::format("project_strain: compliance {} with exact_fraction = {}; accepted: 0 to below "
                    "1 / exact_fraction",
                    compliance, exact_fraction));
  return (1 - exact_fraction) * compliance / (1 - exact_fraction * compliance);
}

VariationalInequality project_strain(VariationalInequality problem,
                                     const StrainProjection& projection, double exact_fraction) {
  check(problem);
  problem.compliance = projected_class_parameter(problem.compliance, exact_fraction);
  if (exact_fraction > 0) {  // as a square: the sum is symmetric to the last digit
    RowMatrix root = problem.b;
    for (Eigen::Index r = 0; r < root.rows(); ++r)
      for (RowMatrix::InnerIterator entry(root, r); entry; ++entry)
        entry.valueRef() *= std::sqrt(exact_fraction * problem.m(r));
    problem.a1 += SparseMatrix(root.transpose() * root);
  }
  FactoredForm mean = project_strain({problem.b, (1 - exact_fraction) * problem.m, {}}, projection);
  problem.b.swap(mean.b);
  problem.m.swap(mean.m);
  return problem;
}

}  // namespace antilock
