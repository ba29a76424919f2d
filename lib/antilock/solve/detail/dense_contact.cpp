#include "antilock/solve/detail/dense_contact.hpp"

#include <numeric>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/solve/detail/tuned.hpp"

namespace antilock {
namespace {

Cholesky factor_of(const Eigen::MatrixXd& s) {
  Cholesky factor(s);
  if (!factor.positive_definite()) throw Error("contact: the Schur complement is not positive definite");
  return factor;
}

std::vector<int> from_zero_to(Eigen::Index count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

DenseContact::DenseContact(const Eigen::MatrixXd& s, const Eigen::VectorXd& q)
    : ContactSystem(from_zero_to(q.size())), s_(s), q_(q) {}

Equilibrium DenseContact::solve(const std::vector<char>& held, const Eigen::VectorXd& given) {
  std::vector<int> free, fixed;
  for (int i = 0; i < static_cast<int>(held.size()); ++i) (held[i] != 0 ? fixed : free).push_back(i);
  Equilibrium now{given, given, {}};
  if (!free.empty()) {
    Eigen::VectorXd rhs = q_(free) + given(free);
    if (!fixed.empty()) rhs.noalias() -= s_(free, fixed) * given(fixed);
    const Eigen::VectorXd v = factor_of(s_(free, free)).solve(rhs);
    now.v(free) = v;
  }
  if (!fixed.empty()) now.lambda(fixed) = s_(fixed, Eigen::all) * now.v - q_(fixed);
  // each force by the terms of its own row: one stiff unknown must not hide the pull on a soft one
  now.round_off = tuned::round_off * (s_.cwiseAbs() * now.v.cwiseAbs() + q_.cwiseAbs());
  return now;
}

Pieces DenseContact::nested_start(const Stairs& stairs, int max_steps) {
  const int fine = stairs.count(), coarse = fine / 2;
  if (fine <= 1) return Pieces(fine, Piece::between);
  const auto kept = Eigen::seqN(1, coarse, 2), others = Eigen::seqN(0, fine - coarse, 2);
  const Cholesky factor = factor_of(s_(others, others));
  const Eigen::MatrixXd half = factor.half_solve(Eigen::MatrixXd(s_(others, kept)));
  const Eigen::VectorXd half_q = factor.half_solve(Eigen::VectorXd(q_(others)));
  const Eigen::MatrixXd s = Eigen::MatrixXd(s_(kept, kept)) - half.transpose() * half;
  const Eigen::VectorXd q = Eigen::VectorXd(q_(kept)) - half.transpose() * half_q;
  DenseContact smaller(s, q);
  return start_by_halves(stairs, smaller, max_steps);
}

}  // namespace antilock
