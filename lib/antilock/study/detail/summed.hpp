#pragma once
#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>
#include <array>
#include <set>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/detail/penalised_matrix.hpp"
#include "antilock/solve/kkt.hpp"

namespace antilock::tutorial {

enum class SummedFactor { cholesky, lu };  ///< CHOLMOD; UMFPACK

/// How the naive solver ended. None of them says that the answer is right.
enum class NaiveEnd {
  settled,   ///< the contact set reproduced itself
  cycled,    ///< a contact set came back: it would go round for ever
  refused,   ///< the factorisation gave up, or returned something that is not finite
  step_cap,  ///< max_steps reached
};
inline std::string to_string(NaiveEnd end) {
  return std::array{"settled", "cycled", "refused", "step cap"}[static_cast<std::size_t>(end)];
}

/// An answer that nobody has vouched for: solution.kkt is the report in split form, as it is, and no level of trust was
/// applied. p is compliance^-1 B u, where u has lost the digits that p is made of.
struct NaiveAnswer {
  Solution solution;
  NaiveEnd end = NaiveEnd::settled;
};

/// x = K^-1 b by the factor asked for (K symmetric, n x n, both triangles given); empty where the factorisation gives up.
inline Eigen::VectorXd summed_solve(const SparseMatrix& k, const Eigen::VectorXd& b, SummedFactor kind) {
  Eigen::VectorXd x;
  if (kind == SummedFactor::cholesky) {
    Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Upper> factor;
    factor.cholmod().print = 0;
    factor.compute(k);
    if (factor.info() == Eigen::Success) x = factor.solve(b);
  } else {
    const Eigen::UmfPackLU<SparseMatrix> factor(k);
    if (factor.info() == Eigen::Success) x = factor.solve(b);
  }
  return x.allFinite() ? x : Eigen::VectorXd();
}

/// The rows and columns of a symmetric matrix (its upper triangle given) that have a place >= 0, both triangles.
inline SparseMatrix part_of(const SparseMatrix& upper, const std::vector<int>& place, int size) {
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

/// An exhibit, to be compared against: what most codes do. A1 + compliance^-1 B' M B summed in double precision,
/// factored in every step of a primal-dual active set that starts from no contact. The sum forgets A1 digit by digit as
/// compliance falls; use active_set instead. Throws Error at compliance = 0, where the sum does not exist.
inline NaiveAnswer naive_summed_solve(const VariationalInequality& problem, SummedFactor kind, int max_steps = 100) {
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
    const Eigen::VectorXd found =
        summed_solve(part_of(k, place, static_cast<int>(inactive.size())), rest(inactive), kind);
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

}  // namespace antilock::tutorial
