#include "antilock/solve/penalty_factor.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/supernodes.hpp"

namespace antilock {
namespace {

/// CHOLMOD's view of an upper triangle that Eigen owns.
cholmod_sparse view(SparseMatrix& k) {
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<std::size_t>(k.cols());
  a.nzmax = static_cast<std::size_t>(k.nonZeros());
  a.p = k.outerIndexPtr();
  a.i = k.innerIndexPtr();
  a.x = k.valuePtr();
  a.stype = 1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  return a;
}

const VariationalInequality& checked(const VariationalInequality& problem) {
  check(problem);
  return problem;
}

/// Of the bits of A1, B and M (FNV-1a, an entry at a time): equal for equal matrices, and for no others in practice. Four
/// hashes side by side, each of every fourth entry: a multiplication need not wait for the one before.
std::uint64_t fingerprint(const VariationalInequality& problem) {
  std::array<std::uint64_t, 4> hash;
  hash.fill(0xcbf29ce484222325);
  const auto add = [](std::uint64_t& lane, std::uint64_t bits) { lane = (lane ^ bits) * 0x100000001b3; };
  const auto add_all = [&](const auto* entries, Eigen::Index count, const auto& bits) {
    Eigen::Index i = 0;
    for (; i + 4 <= count; i += 4)
      for (int lane = 0; lane < 4; ++lane) add(hash[lane], bits(entries[i + lane]));
    for (; i < count; ++i) add(hash[0], bits(entries[i]));
    add(hash[0], static_cast<std::uint64_t>(count));
  };
  const auto of_value = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  const auto of_place = [](int place) { return static_cast<std::uint64_t>(place); };
  add_all(problem.a1.valuePtr(), problem.a1.nonZeros(), of_value);
  add_all(problem.b.valuePtr(), problem.b.nonZeros(), of_value);
  add_all(problem.m.data(), problem.m.size(), of_value);
  add_all(problem.a1.innerIndexPtr(), problem.a1.nonZeros(), of_place);
  add_all(problem.b.innerIndexPtr(), problem.b.nonZeros(), of_place);
  for (int lane = 1; lane < 4; ++lane) add(hash[0], hash[lane]);
  return hash[0];
}

}  // namespace

struct PenaltyFactor::Cholmod {
  cholmod_common common{};
  cholmod_factor* l = nullptr;

  Cholmod() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
  }
  ~Cholmod() {
    cholmod_free_factor(&l, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  /// CAMD orders by minimum degree under the constraint that the contact unknowns come last: as good as AMD without it.
  void analyse(SparseMatrix& k, int interior) {
    const int size = static_cast<int>(k.cols());
    std::vector<int> order(size), group(size, 0);
    std::fill(group.begin() + interior, group.end(), interior > 0 ? 1 : 0);  // CAMD wants groups below `size`
    cholmod_sparse whole = view(k);
    if (!cholmod_camd(&whole, nullptr, 0, group.data(), order.data(), &common))
      throw Error("solve: the ordering of the sparse factor failed: out of memory");
    std::iota(order.begin() + interior, order.end(), interior);  // among themselves in the order of the reports
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    for (const int postorder : {1, 0}) {
      common.postorder = postorder;
      cholmod_free_factor(&l, &common);
      l = cholmod_analyze_p(&whole, order.data(), nullptr, 0, &common);
      if (l == nullptr) throw Error("solve: the analysis of the sparse factor failed: out of memory");
      const int* perm = static_cast<int*>(l->Perm);
      bool last = true;
      for (int i = interior; i < size; ++i) last = last && perm[i] == i;
      if (last) return;  // else a postorder moved a contact unknown: do without
    }
    throw Error("solve: the contact unknowns did not come last in the sparse factor");
  }

  Supernodes supernodes() const {
    return {.size = static_cast<int>(l->n),
            .count = static_cast<int>(l->nsuper),
            .start = static_cast<const int*>(l->super),
            .row_start = static_cast<const int*>(l->pi),
            .block_start = static_cast<const int*>(l->px),
            .row = static_cast<const int*>(l->s),
            .value = static_cast<const double*>(l->x)};
  }

  /// The order of the columns of L: place -> row of K.
  Eigen::Map<const Eigen::VectorXi> order() const {
    return {static_cast<const int*>(l->Perm), static_cast<Eigen::Index>(l->n)};
  }
};

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem, double delta, Checked)
    : numbering_(problem), matrices_(fingerprint(problem)), cholmod_(std::make_unique<Cholmod>()) {
  factorise(problem, delta);
}

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem, double delta)
    : PenaltyFactor(checked(problem), delta, Checked{}) {}

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem)
    : PenaltyFactor(problem, moderate_delta(checked(problem)), Checked{}) {}

