#include "antilock/analysis/detail/body_correction.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "antilock/core/dense.hpp"

namespace antilock {
namespace {

/// The hats at one height.
struct HatRow {
  Eigen::VectorXd x;  ///< their places, ascending
  int first = 0;      ///< the number of the first of them
};
using HatRows = std::map<double, HatRow>;  // by height

HatRows hat_rows(const Points& at, const InterfaceLine& sigma) {
  const double left = at.col(0).minCoeff();
  const double right = at.col(0).maxCoeff();
  const double top = at.col(1).maxCoeff();
  // the mean distance of two unknowns on Sigma
  const double edge = sigma.length / static_cast<double>(sigma.x.size() - 1);
  HatRows rows;
  rows[0].x = sigma.x;
  // the row at the top is there even below a body that is lower than an edge of Sigma is long
  for (double y = top; y == top || y > edge; y /= 2) {
    const int intervals = std::max(1, static_cast<int>(std::ceil((right - left) / y)));
    rows[y].x = Eigen::VectorXd::LinSpaced(1 + intervals, left, right);
  }
  int count = 0;
  for (auto& [y, row] : rows) {
    row.first = count;
    count += static_cast<int>(row.x.size());
  }
  return rows;
}

int hat_count(const HatRows& rows) {
  const HatRow& top = rows.rbegin()->second;
  return top.first + static_cast<int>(top.x.size());
}

/// Appends the entries of the two hats of a row beside x, times the weight of the row.
void insert_hats(RowMatrix& w, int dof, const HatRow& row, double x, double weight) {
  const auto [hat, t] = interval_of(row.x, x);
  w.insertBack(dof, row.first + hat) = weight * (1 - t);
  w.insertBack(dof, row.first + hat + 1) = weight * t;
}

/// W' A W, H x H.
Eigen::MatrixXd projected_form(const SparseMatrix& a, const RowMatrix& w) {
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(w.cols(), w.cols());
  for (int dof = 0; dof < a.cols(); ++dof)
    for (SparseMatrix::InnerIterator entry(a, dof); entry; ++entry)
      for (RowMatrix::InnerIterator left(w, dof); left; ++left)
        for (RowMatrix::InnerIterator right(w, entry.row()); right; ++right)
          form(right.col(), left.col()) += entry.value() * left.value() * right.value();
  return form;
}

/// Per hat: whether it does not vanish at one of the unknowns with prescribed values.
std::vector<char> held_hats(const RowMatrix& w, const std::vector<int>& dirichlet_dofs) {
  std::vector<char> held(w.cols(), 0);
  for (const int dof : dirichlet_dofs)
    for (RowMatrix::InnerIterator hat(w, dof); hat; ++hat)
      if (hat.value() > 1e-12) held[hat.col()] = 1;
  return held;
}

/// Makes the coefficient of a hat 0 in form' w = force.
void hold_hat(Eigen::MatrixXd& form, Eigen::VectorXd& force, Eigen::Index hat) {
  form.row(hat).setZero();
  form.col(hat).setZero();
  form(hat, hat) = 1;
  force(hat) = 0;
}

}  // namespace

RowMatrix correction_space(const Space& space, const InterfaceLine& sigma,
                           const std::vector<char>& in_body) {
  const Points& at = space.dof_coordinates();
  const HatRows rows = hat_rows(at, sigma);
  RowMatrix w(at.rows(), hat_count(rows));
  w.reserve(4 * at.rows());
  for (int dof = 0; dof < at.rows(); ++dof) {
    w.startVec(dof);
    if (!in_body[dof]) continue;
    if (sigma.place[dof] >= 0) {
      w.insertBack(dof, sigma.place[dof]) = 1;
      continue;
    }
    const double x = at(dof, 0);
    const double y = std::max(at(dof, 1), 0.0);
    // the rows beside y; a point of the body at y = 0 that is not on Sigma lies between the first
    // two
    const auto above = y > 0 ? rows.lower_bound(y) : std::next(rows.begin());
    const auto below = std::prev(above);
    const double s = (y - below->first) / (above->first - below->first);
    insert_hats(w, dof, below->second, x, 1 - s);
    insert_hats(w, dof, above->second, x, s);
  }
  w.finalize();
  return w;
}

CondensedBody condensed_body(const SparseMatrix& form, const Eigen::VectorXd& force,
                             const std::vector<int>& dirichlet_dofs, const RowMatrix& w,
                             Eigen::Index n) {
  CondensedBody body;
  body.held = held_hats(w, dirichlet_dofs);
  Eigen::MatrixXd a = projected_form(form, w);
  Eigen::VectorXd f = w.transpose() * force;
  // Hats may reach no vertex, or be dependent at the few that they reach. A little more energy
  // makes w unique, and v is no better for it.
  for (double& own : a.diagonal()) own = own > 0 ? (1 + 1e-10) * own : 1;
  for (Eigen::Index hat = 0; hat < w.cols(); ++hat)
    if (body.held[hat]) hold_hat(a, f, hat);

  // with L L' = A22, the block of the hats above Sigma: A11 - A12 A22^-1 A21 and F1 - A12 A22^-1 F2
  const Eigen::Index above = w.cols() - n;
  const Cholesky upper(a.bottomRightCorner(above, above));
  // half and half_force are L^-1 A21 and L^-1 F2
  const Eigen::MatrixXd half = upper.forward(Eigen::MatrixXd(a.bottomLeftCorner(above, n)));
  const Eigen::VectorXd half_force = upper.forward(Eigen::VectorXd(f.tail(above)));
  const Eigen::MatrixXd schur = a.topLeftCorner(n, n) - half.transpose() * half;
  // without the round-off by which it is not symmetric
  body.form = (schur + schur.transpose()) / 2;
  body.force = f.head(n) - half.transpose() * half_force;
  return body;
}

}  // namespace antilock
