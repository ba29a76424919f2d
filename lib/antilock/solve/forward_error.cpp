#include "antilock/solve/forward_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/core/dense.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/defaults.hpp"

namespace antilock {
namespace {

constexpr double eps = defaults::eps;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Whether B u = 0 in the rows of compliance 0, the prescribed values and the bounds may exclude
/// each other. They do not where u = 0 is admissible.
bool may_be_infeasible(const VariationalInequality& problem) {
  const bool zero_is_admissible =
      problem.dirichlet_values.isZero(0) &&
      (distance_to_bound(problem.bounds, Eigen::VectorXd::Zero(problem.size())).array() >= 0).all();
  return (problem.compliances().array() == 0).any() && !zero_is_admissible;
}

/// A lower bound of |u| over the admissible u by Farkas's lemma; 0 where y (R) proves nothing.
/// Admissible is a u that meets the bounds, the prescribed values and B u = 0 in the rows of
/// compliance 0. With y on these rows and z = B' y,
///
///     0 = y' B u = z' u >= D - s |u|,  and so |u| >= D / s:
///     D = sum of z_i lower_i (z_i > 0), z_i upper_i (z_i < 0), z_i times the prescribed u_i, where u_i has one of them
///     s = sum of the other |z_i|
///
/// Where nothing is admissible the corrections of p tend to a y with s = 0: M B u, u the admissible
/// point that is nearest to the kernel of B. Round-off: rows that differ by less than
/// defaults::row_tolerance are equal. So D is reduced by row_tolerance times the terms of y' B u,
/// with the bound or prescribed value of u_i where it has one, else with the u_i of the iterate (a
/// gradient of a constant is 0, but for the rounding of B). A large u must not hide a contradiction
/// between the data: no other u_i counts for more than the mean of the data, weighted by |z_i|.
double smallest_feasible_norm(const VariationalInequality& problem, const DoubleDoubleVector& y,
                              const Eigen::VectorXd& u) {
  DoubleDoubleVector z(Eigen::VectorXd::Zero(problem.size()));
  Eigen::VectorXd terms = Eigen::VectorXd::Zero(problem.size());
  const double size = y.size() > 0 ? y.high.lpNorm<Eigen::Infinity>() : 0;
  if (!(size > 0 && std::isfinite(size))) return 0;
  const double unit = std::exp2(-std::ilogb(size));  // exact
  double d = 0, s = 0, weight = 0, data = 0;
  const Eigen::VectorXd compliance = problem.compliances();
  for (Eigen::Index row = 0; row < y.size(); ++row) {
    if (compliance(row) != 0) continue;
    const DoubleDouble y_row = unit * y(row);
    for (RowMatrix::InnerIterator b(problem.b, row); b; ++b) {
      s += eps * eps * std::abs(z.high(b.col()));  // the round-off of the sum
      z.add(b.col(), b.value() * y_row);
      terms(b.col()) += std::abs(b.value() * y_row.high);
    }
  }
  const auto bounded_by = [&](int i, double bound) {
    d += z.high(i) * bound - defaults::row_tolerance * std::abs(terms(i) * bound);
    weight += std::abs(z.high(i));
    data += std::abs(z.high(i) * bound);
    z.high(i) = terms(i) = 0;
  };
  for (std::size_t k = 0; k < problem.dirichlet_dofs.size(); ++k)
    bounded_by(problem.dirichlet_dofs[k], problem.dirichlet_values(static_cast<Eigen::Index>(k)));
  const Bounds& bounds = problem.bounds;
  for (int i = 0; i < bounds.count(); ++i) {
    const double bound = z.high(bounds.unknowns[i]) > 0 ? bounds.lower(i) : bounds.upper(i);
    if (std::isfinite(bound) && std::isinf(bounds.force_limit(i)))
      bounded_by(bounds.unknowns[i], bound);
  }
  if (weight > 0) d -= defaults::row_tolerance * terms.dot(u.cwiseAbs().cwiseMin(data / weight));
  return d > 0 ? d / (s + z.high.lpNorm<1>()) : 0;
}

}  // namespace

ForwardError forward_error(const VariationalInequality& problem, const DoubleDoubleVector& u,
                           double next_correction, const Eigen::VectorXd& constraint_residual,
                           double contraction, double largest_u, const CorrectionOptions& options) {
  const double size = u.high.lpNorm<Eigen::Infinity>(), largest = std::max(size, largest_u);
  const double scale = std::max(size, eps / options.tolerance * largest);
  const double closed = std::max(
      defaults::row_tolerance * std::max(1.0, options.tolerance / CorrectionOptions{}.tolerance),
      options.contact_tolerance);
  const bool by_itself = may_be_infeasible(problem);
  double data =
      problem.dirichlet_values.size() > 0 ? problem.dirichlet_values.lpNorm<Eigen::Infinity>() : 0;
  for (const Eigen::VectorXd* bound : {&problem.bounds.lower, &problem.bounds.upper})
    for (const double b : *bound)
      if (std::isfinite(b)) data = std::max(data, std::abs(b));
  const double to_come = next_correction / (1 - contraction);
  ForwardError forward_error{next_correction > 0 ? to_come / scale : 0, 0, to_come};
  for (Eigen::Index row = 0; row < constraint_residual.size(); ++row) {
    const double left = std::abs(constraint_residual(row));
    if (!(left > std::numeric_limits<double>::min())) continue;  // 0, or of no digits
    double terms = 0, unit = 0;
    for (RowMatrix::InnerIterator b(problem.b, row); b; ++b) {
      terms += std::abs(b.value() * u.high(b.col()));
      unit += std::abs(b.value());
    }
    const double own =
        options.kkt_fail() * std::min(terms, data * unit) + eps * eps * unit * largest;
    forward_error.absolute = std::max(forward_error.absolute, to_come + left / unit);
    forward_error.constraint =
        std::max(forward_error.constraint,
                 left / std::min(closed * unit * scale, by_itself ? own : infinite));
  }
  return forward_error;
}

void throw_if_infeasible(const VariationalInequality& problem, const DoubleDoubleVector& y,
                         const Eigen::VectorXd& u, double max_u, const Solution& so_far) {
  if (!may_be_infeasible(problem)) return;
  const double least = smallest_feasible_norm(problem, y, u);
  if (least > max_u)
    throw NotConverged(
        fmt::format(
            "{}: infeasible: after {} corrections u is at most {:.1e}, and no u below {:.1e} meets "
            "the bounds, the prescribed values and B u = 0",
            so_far.solver, so_far.counters.corrections, max_u, least),
        1, so_far.counters.corrections);
}

double factor_roundoff(const VariationalInequality& problem, const PenalisedCholesky& factor) {
  return eps * problem.free_count() * problem.a1.diagonal().cwiseAbs().maxCoeff() /
         factor.smallest_pivot();
}

ConstraintDefect constraint_defect(const VariationalInequality& problem,
                                   const Eigen::VectorXd& constraint_residual,
                                   const BoundStatuses& status) {
  const Eigen::Index rows = problem.b.rows(), columns = problem.size();
  ConstraintDefect defect{0, Eigen::VectorXd(Eigen::VectorXd::Zero(rows))};
  if (rows < 2 || rows > defaults::max_rows_for_qr || columns > 10 * defaults::max_rows_for_qr ||
      constraint_residual.isZero(0))
    return defect;
  const Eigen::VectorXd compliance = problem.compliances();
  Eigen::MatrixXd b = problem.b;
  Eigen::MatrixXd step(rows, columns + rows);
  for (const int i : problem.dirichlet_dofs) b.col(i).setZero();
  const Eigen::ArrayXd stiffness =
      problem.a1.diagonal().cwiseAbs() + b.cwiseAbs2().transpose() * problem.m;
  const Eigen::VectorXd unit = (stiffness > 0).select(stiffness.sqrt().inverse(), 1);
  step << b * unit.asDiagonal(),
      Eigen::MatrixXd(compliance.cwiseQuotient(problem.m).cwiseSqrt().asDiagonal());
  const Eigen::ArrayXd length = step.rowwise().norm();
  const Eigen::VectorXd norm = (length > 0).select(length, 1);
  step = norm.cwiseInverse().asDiagonal() * step;
  defect.displacement =
      unit.cwiseProduct(
              least_squares(step, constraint_residual.cwiseQuotient(norm), defaults::row_tolerance)
                  .head(columns))
          .lpNorm<Eigen::Infinity>();
  if (compliance.minCoeff() > 0) return defect;
  // y: the residual of B u less its part in the span of the rows where u may move. Repeated, since
  // z = B' y is exact
  Eigen::VectorXd movable = Eigen::VectorXd::Ones(columns);
  movable(problem.dirichlet_dofs).setZero();
  for (std::size_t i = 0; i < status.size(); ++i)
    if (is_active(status[i])) movable(problem.bounds.unknowns[i]) = 0;
  const Eigen::VectorXd stiff = (compliance.array() == 0).cast<double>();
  b = stiff.asDiagonal() * step.leftCols(columns) * movable.asDiagonal();
  defect.infeasible_part = Eigen::VectorXd(-stiff.cwiseProduct(constraint_residual));
  for (int pass = 0; pass < 3;
       ++pass) {  // each leaves eps cond(B): three reach 106 bits up to cond(B) = 1e5
    DoubleDoubleVector z(Eigen::VectorXd::Zero(columns));
    for (Eigen::Index r = 0; r < rows; ++r)
      for (RowMatrix::InnerIterator entry(problem.b, r); entry; ++entry)
        if (movable(entry.col()) != 0)
          z.add(entry.col(), entry.value() * defect.infeasible_part(r));
    const Eigen::VectorXd part =
        least_squares(b.transpose(), unit.cwiseProduct(z.high), defaults::row_tolerance);
    for (Eigen::Index r = 0; r < rows; ++r) defect.infeasible_part.add(r, {-part(r) / norm(r), 0});
  }
  return defect;
}

void add_conditioning_error(const VariationalInequality& problem, const PenalisedCholesky& factor,
                            const Eigen::VectorXd& constraint_residual, Solution& result) {
  const double size = result.u.lpNorm<Eigen::Infinity>();
  const double warn_above =
      KktTolerances{}.warn * std::max(size, KktTolerances{}.fail * result.penalised_max_u);
  // |K^-1| is estimated by n_free / smallest pivot, a heuristic (sparse_cholesky.hpp);
  // double-double numbers leave eps^2 of the largest force
  const double stress =
      problem.b.rows() > 0
          ? (problem.b.cwiseAbs().transpose() * problem.m.cwiseProduct(result.p.cwiseAbs()))
                .maxCoeff()
          : 0;
  const double moved = eps * eps * stress * problem.free_count() / factor.smallest_pivot();
  result.error += moved;
  if (moved > warn_above) {
    result.warning = fmt::format("{}: forces of {:.0e} may leave an error of {:.0e} in u, {:.0e}",
                                 result.solver, stress, moved, size);
    return;
  }
  const ConstraintDefect defect = constraint_defect(problem, constraint_residual, result.status);
  throw_if_infeasible(problem, defect.infeasible_part, result.u, (1 + KktTolerances{}.fail) * size,
                      result);
  result.error += defect.displacement;
  if (defect.displacement > warn_above)
    result.warning = fmt::format(
        "{}: rows of B are nearly dependent, and what is left of them may move u, {:.0e}, by "
        "{:.0e}",
        result.solver, size, defect.displacement);
}

}  // namespace antilock
