#include "antilock/analysis/locking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "antilock/analysis/kernel.hpp"
#include "antilock/core/error.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
double bending_length(const TriangleMesh& mesh, int triangle) {
  require_triangles(mesh, "bending length");
  const auto x = [&](int corner) { return mesh.vertices(mesh.triangles(triangle, corner % 3), 0); };
  double product = 1;
  for (int i = 0; i < 3; ++i) product *= std::abs(x(i) - x(i + 1));
  return product / (4 * mesh.area(triangle));
}

double bending_length(const TriangleMesh& mesh) {
  double sum = 0, area = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer) {
      sum += mesh.area(t) * std::pow(bending_length(mesh, t), 2);
      area += mesh.area(t);
    }
  return area > 0 ? std::sqrt(sum / area) : 0;
}

namespace {

/// Returns the mean displacement of the bounded unknowns under a total force of 1 that is spread
/// over them, without bounds and loads. Returns nothing if only the bounds hold them, or if the
/// solve does not converge.
std::optional<double> flexibility(VariationalInequality problem, const std::vector<int>& bounds,
                                  double compliance) {
  problem.load.setZero();
  for (const int i : bounds) problem.load(i) = 1.0 / static_cast<double>(bounds.size());
  problem.bounds = {};
  problem.dirichlet_values.setZero();
  problem.compliance = compliance;
  try {
    return active_set(problem).u.dot(problem.load);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

std::string LockingDiagnosis::text() const {
  const std::string counts = fmt::format("motions {}without strain: {} of {}, then {} of {}",
                                         bounded ? "of the bounds " : "of the stiff part ", coarse,
                                         coarse_bounds, fine, fine_bounds);
  const std::string range =
      compliance > 0 ? fmt::format(" (from a compliance of about {:.0e} down)", compliance) : "";
  switch (verdict()) {
    case Verdict::locks_completely:
      return counts + ": none, it locks completely" + range;
    case Verdict::locks:
      if (fine > coarse)
        return counts +
               fmt::format(": they grow, but refinement softens the answer by {:.0f} %: it locks",
                           100 * refinement_softening) +
               range;
      return counts + ": they do not grow, it locks" + range;
    case Verdict::locks_in_part:
      return counts + ": more and more bounds cannot move, it locks in part" + range;
    case Verdict::not_detected:
      break;
  }
  return counts + ": they grow, it does not lock for this reason";
}

Verdict LockingDiagnosis::verdict() const {
  if (fine == 0) return Verdict::locks_completely;
  if (fine <= coarse) return Verdict::locks;
  const int more_dead = (fine_bounds - fine) - (coarse_bounds - coarse);
  if (bounded && more_dead > significance * (fine_bounds - coarse_bounds))
    return Verdict::locks_in_part;
  return compliance > 0 ? Verdict::locks : Verdict::not_detected;
}

LockingDiagnosis diagnose_locking(const VariationalInequality& on_coarse,
                                  const VariationalInequality& on_fine) {
  const VariationalInequality coarse = assemble_fixed_rows(on_coarse),
                              fine = assemble_fixed_rows(on_fine);
  for (const auto* problem : {&coarse, &fine})
    if (problem->b.rows() == 0)
      throw Error("diagnose_locking: B has no rows; accepted: a problem with a stiff form");
  VariationalInequality first = stiff_part(coarse), second = stiff_part(fine);
  LockingDiagnosis found;
  found.bounded = !first.bounds.unknowns.empty() && !second.bounds.unknowns.empty();
  if (!found.bounded)
    for (VariationalInequality* stiff : {&first, &second}) {
      std::vector<int> all;
      for (int i = 0; i < stiff->size(); ++i)
        if (!std::binary_search(stiff->dirichlet_dofs.begin(), stiff->dirichlet_dofs.end(), i))
          all.push_back(i);
      stiff->bounds =
          Bounds::lower_on(all, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(all.size())));
    }
  found.coarse_bounds = static_cast<int>(first.bounds.unknowns.size());
  found.fine_bounds = static_cast<int>(second.bounds.unknowns.size());
  if (found.coarse_bounds == 0 || found.fine_bounds <= found.coarse_bounds)
    throw Error(fmt::format(
        "diagnose_locking: {} {}, then {}; accepted: more on the second mesh", found.coarse_bounds,
        found.bounded ? "bounds on the stiff part" : "stiff unknowns", found.fine_bounds));
  found.coarse = trace_dimension(first);
  found.fine = trace_dimension(second);
  const auto ratio = [&](double compliance) -> std::optional<double> {
    const auto on_coarse = flexibility(coarse, first.bounds.unknowns, compliance);
    const auto on_fine =
        on_coarse ? flexibility(fine, second.bounds.unknowns, compliance) : std::nullopt;
    if (!on_fine || !(*on_coarse > 0) || !(*on_fine > 0)) return {};
    return *on_fine / *on_coarse;
  };
  // No unit of the forms is better than another: in that in which both are as stiff, rounded to a
  // decade.
  const double unit = std::pow(10, std::round(std::log10(stiffness_ratio(fine).value())));
  const std::optional<double> soft = ratio(unit);
  for (int decade = 1; soft && decade <= 6 && found.compliance == 0; ++decade) {
    const double compliance = unit * std::pow(10, -decade);
    found.refinement_softening = ratio(compliance).value_or(0) / *soft - 1;
    if (found.refinement_softening > std::max(significance, std::abs(*soft - 1)))
      found.compliance = compliance;
  }
  return found;
}

}  // namespace antilock
