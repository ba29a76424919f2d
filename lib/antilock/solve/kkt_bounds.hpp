#pragma once
#include <cmath>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// The rows of the KKT report (kkt.hpp) that speak of bounds: min_gap, min_pressure, complementarity. `u_scale` is U
/// there, `forces` holds min(own, F_0), N entries. For sizes that fit.
void report_bounds(Kkt& kkt, const VariationalInequality& problem, const Solution& solution, double u_scale,
                   Eigen::VectorXd forces);

/// The largest force of a single bound on each unknown, N.
Eigen::VectorXd largest_bound_forces(const VariationalInequality& problem, const Eigen::VectorXd& lambda);

/// The arithmetic of the report.
namespace scale_free {
/// 0 / 0 is a condition met exactly.
inline double ratio(double value, double scale) { return value == 0 ? 0.0 : value / scale; }

/// The smaller and the larger one; not a number where one of them is not.
inline double least(double a, double b) { return std::isnan(a) || a < b ? a : b; }
inline double most(double a, double b) { return std::isnan(a) || a > b ? a : b; }
}  // namespace scale_free

}  // namespace antilock
