#include "antilock/solve/detail/kkt_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/solve/detail/tuned.hpp"

namespace antilock {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// 0 / 0 is a condition met exactly.
double ratio(double value, double scale) { return value == 0 ? 0.0 : value / scale; }

/// The smaller and the larger one; not a number where one of them is not.
double least(double a, double b) { return std::isnan(a) || a < b ? a : b; }
double most(double a, double b) { return std::isnan(a) || a > b ? a : b; }

}  // namespace

KktParts kkt_parts(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.size());
  KktParts parts{problem.load, problem.load.cwiseAbs(), zero, zero, zero, zero};
  for (Eigen::Index j = 0; j < problem.a1.cols(); ++j)
    for (SparseMatrix::InnerIterator a(problem.a1, j); a; ++a) {
      const double term = a.value() * u(j);
      parts.moderate(a.row()) += term;
      parts.terms(a.row()) += std::abs(term);
      if (a.row() == j) parts.diagonal(j) = a.value();
    }
  for (Eigen::Index row = 0; row < problem.b.rows(); ++row) {
    const double m = problem.m(row), stress = m * p(row);
    double strain = 0, unit = 0;
    for (RowMatrix::InnerIterator b(problem.b, row); b; ++b) {
      const double term = b.value() * stress;
      strain += b.value() * u(b.col());
      unit += std::abs(b.value());
      parts.borne(b.col()) += term;
      parts.terms(b.col()) += std::abs(term);
      parts.stiff(b.col()) += b.value() * b.value() * m;
    }
    parts.strain = most(parts.strain, std::abs(problem.compliance * p(row) - strain) / (unit == 0 ? 1 : unit));
  }
  return parts;
}

KktRows::KktRows(const KktParts& parts, const Eigen::VectorXd& bounds, const Eigen::VectorXd& largest_bound,
                 const std::vector<char>& fixed, double largest_u, double reaction,
                 const std::function<double(double)>& over_all) {
  // a locked u may tend to 0: then what a load, as far as neither lambda nor B' M p bears it, would give its unknown if
  // all the others were held tells what is large
  double single = 0;
  const Eigen::VectorXd pulled = parts.load + bounds, r1 = pulled - parts.moderate - parts.borne;
  for (Eigen::Index i = 0; i < pulled.size(); ++i) {
    if (fixed[i] != 0) reaction = std::max(reaction, std::abs(r1(i)));  // a force, not an error
    if (fixed[i] == 0 && parts.diagonal(i) > 0)
      single =
          std::max(single, std::min(std::abs(pulled(i)), std::abs(pulled(i) - parts.borne(i))) / parts.diagonal(i));
  }
  const auto largest = [](const Eigen::VectorXd& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0; };
  scales_.u = over_all(std::max(largest_u, single));
  scales_.forces = over_all(std::max(largest(parts.load), largest(largest_bound)));
  scales_.with_reactions = std::max(scales_.forces, over_all(reaction));
  // a great force somewhere must hide nothing where all forces are small
  const Eigen::VectorXd own =
      parts.terms.cwiseMax(scales_.u * (parts.diagonal.cwiseAbs() + parts.stiff)).cwiseMax(largest_bound);
  forces_ = own.cwiseMin(scales_.forces);
  for (Eigen::Index i = 0; i < own.size(); ++i) {
    if (fixed[i] != 0) {
      forces_(i) = unbounded;  // the clamp bears any
      continue;
    }
    // what the rounding of u and p alone may leave of r1 is no error: flat cells multiply it
    const double beyond = most(std::abs(r1(i)) - tuned::equal * parts.terms(i), 0);
    residual_ = most(residual_, ratio(beyond, std::min(own(i), scales_.with_reactions)));
  }
  residual_ = over_all(most(residual_, ratio(parts.strain, scales_.u)));
}

void KktRows::note_bound(Kkt& kkt, const Stairs& stairs, int i, double value, double lambda, double strain,
                         double force) const {
  const double lower = stairs.lower(i), upper = stairs.above(i), bears = stairs.most(i);
  const bool soft = std::isfinite(bears);
  // between two bounds either sign of lambda is right, and each side answers for its own
  const bool two = std::isfinite(lower) && std::isfinite(upper);
  const double up = two ? std::max(lambda, 0.0) : lambda, down = two ? std::max(-lambda, 0.0) : -lambda;
  const auto side = [&](double bound, double gap, double pressure) {
    if (!std::isfinite(bound)) return;
    const double scale = std::max(scales_.u * strain, std::abs(bound));
    if (!two) kkt.min_pressure = least(kkt.min_pressure, ratio(pressure, force));
    if (!soft) kkt.min_gap = least(kkt.min_gap, ratio(gap, scale));
    // what is not borne beyond a bound; a bound that bears far more than the forces at work is not passed by round-off
    const bool beyond = soft && gap < 0;
    const double idle = beyond ? bears - pressure : pressure, unit = beyond ? std::max(force, bears) : force;
    kkt.complementarity = most(kkt.complementarity, ratio(std::abs(idle * gap), scale * unit));
  };
  if (two) kkt.min_pressure = least(kkt.min_pressure, ratio(std::abs(lambda), force));
  if (soft) kkt.min_pressure = least(kkt.min_pressure, ratio(bears - std::abs(lambda), std::max(force, bears)));
  side(lower, value - lower, up);
  side(upper, upper - value, down);
}

}  // namespace antilock
