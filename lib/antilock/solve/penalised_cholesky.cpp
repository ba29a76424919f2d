#include "antilock/solve/penalised_cholesky.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/defaults.hpp"
#include "antilock/solve/detail/slack_form.hpp"

namespace antilock {
namespace {

const VariationalInequality& checked(const VariationalInequality& problem) {
  check(problem);
  return problem;
}

/// Equal bit for bit, stored zeros and all: one walk over both.
template <class Sparse>
bool same(const Sparse& one, const Sparse& other) {
  const auto equal = [](const auto* a, const auto* b, Eigen::Index count) {
    return std::equal(a, a + count, b);
  };
  const Eigen::Index n = one.nonZeros();
  return one.rows() == other.rows() && one.cols() == other.cols() && n == other.nonZeros() &&
         equal(one.valuePtr(), other.valuePtr(), n) &&
         equal(one.innerIndexPtr(), other.innerIndexPtr(), n) &&
         equal(one.outerIndexPtr(), other.outerIndexPtr(), one.outerSize());
}

/// Whether the contact problem is solved on the sparse matrix (see ContactReduction).
///
/// The rule is measured on a membrane (figures/benchmarks/many_bounds.cpp) with bounds on k rows of
/// n x n vertices, so that n_bounds = k sqrt(n_free). The seconds of schur_complement over those of
/// sparse are 0.2 to 0.4 at k = 1 to 4 and 0.5 to 0.9 at 8; for n = 32, 64 and 128 they are 0.6,
/// 1.1 and 1.4 at 10 and 0.8, 1.4 and 2.5 at 12, because n_bounds^3 stands against n_free^(3/2).
/// Where all unknowns are bounded, sparse is chosen from 101 on: at 225 both cost the same, at 529
/// it takes a fifth. A beam of 512 cells takes as many iterations with either.
bool chooses_sparse(ContactReduction reduction, const DofOrdering& ordering) {
  const int bounded = ordering.contact_count();
  if (reduction != ContactReduction::automatic)
    return bounded > 0 && reduction == ContactReduction::sparse;
  return bounded > 10 * std::sqrt(ordering.dof.size());
}

}  // namespace

PenalisedCholesky::PenalisedCholesky(const VariationalInequality& problem,
                                     std::optional<double> penalty, ContactReduction reduction,
                                     CholeskyMaker make)
    : first_delta_(penalty_parameter(checked(problem), penalty)),
      problem_(*SlackForm(problem, first_delta_)),
      ordering_(problem_),
      sparse_(chooses_sparse(reduction, ordering_)),
      factor_(make) {
  refactor(first_delta_);
}

void PenalisedCholesky::check_fits(const VariationalInequality& problem) const {
  slack_form(problem);
}

SlackForm PenalisedCholesky::slack_form(const VariationalInequality& problem) const {
  check_data(problem);
  SlackForm slack_form(problem, first_delta_);
  const DofOrdering other(*slack_form);
  if (other.dof != ordering_.dof || other.interior != ordering_.interior)
    throw Error(fmt::format(
        "solve: the factor is of {} free unknowns, {} of them in contact, the problem has {} and "
        "{}; "
        "accepted: the factor of a problem with the same free and contact unknowns",
        ordering_.dof.size(), ordering_.contact_count(), other.dof.size(), other.contact_count()));
  const Eigen::VectorXd &own = slack_form->fixed_compliances,
                        &of_factor = problem_.fixed_compliances;
  if (!same(slack_form->a1, problem_.a1) || !same(slack_form->b, problem_.b) ||
      slack_form->m != problem_.m || own.size() != of_factor.size() || own != of_factor)
    throw Error(
        "solve: the factor is of another A1, B or M; accepted: the factor of this problem's "
        "matrices");
  return slack_form;
}

void PenalisedCholesky::refactor(double delta) {
  if (!(delta > 0 && std::isfinite(delta)))
    throw Error(fmt::format("solve: delta = {}; accepted: a positive number", delta));
  double own = problem_.fixed_compliances.size() > 0
                   ? defaults::fixed_row_penalty_ratio * std::min(delta, choose_penalty(problem_))
                   : delta;
  for (delta_ = 0; delta_ == 0;
       delta *= defaults::penalty_reduction, own *= defaults::penalty_reduction) {
    penalties_ = row_penalties(problem_, delta, own);
    const std::optional<int> lost = factor_.factorise(
        penalised_matrix(problem_, ordering_, penalties_), sparse_ ? 0 : ordering_.contact_count());
    if (!lost) delta_ = delta;
    // a larger penalty leaves the factor more digits of A1, until nothing is stiff beside it any
    // more
    else if (problem_.b.rows() == 0 || !(delta < first_delta_ / default_penalty))
      throw Error(
          fmt::format("solve: A1 + B' M B / {:.3g} is not positive definite (at unknown {}): a "
                      "part of the structure is held "
                      "by nothing, a cell is too flat for double precision, or A1 and B are in "
                      "units far apart; accepted: enough "
                      "fixed unknowns, cells, entries of A1 and B' M B of like size",
                      delta, ordering_.dof[*lost]));
  }
  if (sparse_) return;
  const Stopwatch watch;
  contact_block_ = factor_.cholesky().trailing_block(ordering_.interior);
  schur_ = contact_block_.triangularView<Eigen::Lower>() * contact_block_.transpose();
  schur_seconds_ = watch.seconds();
}

const SparseCholesky& PenalisedCholesky::cholesky() const {
  if (sparse_)
    throw Error(
        fmt::format("solve: this factor of {} bounds among {} unknowns has no dense contact block; "
                    "accepted: a factor "
                    "made with ContactReduction::schur_complement",
                    ordering_.contact_count(), ordering_.dof.size()));
  return factor_.cholesky();
}

}  // namespace antilock
