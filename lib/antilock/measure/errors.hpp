#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "antilock/exact/exact_table.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// What errors are measured against: exact values at a point (dimensionless).
struct Reference {
  std::function<double(double x, double y)> value;
  std::function<Eigen::Vector2d(double x, double y)> gradient;
  std::function<double(double x, double y)> layer_stress;  ///< epsilon^-2 d/dy u in the layer, its limit at epsilon = 0
  /// All three at once, where that is faster than one by one; layer_stress means nothing above the layer. May be empty.
  std::function<ExactPoint(double x, double y)> at = {};
  /// What is known of x; the stress in the layer alone.
  ExactPoint known(const Eigen::Vector2d& x, bool in_layer) const;
};

/// The tabulated exact solution as a reference; the table must outlive it.
Reference reference(const ExactTable& table);

/// Absolute errors u_h - u; the names say the norm.
struct Errors {
  double max_at_unknowns = 0;  ///< at the unknowns: vertices (P1) or edge midpoints (CR)
  double max = 0;  ///< L-infinity, sampled at 15 points of every triangle: the lattice of order 4, corners included
  double l2 = 0;
  double h1 = 0;  ///< broken H1: sqrt(sum over triangles of |grad|^2 + L2^2)
  /// |.|_a^epsilon of Remark 4 for (23) and (24) with s = 1 (the factor s is not known here), the stiff part through
  /// p, so that it holds at epsilon = 0; for (22), (25) and without a layer the norm of the gradient
  double energy = 0;
  Eigen::VectorXd by_triangle;  ///< T: of each triangle in the energy norm; their squares add up to that of `energy`
};

Errors measure_errors(const Space& space, const Solution& solution, double epsilon, const Reference& reference);

/// Least-squares slope of log(error) against log(h); not a number for one that is not positive. Throws Error for fewer
/// than two pairs and for lists of two lengths.
double slope(const std::vector<double>& h, const std::vector<double>& errors);

/// J(u) = a(u, u)/2 - L(u) + j(u), the stiff part as compliance p' M p, j of friction (problem/bounds.hpp).
double energy(const VariationalInequality& problem, const Solution& solution);

}  // namespace antilock
