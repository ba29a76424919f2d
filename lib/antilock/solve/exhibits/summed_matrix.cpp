#include "antilock/solve/exhibits/summed_matrix.hpp"

#include <set>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/detail/penalised_matrix.hpp"
#include "antilock/solve/detail/summed_factor.hpp"
#include "antilock/solve/kkt.hpp"

namespace antilock {
namespace {

/// The rows and columns of a symmetric matrix (its upper triangle given) that have a place >= 0, both triangles.
SparseMatrix part(const SparseMatrix& upper, const std::vector<int>& place, int size) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * upper.nonZeros());
  for (int j = 0; j < upper.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(upper, j); a; ++a) {
      const int row = place[a.row()], column = place[j];
      if (row < 0 || column < 0) continue;
      entries.emplace_back(row, column, a.value());
      if (row != column) entries.emplace_back(column, row, a.value());
    }
  SparseMatrix whole(size, size);
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

}  // namespace

std::string to_string(NaiveEnd end) {
  switch (end) {
    case NaiveEnd::settled:
      return "settled";
    case NaiveEnd::cycled:
      return "cycled";
    case NaiveEnd::refused:
      return "refused";
    case NaiveEnd::step_cap:
      break;
  }
  return "step cap";
}

NaiveAnswer naive_summed_solve(const VariationalInequality& problem, SummedFactor kind, int max_steps) {
  check(problem);
  require_lower_bounds(problem, "naive");
  if (problem.b.rows() > 0 && problem.compliance == 0)
    throw Error(
        "naive: the summed matrix does not exist at epsilon = 0; accepted epsilon > 0, or the solver active_set");
  const FreeNumbering numbering(problem);
  const int size = static_cast<int>(numbering.unknown.size()), c = static_cast<int>(problem.contact.size());
  NaiveAnswer answer;
  Solution& s = answer.solution;
  s.solver = kind == SummedFactor::cholesky ? "naive, Cholesky of the sum" : "naive, LU of the sum";
  s.u = Eigen::VectorXd::Zero(problem.size());
  s.u(problem.fixed) = problem.fixed_values;
  s.lambda = Eigen::VectorXd::Zero(c);
  s.active.assign(c, false);
  Stopwatch watch;
  const SparseMatrix k = penalised_matrix(problem, numbering, problem.compliance);  // the sum, and the fault
  Eigen::VectorXd load = problem.load - problem.a1 * s.u;
  load -= problem.b.transpose() * problem.m.cwiseProduct(problem.b * s.u) / problem.compliance;
  const Eigen::VectorXd b = load(numbering.unknown);

  std::set<std::vector<bool>> tried;
  answer.end = NaiveEnd::step_cap;
  while (s.counters.contact < max_steps) {
    if (!tried.insert(s.active).second) {
      answer.end = NaiveEnd::cycled;
      break;
    }
    // the active unknowns stand at their bounds and leave the system
    Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
    std::vector<int> place(size, -1), inactive;
    for (int i = 0; i < size; ++i) {
      const int contact = i - numbering.interior;
      if (contact >= 0 && s.active[contact]) {
        x(i) = problem.lower(contact);
      } else {
        place[i] = static_cast<int>(inactive.size());
        inactive.push_back(i);
      }
    }
    const Eigen::VectorXd rest = b - k.selfadjointView<Eigen::Upper>() * x;
    const Eigen::VectorXd found = summed_solve(part(k, place, static_cast<int>(inactive.size())), rest(inactive), kind);
    ++s.counters.factorisations;
    ++s.counters.solves;
    ++s.counters.contact;
    if (found.size() == 0) {
      answer.end = NaiveEnd::refused;
      break;
    }
    x(inactive) = found;
    const Eigen::VectorXd force = (k.selfadjointView<Eigen::Upper>() * x - b).tail(c);
    bool settled = true;
    s.lambda.setZero();
    for (int i = 0; i < c; ++i) {
      if (s.active[i]) s.lambda(i) = force(i);
      const double gap = x(numbering.interior + i) - problem.lower(i);
      if (!(s.active[i] ? force(i) < 0 : gap < 0)) continue;
      s.active[i] = !s.active[i];
      settled = false;
    }
    s.u(numbering.unknown) = x;
    if (settled) {
      answer.end = NaiveEnd::settled;
      break;
    }
  }
  s.seconds.factor = watch.seconds();
  s.p = problem.b * s.u / problem.compliance;
  s.counters.unknowns = problem.free_count();
  s.kkt = kkt_report(problem, s);
  return answer;
}

}  // namespace antilock
