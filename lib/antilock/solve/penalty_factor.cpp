#include "antilock/solve/penalty_factor.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"

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

/// Of the bits of A1, B and M (FNV-1a, a double at a time): equal for equal matrices, and for no others in practice.
std::uint64_t fingerprint(const VariationalInequality& problem) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](std::uint64_t bits) { hash = (hash ^ bits) * 0x100000001b3; };
  const auto add_all = [&](const double* values, Eigen::Index count) {
    for (Eigen::Index i = 0; i < count; ++i) add(std::bit_cast<std::uint64_t>(values[i]));
    add(static_cast<std::uint64_t>(count));
  };
  add_all(problem.a1.valuePtr(), problem.a1.nonZeros());
  add_all(problem.b.valuePtr(), problem.b.nonZeros());
  add_all(problem.m.data(), problem.m.size());
  const auto places = [&](const int* inner, Eigen::Index count) {
    for (Eigen::Index i = 0; i < count; ++i) add(static_cast<std::uint64_t>(inner[i]));
  };
  places(problem.a1.innerIndexPtr(), problem.a1.nonZeros());
  places(problem.b.innerIndexPtr(), problem.b.nonZeros());
  return hash;
}

}  // namespace

struct PenaltyFactor::Cholmod {
  cholmod_common common{};
  cholmod_factor* l = nullptr;
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;  // work space of the solves

  Cholmod() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
  }
  ~Cholmod() {
    cholmod_free_factor(&l, &common);
    cholmod_free_dense(&x, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
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

  Eigen::VectorXd solve(int system, const Eigen::VectorXd& b) {
    cholmod_dense rhs{};
    rhs.nrow = rhs.nzmax = rhs.d = static_cast<std::size_t>(b.size());
    rhs.ncol = 1;
    rhs.x = const_cast<double*>(b.data());  // CHOLMOD reads it only
    rhs.xtype = CHOLMOD_REAL;
    rhs.dtype = CHOLMOD_DOUBLE;
    if (!cholmod_solve2(system, l, &rhs, nullptr, &x, nullptr, &y, &e, &common))
      throw Error("solve: a triangular solve failed: out of memory");
    return Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(x->x), b.size());
  }

  /// The column of L whose pivot is nothing but the round-off of its diagonal entry of K: K is singular, though the
  /// factor came to an end. Empty: there is none. Sound problems stay above 1e-11, on meshes and layers of every kind.
  std::optional<int> lost_pivot(const Eigen::VectorXd& diagonal) const {
    constexpr double lost = 64 * std::numeric_limits<double>::epsilon();
    const auto* perm = static_cast<const int*>(l->Perm);
    const auto* super = static_cast<const int*>(l->super);
    const auto* pi = static_cast<const int*>(l->pi);
    const auto* px = static_cast<const int*>(l->px);
    const auto* values = static_cast<const double*>(l->x);
    for (std::size_t s = 0; s < l->nsuper; ++s)
      for (int column = super[s]; column < super[s + 1]; ++column) {
        const auto inside = static_cast<std::ptrdiff_t>(column - super[s]);
        const double root = values[px[s] + inside * (pi[s + 1] - pi[s]) + inside];
        if (!(root * root > lost * diagonal(perm[column]))) return column;
      }
    return std::nullopt;
  }

  /// The trailing block of L from `first` on, out of CHOLMOD's supernodes.
  Eigen::MatrixXd trailing_block(int first) const {
    const int size = static_cast<int>(l->n);
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size - first, size - first);
    const auto* super = static_cast<const int*>(l->super);
    const auto* pi = static_cast<const int*>(l->pi);
    const auto* px = static_cast<const int*>(l->px);
    const auto* rows = static_cast<const int*>(l->s);
    const auto* values = static_cast<const double*>(l->x);
    for (std::size_t s = 0; s < l->nsuper; ++s) {
      if (super[s + 1] <= first) continue;
      const int height = pi[s + 1] - pi[s];
      for (int column = std::max(super[s], first); column < super[s + 1]; ++column)
        for (int k = column - super[s]; k < height; ++k)  // above its diagonal a supernode holds no factor entries
          block(rows[pi[s] + k] - first, column - first) =
              values[px[s] + static_cast<std::ptrdiff_t>(column - super[s]) * height + k];
    }
    return block;
  }
};

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem, double delta)
    : numbering_(checked(problem)), matrices_(fingerprint(problem)), cholmod_(std::make_unique<Cholmod>()) {
  factorise(problem, delta);
}

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem) : PenaltyFactor(problem, moderate_delta(problem)) {}

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
    column = cholmod_->lost_pivot(k.diagonal());
  if (column) {
    const int unknown = numbering_.unknown[static_cast<int*>(cholmod_->l->Perm)[*column]];
    throw Error(fmt::format(
        "solve: A1 + B' M B / {:.3g} is not positive definite (at unknown {}): a part of the structure is held "
        "by nothing, a cell is too flat for double precision, or A1 and B are in units far apart; accepted: enough "
        "fixed unknowns, cells, entries of A1 and B' M B of like size",
        delta, unknown));
  }
  contact_block_ = cholmod_->trailing_block(numbering_.interior);
  factor_seconds = watch.lap();
  ++factorisations;
}

double PenaltyFactor::rcond() { return cholmod_rcond(cholmod_->l, &cholmod_->common); }

Eigen::VectorXd PenaltyFactor::forward(const Eigen::VectorXd& r) {
  const auto* perm = static_cast<const int*>(cholmod_->l->Perm);
  Eigen::VectorXd permuted(r.size());
  for (Eigen::Index i = 0; i < r.size(); ++i) permuted(i) = r(perm[i]);
  return cholmod_->solve(CHOLMOD_L, permuted);
}

Eigen::VectorXd PenaltyFactor::backward(const Eigen::VectorXd& y) {
  const auto* perm = static_cast<const int*>(cholmod_->l->Perm);
  const Eigen::VectorXd permuted = cholmod_->solve(CHOLMOD_Lt, y);
  Eigen::VectorXd x(y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) x(perm[i]) = permuted(i);
  ++solves;
  return x;
}

}  // namespace antilock