PenaltyFactor PenaltyFactor::moderate(const VariationalInequality& problem, std::optional<double> penalty) {
  return {problem, moderate_delta(checked(problem), penalty), Checked{}};
}

PenaltyFactor::~PenaltyFactor() = default;
PenaltyFactor::PenaltyFactor(PenaltyFactor&&) noexcept = default;
PenaltyFactor& PenaltyFactor::operator=(PenaltyFactor&&) noexcept = default;

void PenaltyFactor::check_fits(const VariationalInequality& problem) const {
  check_data(problem);
  check_unknowns(problem);
  if (fingerprint(problem) != matrices_)
    throw Error("solve: the factor is of another A1, B or M; accepted: the factor of this problem's matrices");
}

void PenaltyFactor::check_unknowns(const VariationalInequality& problem) const {
  const FreeNumbering other(problem);
  if (other.unknown != numbering_.unknown || other.interior != numbering_.interior)
    throw Error(
        fmt::format("solve: the factor is of {} free unknowns, {} of them in contact, the problem has {} and {}; "
                    "accepted: the factor of a problem with the same free and contact unknowns",
                    numbering_.unknown.size(), numbering_.unknown.size() - numbering_.interior, other.unknown.size(),
                    problem.contact.size()));
}

void PenaltyFactor::refactor(const VariationalInequality& problem, double delta) {
  const std::uint64_t matrices = fingerprint(problem);
  if (matrices != matrices_) {
    check(problem);
    matrices_ = matrices;
  }
  check_unknowns(problem);
  factorise(problem, delta);
}

void PenaltyFactor::factorise(const VariationalInequality& problem, double delta) {
  if (!(delta > 0 && std::isfinite(delta)))
    throw Error(fmt::format("solve: delta = {}; accepted: a positive number", delta));
  delta_ = delta;
  SparseMatrix k = penalised_matrix(problem, numbering_, delta);
  Stopwatch watch;
  if (cholmod_->l == nullptr) {
    cholmod_->analyse(k, numbering_.interior);
    analyse_seconds = watch.lap();
  }
  cholmod_sparse whole = view(k);
  cholmod_factorize(&whole, cholmod_->l, &cholmod_->common);
  if (cholmod_->common.status < CHOLMOD_OK) throw Error("solve: the sparse factorisation failed: out of memory");
  std::optional<int> column;
  if (cholmod_->common.status == CHOLMOD_NOT_POSDEF)
    column = static_cast<int>(cholmod_->l->minor);
  else
    column = cholmod_->supernodes().lost_pivot(k.diagonal()(cholmod_->order()));
  if (column) {
    const int unknown = numbering_.unknown[cholmod_->order()(*column)];
    throw Error(fmt::format(
        "solve: A1 + B' M B / {:.3g} is not positive definite (at unknown {}): a part of the structure is held "
        "by nothing, a cell is too flat for double precision, or A1 and B are in units far apart; accepted: enough "
        "fixed unknowns, cells, entries of A1 and B' M B of like size",
        delta, unknown));
  }
  contact_block_ = cholmod_->supernodes().trailing_block(numbering_.interior);
  factor_seconds = watch.lap();
  ++factorisations;
}

double PenaltyFactor::rcond() { return cholmod_rcond(cholmod_->l, &cholmod_->common); }

Eigen::VectorXd PenaltyFactor::forward(const Eigen::VectorXd& r) {
  Eigen::VectorXd y = r(cholmod_->order());
  cholmod_->supernodes().forward(y);
  return y;
}

Eigen::VectorXd PenaltyFactor::backward(Eigen::VectorXd y) {
  cholmod_->supernodes().backward(y);
  Eigen::VectorXd x(y.size());
  x(cholmod_->order()) = y;
  ++solves;
  return x;
}

}  // namespace antilock
