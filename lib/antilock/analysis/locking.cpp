#include "antilock/analysis/locking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "antilock/analysis/kernel.hpp"
#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// Unknowns that are free and stand in a row of B.
int stiff_unknowns(const VariationalInequality& problem) {
  std::vector<char> stiff(problem.size(), 0);
  for (Eigen::Index row = 0; row < problem.b.rows(); ++row)
    for (RowMatrix::InnerIterator entry(problem.b, row); entry; ++entry) stiff[entry.col()] = 1;
  for (const int i : problem.fixed) stiff[i] = 0;
  return static_cast<int>(std::count(stiff.begin(), stiff.end(), 1));
}

}  // namespace

double bending_length(const TriangleMesh& mesh, int triangle) {
  const auto x = [&](int corner) { return mesh.vertices(mesh.triangles(triangle, corner % 3), 0); };
  double product = 1;
  for (int i = 0; i < 3; ++i) product *= std::abs(x(i) - x(i + 1));
  return product / (4 * mesh.area(triangle));
}

double bending_length(const TriangleMesh& mesh) {
  double sum = 0, area = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer)
      sum += mesh.area(t) * std::pow(bending_length(mesh, t), 2), area += mesh.area(t);
  return area > 0 ? std::sqrt(sum / area) : 0;
}

double LockingDiagnosis::order() const {
  if (locks() || coarse == 0) return 0;
  return std::log(static_cast<double>(fine) / coarse) / std::log(static_cast<double>(fine_unknowns) / coarse_unknowns);
}

std::string LockingDiagnosis::text() const {
  return fmt::format("kernel on the stiff part: {} of {} unknowns, then {} of {}: {}", coarse, coarse_unknowns, fine,
                     fine_unknowns,
                     fine == 0 ? "empty, it locks completely"
                     : locks() ? "it does not grow, it locks"
                               : "it grows");
}

LockingDiagnosis diagnose_locking(const VariationalInequality& coarse, const VariationalInequality& fine) {
  for (const auto* problem : {&coarse, &fine})
    if (problem->b.rows() == 0) throw Error("diagnose_locking: B has no rows; accepted: a problem with a stiff form");
  const LockingDiagnosis found{layer_kernel_dimension(coarse), layer_kernel_dimension(fine), stiff_unknowns(coarse),
                               stiff_unknowns(fine)};
  if (found.fine_unknowns <= found.coarse_unknowns)
    throw Error(fmt::format("diagnose_locking: {} stiff unknowns, then {}; accepted: more on the second mesh",
                            found.coarse_unknowns, found.fine_unknowns));
  return found;
}

}  // namespace antilock
